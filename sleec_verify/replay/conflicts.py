"""Conflicts over time, confirmed a second way: by all responses of their rules, or by a check of the refutation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_verify.encoding.trace_scope import responses_of
from sleec_verify.replay.responses import Open, Responses

if TYPE_CHECKING:
    from sleec_verify.query.ruleset_index import RulesetIndex
    from sleec_verify.results.finding import Finding
    from sleec_verify.traces.conflicts import Conflict
    from sleec_verify.traces.index import TraceIndex


def is_confirmed(index: TraceIndex, conflict: Conflict) -> bool:
    """Whether the evaluator finds no complying response in the situation of a conflict, and one if any rule is left
    out.

    Where it does not decide this (`sleec_verify.replay.responses`), the refutation is checked instead: each of its
    steps must follow by unit propagation. That shows only that the solver did not err.
    """
    instants = (*conflict.history, conflict.now)
    situation = Trace(tuple(Instant(one.time, frozenset(one.events), one.conditions) for one in instants))
    try:
        return Responses(index.root.ruleset, situation, index.untimed).confirm(conflict.rules)
    except Open:
        return _is_refuted(conflict)


def is_confirmed_at_once(index: RulesetIndex, finding: Finding) -> bool:
    """The same for a conflict of one situation without a history. It is not confirmed where the evaluator does not
    decide. Nothing is tried if no response has a window or an alternative: its replay compares all obligations."""
    rules = map(index.ruleset.by_label.__getitem__, finding.rules)
    if all(response.timing is None for rule in rules for response in responses_of(rule)):
        return True
    assert finding.witness is not None, "a conflict has a situation"
    now = Instant(0, frozenset(finding.witness.triggers), finding.witness.conditions)
    try:
        return Responses(index.ruleset, Trace((now,)), index.untimed).confirm(finding.rules)
    except Open:
        return False


def _is_refuted(conflict: Conflict) -> bool:
    from sleec_verify.encoding.elaboration import InvalidLemma
    from sleec_verify.encoding.refutation import refute

    clauses, literals = conflict.refutation
    try:
        refute(clauses, [literals])
    except InvalidLemma:
        return False
    return True
