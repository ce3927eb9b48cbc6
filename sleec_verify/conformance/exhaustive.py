"""Exhaustive test: every rule in every context that it distinguishes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import NamedTuple

from sleec_runtime.model import Context, Formula, Never, Rule, formulas_of
from sleec_verify.conformance.failure import Nonconformance, difference, situation_text
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.oracle import Expectation, Oracle
from sleec_verify.conformance.regions import LIMIT, ValueRegion, context_of, contexts, givens, size
from sleec_verify.conformance.subject import Bench, Running
from sleec_verify.query.inconsistent_sets import Constraint

SAMPLED = 500
"""The number of sampled contexts of a rule with too many contexts."""


class RuleGroup(NamedTuple):
    """Rules of one trigger that are tested together, and the values that decide them."""

    trigger: str
    rules: tuple[Rule, ...]
    given: list[ValueRegion]

    @property
    def whole(self) -> bool:
        """Whether every context is tested."""
        return size(self.given) <= LIMIT


def groups(oracle: Oracle, labels: frozenset[str] | None = None, unreported: bool = True) -> list[RuleGroup]:
    """The rules (those of `labels`, or all, whatever their domain) by their triggers: together with what constraints on
    them look at, if there are not too many contexts for that; else each rule by itself."""
    by_trigger: dict[str, list[Rule]] = {}
    for rule in oracle.whole.rules:
        if labels is None or rule.label in labels:
            by_trigger.setdefault(rule.trigger, []).append(rule)
    found: list[RuleGroup] = []
    for trigger, rules in by_trigger.items():
        formulas = [formula for rule in rules for formula in formulas_of(rule)]
        constrained = [*formulas, *_forbidding(oracle, rules)]
        for considered, near in ((constrained, True), (formulas, True), (formulas, False)):
            given = givens(considered, oracle.whole.measures, unreported, near)
            if size(given) <= LIMIT:
                found.append(RuleGroup(trigger, tuple(rules), given))
                break
        else:
            for rule in rules:
                given = givens(list(formulas_of(rule)), oracle.whole.measures, unreported)
                found.append(RuleGroup(trigger, (rule,), given))
    return found


def _forbidding(oracle: Oracle, rules: Sequence[Rule]) -> list[Formula]:
    names = {o.name for rule in rules for clause in rule.clauses() for o in clause.obligations}
    touching = (clash for clash in oracle.clashes if any(literal.name in names for literal in clash.literals))
    origins: dict[Constraint, None] = {origin: None for clash in touching for origin in clash.origins}
    return [origin.formula for origin in origins if isinstance(origin, Never)]


def situations(group: RuleGroup, oracle: Oracle, assumptions: Assumptions) -> Iterator[tuple[Context, Expectation]]:
    """The contexts of a group that the assumptions allow, smallest first, and what is due in each. Where there are too
    many, some of them, at random but always the same."""
    names = {group.trigger, *(one.name for one in group.given)}
    for context in _chosen(group):
        expected = oracle.expected(context)
        if not expected.possible:
            completed = assumptions.nearest(context, names)
            if completed is None:
                continue
            context, expected = completed, oracle.expected(completed)
        yield context, expected


def _chosen(group: RuleGroup) -> Iterator[Context]:
    triggers = frozenset({group.trigger})
    if group.whole:
        return contexts(group.given, triggers)
    from random import Random

    dice = Random(group.trigger)
    return (context_of(group.given, [dice.choice(one.values) for one in group.given], triggers) for _ in range(SAMPLED))


def each_rule(bench: Bench, labels: frozenset[str] | None = None) -> int:
    """Compares what is executed with what is due, for every rule in every context. Returns the number of contexts.

    Raises `Nonconformance` for the smallest situation of the first wrong rule.
    """
    oracle = bench.oracle()
    assumptions = Assumptions(oracle.ruleset)
    count = 0
    with bench.running() as running:
        for group in groups(oracle, labels):
            previous: Context | None = None
            for context, expected in situations(group, oracle, assumptions):
                failure = tried(running, context, expected)
                if failure is not None:
                    raise _with_what_led_to_it(bench, failure, previous)
                previous = context
                count += 1
    return count


def tried(running: Running, context: Context, expected: Expectation | None = None) -> Nonconformance | None:
    """Sets `context`, and triggers its triggers. Returns what is wrong with the observation, if anything."""
    if expected is None:
        expected = running.oracle.expected(context)
    running.enter(context)
    observed = running.observe(context.triggers)
    what = difference(context, expected, observed, running.oracle.whole)
    return None if what is None else Nonconformance(context, expected, observed, what)


def first_contexts(oracle: Oracle, assumptions: Assumptions, most: int) -> Iterator[list[tuple[Context, Expectation]]]:
    """For each group, some contexts in which it does something: the smallest for each set of active clauses."""
    for group in groups(oracle, unreported=False):
        seen: dict[tuple[object, ...], tuple[Context, Expectation]] = {}
        for context, expected in islice(situations(group, oracle, assumptions), 4 * SAMPLED):
            if expected.due and not expected.conflict:
                seen.setdefault(expected.active, (context, expected))
            if len(seen) == most:
                break
        yield list(seen.values())


def _with_what_led_to_it(bench: Bench, failure: Nonconformance, previous: Context | None) -> Nonconformance:
    """The failure on a new subject, or with its history if a new subject behaves correctly."""
    with bench.running() as fresh:
        alone = tried(fresh, failure.context, failure.expected)
    if alone is not None or previous is None:
        return alone or failure
    return failure.after(
        [situation_text(previous), "(a new instance passes in this situation: some state was left over)"]
    )
