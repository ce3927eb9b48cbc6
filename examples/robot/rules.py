"""The rules of the robot. Each process loads the same file; other rules would be noticed and named."""

from __future__ import annotations

from pathlib import Path

import sleec_runtime

RULES = Path(__file__).parent.parent.parent / "rulesets" / "care-robot.sleec"

sleec = sleec_runtime.load(RULES)
