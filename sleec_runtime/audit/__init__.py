"""The audit of recorded and live missions: observations, and the comparison of what happened with what was due."""
