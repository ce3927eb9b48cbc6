"""Concurrency: changes that exclude each other, and state that a forked process replaces."""
