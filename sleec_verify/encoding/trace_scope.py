"""Which rulesets are about traces, and the meaning of a response without a window there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from sleec_runtime.model import Atom, Obligation, Rule, Ruleset, formulas_of, leaves, literals

Untimed = Literal["at", "eventually"]
"""The meaning of a response without a window: at the instant of its trigger (LEGOS), or at some time from then on
(SLEEC-TK)."""


def speaks_of_traces(ruleset: Ruleset) -> bool:
    """Whether a ruleset is about traces: every ruleset in the DSL, and structured English with times."""
    return ruleset.syntax == "dsl" or ruleset.is_timed


def has_chains(ruleset: Ruleset) -> bool:
    """Whether a response of some rule triggers some rule, or a condition of some rule names it as an event."""
    heard = {event for rule in ruleset.rules for event in (rule.trigger, *named_atoms(rule))}
    return any(response.name in heard for rule in ruleset.rules for response in responses_of(rule))


def named_atoms(rule: Rule) -> Iterator[str]:
    """The events that the conditions of a rule name."""
    for formula in formulas_of(rule):
        yield from (leaf.name for leaf in leaves(formula) if isinstance(leaf, Atom) and leaf.kind == "trigger")


def responses_of(rule: Rule) -> Iterator[Obligation]:
    """Every response of a rule at any depth, in the order of the text."""
    for clause in rule.clauses():
        yield from literals(clause)
