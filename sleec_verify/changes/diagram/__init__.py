"""Decision diagrams of formulas, to count the situations that make them true."""
