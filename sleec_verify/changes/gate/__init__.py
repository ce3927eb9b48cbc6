"""The gate: one verdict on a change to the rules, by the team's policy (docs/gate.md).

It combines checks, comparison with the base, assertions, conformance of the robot's code, and coverage by cases. By
default, only rulesets that differ from the base in at least one byte are examined, because the others passed before.
"""

from __future__ import annotations

from sleec_verify.changes.gate.assertion_results import AssertionSources
from sleec_verify.changes.gate.baseline import Key, baseline_text, read_baseline
from sleec_verify.changes.gate.config import Config
from sleec_verify.changes.gate.examination import Check, evidence
from sleec_verify.changes.gate.keys import Target, is_assertion
from sleec_verify.changes.gate.policy import POLICIES
from sleec_verify.changes.gate.result import (
    POLICY_CHANGES,
    Block,
    GateResult,
    RulesetExamination,
    Status,
    TargetConformance,
)
from sleec_verify.changes.gate.settings import Settings, config_of, no_baseline, no_config, read_sides
from sleec_verify.changes.gate.settings_changes import policy_changes
from sleec_verify.changes.gate.verdict import findings_now, gate

__all__ = [
    "POLICIES",
    "POLICY_CHANGES",
    "AssertionSources",
    "Block",
    "Check",
    "Config",
    "GateResult",
    "Key",
    "RulesetExamination",
    "Settings",
    "Status",
    "Target",
    "TargetConformance",
    "baseline_text",
    "config_of",
    "evidence",
    "findings_now",
    "gate",
    "is_assertion",
    "no_baseline",
    "no_config",
    "policy_changes",
    "read_baseline",
    "read_sides",
]
