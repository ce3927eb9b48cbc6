"""CO-SLEEC: this system. The rules are read from their file, and the robot's actions implement the obligations."""
