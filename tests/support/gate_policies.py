"""Policies for tests of `gate`."""

from __future__ import annotations

from typing import Any

from tests.support.paths import ROOT

ROBOT = (ROOT / "examples" / "household_robot.py").read_text(encoding="utf-8")
HOUSEHOLD = (ROOT / "rulesets" / "household.sleec").read_text(encoding="utf-8")
OWN = "sleec-verify.toml"
NEVER = '[block]\nfindings = "never"\nnew-conflicts = false\n'


def changes(said: dict[str, Any]) -> list[tuple[str, str, str]]:
    return [(one["policy"], one["where"], one["what"]) for one in said["policy_changes"]]


SECRET = "hunter2 is the password\n"
