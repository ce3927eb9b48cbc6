"""Changes to rules: comparison of two rulesets, assertions, revisions in git, and the gate."""
