"""CS-libs-CM: CO-SLEEC without its libraries and without the Context Manager Node (paper, Section 5). Each Task Manager
Node evaluates its rule, written by hand."""
