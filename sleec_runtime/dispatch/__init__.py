"""Dispatch: from a trigger to one snapshot of the context, to layers, to the variants that run (docs/runtime.md)."""
