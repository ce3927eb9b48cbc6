"""Formulas as decision diagrams, to count the situations that make them true."""
