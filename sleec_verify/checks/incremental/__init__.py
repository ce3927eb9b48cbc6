"""Checks of one text after the other: after a change, only questions that depend on it are asked again."""
