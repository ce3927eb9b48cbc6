"""Audits of recorded missions: readers of logs, and the results as findings."""
