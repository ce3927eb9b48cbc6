"""Measurements that the docs quote, each a module here with a `main`."""
