"""Measurements that the docs quote. Each module with a `main` is one measurement."""
