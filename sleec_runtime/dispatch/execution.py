"""Execution of a plan: Definition 2 of the paper, with one ε for each rule.

For each rule of the triggers, the variant that runs is the one on the layer that Algorithm 1 yields, and no other. All
checks precede the first variant.
"""

from __future__ import annotations

from collections.abc import Sequence
from types import CoroutineType
from typing import Any

import contextpy3

from sleec_runtime.dispatch.decisions import due_in
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.plan import Args, Kwargs, Plan
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.dispatch.variants import Unfinished, await_under, run_under
from sleec_runtime.errors import NeedsAwait, VariantsFailed

_TLS: Any = contextpy3._TLS


def plan(snapshot: Snapshot, triggers: tuple[str, ...], instance: Instance) -> Plan:
    """The plan of a dispatch of `triggers` in this context. Raises NotBound, and as `due_in`."""
    due = due_in(snapshot, triggers)
    variants = []
    for decision in due.decisions:
        clauses = list(decision.rule.clauses())
        variant = instance.variant(decision.rule, decision.clause, clauses[decision.clause])
        if variant is not None:
            variants.append(variant)
    return Plan(triggers, due, tuple(variants), snapshot.mark)


def run(plan: Plan, args: Args, kwargs: Kwargs) -> list[object]:
    """Runs the variants of a plan in order, and returns their results. Raises their errors after all have run.

    To be called after `Plan.refuse_misfits` and `Plan.refuse_coroutines`.
    """
    results: list[object] = []
    errors: list[tuple[str, Exception]] = []
    for variant in plan.variants:
        result: object = None
        # As `run_under`, without a call, which would take time on the way to the code.
        layers, context = _TLS.active_layers, _TLS.context
        try:
            if layers or variant.direct is None:
                result = run_under(variant, args, kwargs)
            else:
                _TLS.active_layers, _TLS.context = (
                    variant.layers,
                    [variant.instance, variant.owner, variant.proceeds_to],
                )
                result = variant.direct(*args, **kwargs)
        except Exception as error:  # noqa: BLE001 - raised again once all have run, because each rule obliges its own
            errors.append((variant.label, error))
        finally:
            _TLS.active_layers, _TLS.context = layers, context
        results.append(result)
    for result in results:
        if type(result) is CoroutineType or type(result) is Unfinished:
            result.close()
            raise NeedsAwait(
                f"a variant of {' and '.join(plan.triggers)} returned a coroutine", "await trigger_async(…) instead"
            )
    if errors:
        raise one_of(errors)
    return results


async def run_async(plan: Plan, args: Args, kwargs: Kwargs) -> list[object]:
    """Runs the variants of a plan as `run` does, and awaits coroutines."""
    results: list[object] = []
    errors: list[tuple[str, Exception]] = []
    for variant in plan.variants:
        try:
            results.append(await await_under(variant, args, kwargs))
        except Exception as error:  # noqa: BLE001 - raised again once all have run
            errors.append((variant.label, error))
    if errors:
        raise one_of(errors)
    return results


def one_of(errors: Sequence[tuple[str, BaseException]]) -> BaseException:
    """The error of one variant; for several variants, a VariantsFailed with all errors."""
    if len(errors) == 1:
        return errors[0][1]
    several = VariantsFailed(errors)
    several.__cause__ = errors[0][1]
    return several
