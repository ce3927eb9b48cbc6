"""Scenarios: test cases for rules with time, and their run on a virtual clock."""
