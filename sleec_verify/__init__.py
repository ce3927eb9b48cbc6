"""What the people around the robot use: proves things about SLEEC rules, and that code does what they say."""

from sleec_runtime import __version__ as __version__
