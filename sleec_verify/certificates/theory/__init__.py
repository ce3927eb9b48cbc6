"""Rulesets as the theory in `proofs/` has them: for what is extracted from it, and for theorems about one ruleset."""
