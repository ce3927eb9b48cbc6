"""Rulesets in the form of the theory in `proofs/`: for the extracted oracle, and for theorems about one ruleset."""
