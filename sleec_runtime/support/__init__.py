"""Support: files, messages, forks and critical sections. Nothing here knows of rules."""
