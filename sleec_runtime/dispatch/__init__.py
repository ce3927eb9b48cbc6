"""Dispatch: from a trigger to a snapshot of the context, to layers, and to the variants that run (docs/runtime.md)."""
