"""The words of names: what people read in them, and what the rules do not know."""
