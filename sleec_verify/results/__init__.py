"""Results as values: verdicts, findings, timelines, and their words. Nothing here computes an answer."""
