"""Other rules while the robot runs: nothing of the old ones stays behind.

The other rules are the same with every condition of a hedge negated, so that the code that the robot has fits them too.
"""

from __future__ import annotations

from dataclasses import replace

from sleec_runtime.model import Clause, Context, Not, Rule, Ruleset
from sleec_verify.conformance.exhaustive import first_contexts
from sleec_verify.conformance.failure import Nonconformance, difference
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.oracle import Oracle
from sleec_verify.conformance.subject import Bench, Running

MOST = 20
"""Situations; each replaces the rules twice."""


CONTRADICTION = "<contradicting rules>"
"""The path of such rules. They are not the user's."""


def contradicting_ruleset(ruleset: Ruleset) -> Ruleset:
    """The same rules, the condition of each hedge negated."""
    statements = tuple(_contrary(s) if isinstance(s, Rule) else s for s in ruleset.statements)
    return replace(ruleset, statements=statements, source=replace(ruleset.source, path=CONTRADICTION))


def _contrary(rule: Rule) -> Rule:
    return replace(rule, default=_negated(rule.default), hedges=tuple(map(_negated, rule.hedges)))


def _negated(clause: Clause) -> Clause:
    condition = None if clause.condition is None else Not(clause.condition)
    return replace(clause, condition=condition, hedges=tuple(map(_negated, clause.hedges)))


def replaced(bench: Bench) -> int:
    """Raises Nonconformance where old rules, or what was decided by them, outlive a replacement. Returns the number of
    replacements; none if the subject has no `replace`."""
    oracle = bench.oracle()
    other = Oracle(contradicting_ruleset(oracle.whole), oracle.domain)
    count = 0
    with bench.running() as running:
        put_in_force = getattr(running.subject, "replace", None)
        if put_in_force is None:
            return 0
        found = [context for some in first_contexts(oracle, Assumptions(oracle.ruleset), 2) for context, _ in some]
        for context in found[:MOST]:
            running.enter(context)
            running.observe(context.triggers)
            for now in (other, oracle):
                put_in_force(now.whole)
                _compare(running, context, now, "right after a change of the rules, without a change of context")
                count += 1
    return count


def _compare(running: Running, context: Context, oracle: Oracle, when: str) -> None:
    expected = oracle.expected(context)
    observed = running.observe(context.triggers)
    what = difference(context, expected, observed, oracle.whole)
    if what is not None:
        raise Nonconformance(context, expected, observed, what, [when])
