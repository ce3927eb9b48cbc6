"""Drafts of mappings, from the topics in a log and the names in the rules."""
