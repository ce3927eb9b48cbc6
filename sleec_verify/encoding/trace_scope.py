"""Which rulesets are about traces, and the meaning of a response without a window there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from sleec_runtime.model import Obligation, Rule, Ruleset, literals

Untimed = Literal["at", "eventually"]
"""The meaning of a response without a window: at the instant of its trigger (LEGOS), or at some time from then on
(SLEEC-TK)."""


def speaks_of_traces(ruleset: Ruleset) -> bool:
    """Whether a ruleset is about traces: every ruleset in the DSL, and structured English with times."""
    return ruleset.syntax == "dsl" or ruleset.is_timed


def has_chains(ruleset: Ruleset) -> bool:
    """Whether a response of some rule triggers some rule."""
    triggers = {rule.trigger for rule in ruleset.rules}
    return any(response.name in triggers for rule in ruleset.rules for response in responses_of(rule))


def responses_of(rule: Rule) -> Iterator[Obligation]:
    """Every response of a rule at any depth, in the order of the text."""
    for clause in rule.clauses():
        yield from literals(clause)
