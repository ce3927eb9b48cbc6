"""Queries over all contexts: cone of influence, lazily grown questions, inconsistent sets, smallest witnesses."""
