"""What both languages share: source text, suggestions, comments, comparisons, units."""
