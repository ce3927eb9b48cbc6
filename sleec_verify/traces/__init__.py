"""Rules with time: questions about all traces of a ruleset (docs/traces.md)."""
