"""The three systems that the evaluation compares, each in its folder, and what they share."""
