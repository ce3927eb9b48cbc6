"""Test cases: situations with what is due in them, written, read, and selected so that few of them cover a ruleset."""
