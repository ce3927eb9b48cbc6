"""Encoding: rules as clauses (the paper's Equation 1), measures as propositional variables, and the SAT solver."""
