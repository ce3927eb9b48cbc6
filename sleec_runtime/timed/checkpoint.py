"""Snapshots of pending obligations as plain data, which another process can restore: see `recovery`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import SnapshotRefused, WrongType
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.plain_data import PLAIN, copied, is_plain, number_to_plain
from sleec_runtime.timed.task import Origin, Task

FORMAT = 1
"""The version of the format. Other versions are rejected."""


def identity(index: RuleIndex, chains: bool) -> dict[str, object]:
    """The rules in force, and how they are used. Raises SnapshotRefused for rules without a text."""
    source = index.whole.source
    if not source.text:
        raise SnapshotRefused("the rules were not read from a text, so no other process can tell them", "parse() them")
    sha256 = source.sha256
    if sha256 is None:
        import hashlib

        sha256 = hashlib.sha256(source.text.encode("utf-8", "surrogatepass")).hexdigest()
    return {"sha256": sha256, "reading": index.whole.reading, "domain": index.domain, "chains": chains}


def checkpoint(tasks: Iterable[Task], index: RuleIndex, chains: bool, now: Time, saved_at: Time) -> dict[str, Any]:
    """The open ones of `tasks`, at the time `now` of the clock and `saved_at` of the world, in seconds. O(pending).

    Raises WrongType for an argument that is not plain data and that code may still get; SnapshotRefused as `identity`.
    """
    whole = identity(index, chains)
    contexts: dict[int, tuple[int, Snapshot]] = {}
    decisions: dict[int, tuple[int, dict[str, Any]]] = {}
    pending = []
    left_out = []
    for task in sorted(tasks, key=lambda task: task.number):
        if not task.is_open or task.conditional:
            continue
        origin = task.origin
        if not _is_of(origin.snapshot.index, index):
            left_out.append({"rule": origin.rule.label, "obligation": str(task.literal)})
            continue
        context, _ = contexts.setdefault(id(origin.snapshot), (len(contexts), origin.snapshot))
        number, decision = decisions.setdefault(id(origin), (len(decisions), _decision(origin, context, now)))
        if decision["arguments"] is None and may_run_code(task):
            decision["arguments"] = _arguments(origin)
        pending.append(
            {
                "decision": number,
                "path": list(task.path),
                "obligation": task.name,
                "state": task.state,
                "starts": None if task.unit is None else number_to_plain(task.unit.at - task.first),
                "broken": task.broken,
            }
        )
    return {
        "format": FORMAT,
        "ruleset": whole,
        "saved_at": number_to_plain(saved_at),
        "contexts": [_context(snapshot) for _, snapshot in contexts.values()],
        "decisions": [decision for _, decision in decisions.values()],
        "pending": pending,
        "left_out": left_out,
    }


def _is_of(own: RuleIndex, index: RuleIndex) -> bool:
    """Whether both indices are of one ruleset, perhaps in different domains."""
    one, other = own.whole, index.whole
    return one is other or (one.source.text, one.reading) == (other.source.text, other.reading)


def _context(snapshot: Snapshot) -> dict[str, Any]:
    conditions = {
        name: value if isinstance(value, (bool, str)) else number_to_plain(value)
        for name, value in snapshot.conditions.items()
    }
    return {"domain": snapshot.index.domain, "conditions": conditions}


def _decision(origin: Origin, context: int, now: Time) -> dict[str, Any]:
    tied = origin.rule.label in origin.snapshot.index.trigger_dependent
    return {
        "rule": origin.rule.label,
        "clause": origin.decision.clause,
        "triggered": number_to_plain(origin.moment - now),
        "context": context,
        "arguments": None,
        **({"triggers": sorted(origin.triggers)} if tied else {}),
    }


def may_run_code(task: Task) -> bool:
    """Whether code may still start for the task or its alternatives."""
    return not task.literal.negated or not task.is_decided


def _arguments(origin: Origin) -> dict[str, Any]:
    for name, value in (*enumerate(origin.args, 1), *origin.kwargs.items()):
        if not is_plain(value):
            raise WrongType(
                f"argument {name} of the trigger {origin.rule.trigger}",
                value,
                f"plain data, because the code of rule {origin.rule.label} may need it after a restart",
                f"give {PLAIN}, for example a number by which the code finds the object",
            )
    return {"args": copied(list(origin.args)), "kwargs": copied(dict(origin.kwargs))}
