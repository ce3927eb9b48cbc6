"""Conditions that name acts, as alternatives of the response (docs/times.md, "Conditions that name an event").

Whether an act occurs at the instant of the trigger is part of the response, so the response decides which clause of a
rule decides. For each set of the acts that a rule names, either an act of the set does not occur now, or another act
that the rule names occurs now, or the clause that decides with exactly these acts is met. Each of these disjunctions is
a response with alternatives, so everything that follows needs no conditions about acts. There is one for each set of
acts: exponential in the acts that one rule names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

from sleec_runtime.model import (
    And,
    Atom,
    Clause,
    Formula,
    Length,
    Not,
    Number,
    Obligation,
    Or,
    Rule,
    Ruleset,
    Timing,
    Truth,
    Window,
)
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.statement_parts import with_formulas
from sleec_verify.encoding.trace_scope import named_atoms
from sleec_verify.traces.index import TraceIndex
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

MOST_ACTS = 3
"""The maximal number of acts that the conditions of one rule name."""

NOW = Window(end=Length(Number(0), "seconds"))


@dataclass(frozen=True)
class Variant:
    """A rule for one set of acts: which of the named acts occur at its trigger, and the rule without their names."""

    acts: Mapping[str, bool]
    rule: Rule


def variants_of(rule: Rule) -> list[Variant]:
    """The variants of a rule whose conditions name acts; none if they name none.

    Raises:
        Undecided: they name too many.
    """
    named = sorted(set(named_atoms(rule)))
    if not named:
        return []
    if len(named) > MOST_ACTS:
        raise Undecided(
            sentence(
                "the conditions of rule {rule} name more than {most} responses", rule=quoted(rule.label), most=MOST_ACTS
            )
        )
    every = (dict(zip(named, values)) for values in product((True, False), repeat=len(named)))
    return [Variant(acts, _without_acts(rule, acts, number)) for number, acts in enumerate(every)]


def without_named_acts(index: TraceIndex, variants: Mapping[str, Sequence[Variant]]) -> TraceIndex:
    """The same rules with alternatives in place of the conditions that name acts. `variants` are those of each rule."""
    if not any(variants.values()):
        return index
    found = TraceIndex(_with_alternatives(index.ruleset, variants), index.untimed, index.recorder, index.whole)
    # A part of a ruleset has no declarations.
    found.agents = index.root.agents
    # An act that triggers a rule is also an input, and an input may decide a clause.
    inputs = {*index.root.mere_inputs, *index.root.by_trigger}
    found.naming = {
        event: [found.ruleset.by_label[rule.label] for rule in rules]
        for event, rules in index.naming.items()
        if event in inputs
    }
    return found


def _with_alternatives(ruleset: Ruleset, variants: Mapping[str, Sequence[Variant]]) -> Ruleset:
    return replace(
        ruleset,
        statements=tuple(
            replace(s, guard=None, default=Clause(None, tuple(_disjunctions(variants[s.label]))), hedges=())
            if isinstance(s, Rule) and variants.get(s.label)
            else s
            for s in ruleset.statements
        ),
    )


def _disjunctions(variants: Sequence[Variant]) -> Iterator[Obligation]:
    for variant in variants:
        due = _as_response(variant.rule)
        for act, occurs in variant.acts.items():
            due = Clause(None, (Obligation(act, negated=occurs, timing=Timing(NOW, instead=due)),))
        yield from due.obligations


def _as_response(rule: Rule) -> Clause:
    """The chain of a rule as a response with exceptions of its own. It requires nothing if the guard is false."""
    default = replace(rule.default, condition=Truth(True))
    guarded = (Clause(Truth(True) if rule.guard is None else rule.guard, (), (default, *rule.hedges)),)
    return Clause(None, (), guarded)


def _without_acts(rule: Rule, acts: Mapping[str, bool], number: int) -> Rule:
    # The encoding knows chains by the labels of their rules.
    return replace(with_formulas(rule, lambda formula: _replaced(formula, acts)), label=f"{rule.label}\0{number}")


def _replaced(formula: Formula, acts: Mapping[str, bool]) -> Formula:
    if isinstance(formula, Atom):
        return Truth(acts[formula.name]) if formula.kind == "trigger" else formula
    if isinstance(formula, Not):
        return replace(formula, operand=_replaced(formula.operand, acts))
    if isinstance(formula, (And, Or)):
        return replace(formula, operands=tuple(_replaced(one, acts) for one in formula.operands))
    return formula
