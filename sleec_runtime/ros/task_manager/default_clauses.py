"""The default clauses of rules, for a node without a context."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from sleec_runtime.dispatch.decisions import refuse_conflict
from sleec_runtime.dispatch.execution import run
from sleec_runtime.dispatch.plan import Plan
from sleec_runtime.errors import SleecError
from sleec_runtime.evaluation.due import Due
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.ros.identity import snapshot_of


def run_defaults(sleec: Sleec, trigger: str, own: Collection[str], *args: Any) -> Due:
    """Runs the default of each rule of `trigger` in `own` that has no guard, whatever the context.

    Raises SleecError, before anything runs, for a rule with a guard, because only the context tells whether it applies;
    and as `Sleec.trigger`.
    """
    snapshot = snapshot_of(sleec)
    rules = [rule for rule in snapshot.index.by_trigger[snapshot.index.number_of[trigger]] if rule.label in own]
    for rule in rules:
        if rule.guard is not None:
            raise SleecError(f"rule `{rule.label}` has a guard, so it has no default without a context")
    clauses = [next(iter(rule.clauses())) for rule in rules]
    due = Due(tuple(Decision(rule, 0, clause.obligations, ()) for rule, clause in zip(rules, clauses)))
    refuse_conflict(snapshot, (trigger,), due)
    variants = [sleec.code.variant(rule, 0, clause) for rule, clause in zip(rules, clauses)]
    plan = Plan((trigger,), due, tuple(variant for variant in variants if variant is not None), snapshot.mark)
    plan.refuse_misfits(args, {})
    plan.refuse_coroutines()
    run(plan, args, {})
    return due
