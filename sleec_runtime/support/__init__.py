"""Support: files, messages, places in a text, and suggestions. Nothing here depends on rules."""
