"""The local page to write rules and try them on: HTTP server, files, drafts, and the answers for the page."""
