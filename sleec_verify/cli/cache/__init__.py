"""What was decided once, kept for rules that did not change."""
