"""What both languages share: tokens, formulas, claims, names, comments and printing."""
