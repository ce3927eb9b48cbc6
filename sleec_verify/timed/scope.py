"""Which rulesets are about traces, and what a response without a window means there."""

from __future__ import annotations

from typing import Literal

from sleec_runtime.model import Ruleset

Untimed = Literal["at", "eventually"]
"""What a response without a window means: at the instant of its trigger (LEGOS), or at some time from then on
(SLEEC-TK)."""


def speaks_of_traces(ruleset: Ruleset) -> bool:
    """Whether a ruleset is about traces: what is done may trigger rules, and times pass. The DSL always is, structured
    English where it says anything of time."""
    return ruleset.syntax == "dsl" or ruleset.is_timed
