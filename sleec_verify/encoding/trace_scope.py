"""Which rulesets are about traces, and what a response without a window means there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from sleec_runtime.model import Obligation, Rule, Ruleset, literals

Untimed = Literal["at", "eventually"]
"""What a response without a window means: at the instant of its trigger (LEGOS), or at some time from then on
(SLEEC-TK)."""


def speaks_of_traces(ruleset: Ruleset) -> bool:
    """Whether a ruleset is written for traces: the DSL always is, structured English where it mentions times."""
    return ruleset.syntax == "dsl" or ruleset.is_timed


def has_chains(ruleset: Ruleset) -> bool:
    """Whether a response of some rule is the trigger of some rule."""
    triggers = {rule.trigger for rule in ruleset.rules}
    return any(response.name in triggers for rule in ruleset.rules for response in responses_of(rule))


def responses_of(rule: Rule) -> Iterator[Obligation]:
    """Every response of a rule at any depth, in the order of the text."""
    for clause in rule.clauses():
        yield from literals(clause)
