"""What the exit codes mean."""

HOLDS = 0
FINDINGS = 1
UNUSABLE = 2
UNKNOWN = 3
