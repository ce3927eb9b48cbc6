"""Concurrency: changes that exclude one another, and what a forked process renews."""
