"""The Task Manager Node, and its parts (paper, Section 4 and Figure 1)."""
