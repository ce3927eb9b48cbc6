"""CS-libs: CO-SLEEC without its libraries (paper, Section 5). A Context Manager Node evaluates the rules, written by
hand, and sends the selected hedge clauses to the Task Manager Nodes."""
