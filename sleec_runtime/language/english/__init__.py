"""Structured English: text to `Ruleset` and back (docs/language.md)."""
