"""Readers of logs, one for each form."""
