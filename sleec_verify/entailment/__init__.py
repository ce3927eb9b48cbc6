"""Entailment: what rules entail in one context (Definition 1), by which clauses, and what follows."""
