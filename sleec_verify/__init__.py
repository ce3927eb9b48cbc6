"""What the people around the robot use: proves things about SLEEC rules, and that code does what they say."""

__version__ = "0.1.0"
