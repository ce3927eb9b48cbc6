"""What a robot carries: reads SLEEC rules, decides which clause of each is active, and runs the right code."""
