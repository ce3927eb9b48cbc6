"""The site of docs/: hooks for mkdocs, and generated pages.

Only `hooks` imports mkdocs, so the tests do not need it.
"""
