"""The site of docs/: what mkdocs asks for while it builds, and the pages that are made and not written.

Nothing but `hooks` knows of mkdocs, so that the tests need none.
"""
