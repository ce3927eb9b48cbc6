"""Evaluation: the meaning of rules in a context (Algorithm 1) and on a trace, without clauses and solver."""
