"""Evaluation: Algorithm 1 of the paper in both readings, conflicts of one context, and the evaluator of traces.

This is the road to an answer without clauses and without a solver.
"""
