"""Revisions: rulesets of a commit and of the working tree, and which of them belong together."""
