"""Decision tables of rules: which clause decides in which situations."""
