"""Decisions and conflicts as text: the active clause of each rule, and the conditions that decided it."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.evaluation.conflicts import Conflict
from sleec_runtime.evaluation.hedge_chain import ConditionTest, Decision
from sleec_runtime.language.common.formula_printer import print_formula, print_number
from sleec_runtime.model import (
    Atom,
    Comparison,
    Context,
    Exclusive,
    Formula,
    Obligation,
    Rule,
    Value,
    leaves,
    measures_of,
)
from sleec_runtime.support.messages import listed


def outcome_in_words(rule: Rule, outcome: Decision | None, context: Context) -> str:
    """The outcome of one rule with its reasons, in a few lines."""
    if outcome is None:
        return f"{rule.label}: nothing, because its guard is false"
    return decision_in_words(outcome, context)


def decision_in_words(decision: Decision, context: Context) -> str:
    """The active clause, its obligations, and the conditions that decided it, with their values."""
    clause = "the default response" if decision.layer is None else f"exception {decision.layer}"
    what = ", ".join(map(str, decision.obligations)) or "nothing"
    lines = [f"{decision.rule.label}: {clause} requires {what}"]
    lines += [f"  {step_in_words(step, context)}" for step in decision.steps]
    return "\n".join(lines)


def conflict_in_words(cause: Conflict, decisions: tuple[Decision, ...]) -> str:
    """The contradicting literals with their rules, and the constraints that forbid them."""
    literals = " and ".join(_with_rules(literal, decisions) for literal in cause.literals)
    forbidding = "; ".join(
        f"EXCLUSIVE {listed(c.names)}" if isinstance(c, Exclusive) else f"NEVER {print_formula(c.formula)}"
        for c in cause.constraints
    )
    if not literals:
        return f"the constraints forbid this situation: {forbidding}"
    verb = "is" if len(cause.literals) == 1 else "are"
    return f"{literals} {verb} due, but forbidden by {forbidding}" if forbidding else f"{literals} are both due"


def _with_rules(literal: Obligation, decisions: tuple[Decision, ...]) -> str:
    labels = dict.fromkeys(d.rule.label for d in decisions if literal in d.obligations)
    return f"{literal} ({listed(labels)})" if labels else str(literal)


def step_in_words(step: ConditionTest, context: Context) -> str:
    """The test of a condition with its result, and the values that decided it."""
    where = "guard" if step.clause is None else f"clause {step.clause}"
    values = ", ".join(dict.fromkeys(_values(step.condition, context)))
    text = f"{where}: {print_formula(step.condition)} is {'true' if step.held else 'false'}"
    return f"{text} ({values})" if values else text


def _values(formula: Formula, context: Context) -> Iterator[str]:
    conditions = context.conditions
    for leaf in leaves(formula):
        if isinstance(leaf, Atom) and leaf.kind == "trigger":
            if leaf is not formula:
                yield f"{leaf.name} {'occurs' if leaf.name in context.triggers else 'does not occur'}"
        elif isinstance(leaf, Comparison):
            yield from (f"{name} = {_value(conditions.get(name))}" for name in measures_of(leaf))
        elif leaf is not formula:
            yield f"{leaf.name} = {_value(conditions.get(leaf.name))}"
        elif leaf.name not in conditions:
            yield "unreported"


def _value(value: Value | None) -> str:
    if value is None:
        return "unreported"
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else print_number(value)
