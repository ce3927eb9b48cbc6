"""Recovery of pending obligations from plain data: the inverse of `checkpoint`.

The rules, the context and the time of the trigger decide again what each obligation is and when it is due. The data
only say which obligations are open, so they cannot add obligations that the rules do not have.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import SleecError, SnapshotRefused
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.support.messages import represent
from sleec_runtime.timed.checkpoint import FORMAT, identity, may_run_code
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.plain_data import DEEPEST, copied, is_plain, number_from_plain
from sleec_runtime.timed.response_tasks import tasks_of
from sleec_runtime.timed.snapshot_data import chosen, items, number_at, record, refuse_malformed
from sleec_runtime.timed.task import Origin, Path, Task
from sleec_runtime.timed.unit import Unit, composed_units, units_of


@dataclass(frozen=True)
class Heir:
    """The instance that continues with the pending obligations: its rules and code, and the time on its `clock` and in
    the `world`."""

    index: RuleIndex
    instance: Instance
    chains: bool
    clock: Time
    world: Time


@dataclass(frozen=True)
class Recovered:
    """The open `tasks` in order, the `units` that start some of them, and in `left_out` what cannot be recovered: the
    labels of replaced rules, each with an obligation."""

    tasks: Sequence[Task]
    units: Sequence[Unit]
    left_out: Sequence[tuple[str, str]]


def recover(data: object, heir: Heir) -> Recovered:
    """The pending obligations in `data`. O(contexts · size of the rules + pending).

    A unit whose windows have closed since the snapshot does not start. Raises SnapshotRefused for data that are
    malformed, of other rules, or from a later time; NotBound and WrongArguments as a trigger does.
    """
    whole = record(data, "it", "format", "ruleset", "saved_at", "contexts", "decisions", "pending", "left_out")
    if type(whole["format"]) is not int or whole["format"] != FORMAT:
        raise SnapshotRefused(
            f"the snapshot has the format {represent(whole['format'])}, and this version reads {FORMAT}",
            "restore it with the version that took it",
        )
    _refuse_other_rules(whole["ruleset"], heir)
    then = heir.clock - _elapsed(number_at(whole["saved_at"], "saved_at"), heir.world)
    contexts = [_context(one, where, heir) for where, one in items(whole, "contexts")]
    dispatches = [_dispatch(one, where, contexts, then, heir) for where, one in items(whole, "decisions")]
    tasks = [_task(one, where, dispatches) for where, one in items(whole, "pending")]
    for dispatch in dispatches:
        dispatch.refuse_both()
    units = [unit for dispatch in dispatches for unit in dispatch.units(heir.clock)]
    order = {task: number for number, task in enumerate(tasks)}
    units.sort(key=lambda unit: (unit.at, order[unit.tasks[0]]))
    return Recovered(tasks, units, [_left_out(one, where) for where, one in items(whole, "left_out")])


def _refuse_other_rules(data: object, heir: Heir) -> None:
    own = identity(heir.index, heir.chains)
    theirs = record(data, "ruleset", *own)
    for name, value in own.items():
        if type(theirs[name]) is not type(value) or theirs[name] != value:
            raise SnapshotRefused(
                f"the snapshot is of other rules: its {name} is {represent(theirs[name])}, and that of the rules in "
                f"force is {represent(value)}",
                "load the rules as they were loaded when the snapshot was taken",
            )


def _elapsed(saved_at: Time, world: Time) -> Time:
    if world < saved_at:
        raise SnapshotRefused(
            f"the snapshot was taken {float(saved_at - world):,.3f} seconds later than now: the clock was set back",
            "set the clock; or give the right time, in seconds since 1970: restore(snapshot, now=…)",
        )
    return world - saved_at


def _context(data: object, where: str, heir: Heir) -> Snapshot:
    context = record(data, where, "domain", "conditions")
    domain, conditions = context["domain"], context["conditions"]
    if type(conditions) is not dict:
        refuse_malformed(f"{where}.conditions", conditions, "a dict")
    try:
        index = heir.index
        if domain != index.domain:
            index = RuleIndex(index.whole, domain, index.strict)
        return Snapshot.first(index, {name: _value(name, value, index) for name, value in conditions.items()})
    except SleecError as error:
        raise SnapshotRefused(f"the snapshot is malformed at {where}: {error.message}", error.hint) from None


def _value(name: str, data: object, index: RuleIndex) -> object:
    measure = index.vocabulary.get(name)
    value = data if measure is None or measure.kind == "scale" else number_from_plain(data)
    return refuse_malformed(name, data, "a value") if value is None else value


# Decisions ------------------------------------------------------------------------------------------------


@dataclass
class _Dispatch:
    """A decision with all its tasks. `open` are the open ones, by path. `starts` are those that are still to start,
    with the seconds from the opening of the window. `groups` are the responses with open tasks, by path."""

    origin: Origin
    roots: tuple[Task, ...]
    code: tuple[Unit, ...] | None
    starts: dict[Task, Time] = field(default_factory=dict)
    groups: dict[Path, tuple[Task, ...]] = field(default_factory=dict)
    open: dict[Path, Task] = field(default_factory=dict)

    def refuse_both(self) -> None:
        """Raises SnapshotRefused if both a task and its alternative are open."""
        for path, task in self.open.items():
            for length in range(1, len(path), 2):
                other = self.open.get(path[:length])
                if other is not None and not other.literal.negated:
                    refuse_malformed("pending", task.name, f"pending in place of {other.name}, not beside it")

    def units(self, now: Time) -> Iterator[Unit]:
        """The units of the tasks that are still to start and whose windows have not closed by `now`."""
        for path, group in self.groups.items():
            for unit in composed_units(self.origin, group) if path else self.code or ():
                for task in unit.tasks:
                    task.unit = None
                tasks = tuple(t for t in unit.tasks if t in self.starts and (t.last is None or now <= t.last))
                if tasks:
                    yield Unit(self.origin, tasks, max(t.first + self.starts[t] for t in tasks), unit.written)


def _dispatch(data: object, where: str, contexts: Sequence[Snapshot], then: Time, heir: Heir) -> _Dispatch:
    tied = ("triggers",) if type(data) is dict and "triggers" in data else ()
    decision = record(data, where, "rule", "clause", "triggered", "context", "arguments", *tied)
    snapshot = chosen(contexts, decision["context"], f"{where}.context")
    triggered = number_at(decision["triggered"], f"{where}.triggered")
    if triggered > 0:
        refuse_malformed(f"{where}.triggered", triggered, "a number up to 0")
    label = decision["rule"]
    rule = snapshot.index.ruleset.by_label.get(label) if type(label) is str else None
    triggers = _triggers(decision.get("triggers", []), f"{where}.triggers", snapshot.index)
    outcome = None
    if rule is not None:
        triggers |= {rule.trigger}
        outcome = snapshot.outcome(rule, triggers)
    if not isinstance(outcome, Decision) or type(decision["clause"]) is not int:
        refuse_malformed(where, decision, "a rule that applies in its context")
    if outcome.clause != decision["clause"]:
        refuse_malformed(f"{where}.clause", decision["clause"], f"{outcome.clause}, the active clause in its context")
    args, kwargs = _arguments(decision["arguments"], f"{where}.arguments")
    origin = Origin(outcome, then + triggered, snapshot, heir.instance, args, kwargs, triggers)
    try:
        roots = tasks_of(outcome.obligations, origin.moment, origin)
    except SleecError as error:
        raise SnapshotRefused(f"the snapshot is malformed at {where}: {error.message}", error.hint) from None
    return _Dispatch(origin, roots, None if decision["arguments"] is None else units_of(origin, roots))


def _triggers(data: object, where: str, index: RuleIndex) -> frozenset[str]:
    if type(data) is not list or not all(type(name) is str and name in index.number_of for name in data):
        refuse_malformed(where, data, "a list of triggers")
    return frozenset(data)


def _arguments(data: object, where: str) -> tuple[tuple[Any, ...], Mapping[str, Any]]:
    if data is None:
        return (), {}
    arguments = record(data, where, "args", "kwargs")
    args, kwargs = arguments["args"], arguments["kwargs"]
    if (
        type(args) is not list
        or type(kwargs) is not dict
        or not all(is_plain(one, DEEPEST + 1) for one in (args, kwargs))
    ):
        refuse_malformed(where, data, "a list and a dict of plain data")
    return tuple(copied(args)), copied(kwargs)


# Tasks ----------------------------------------------------------------------------------------------------


def _task(data: object, where: str, dispatches: Sequence[_Dispatch]) -> Task:
    item = record(data, where, "decision", "path", "obligation", "state", "starts", "broken")
    dispatch = chosen(dispatches, item["decision"], f"{where}.decision")
    task, group = _found(dispatch.roots, item["path"], f"{where}.path")
    if item["obligation"] != task.name:
        refuse_malformed(f"{where}.obligation", item["obligation"], f"{task.name}, which is at its path")
    if item["state"] not in (("in force",) if task.literal.negated else ("waiting", "under way")):
        refuse_malformed(f"{where}.state", item["state"], "a state of a pending obligation")
    if type(item["broken"]) is not bool or (item["broken"] and not task.literal.negated):
        refuse_malformed(f"{where}.broken", item["broken"], "true for a prohibition only, or false")
    if dispatch.code is None and may_run_code(task):
        refuse_malformed(f"{where}.decision", item["decision"], "a decision with arguments")
    if task.path in dispatch.open:
        refuse_malformed(f"{where}.path", item["path"], "pending once")
    if item["starts"] is not None:
        starts = number_at(item["starts"], f"{where}.starts")
        if item["state"] != "waiting" or starts < 0:
            refuse_malformed(f"{where}.starts", item["starts"], "a number from 0 on, of what is waiting")
        dispatch.starts[task] = starts
    if task.path[:-1] not in dispatch.groups:
        dispatch.groups[task.path[:-1]] = group
        for one in group:
            # Over, unless the data have it as pending.
            one.state = "over" if one.literal.negated else "done"
    dispatch.open[task.path] = task
    task.state = item["state"]
    task.broken = item["broken"]
    return task


def _found(group: tuple[Task, ...], path: object, where: str) -> tuple[Task, tuple[Task, ...]]:
    """The task at `path`, and its response."""
    if type(path) is not list or len(path) % 2 == 0:
        refuse_malformed(where, path, "a path to an obligation of the rule")
    task = chosen(group, path[0], where)
    for kind, index in zip(path[1::2], path[2::2]):
        group = {"otherwise": task.otherwise, "else": task.instead}.get(kind if type(kind) is str else "") or ()
        task = chosen(group, index, where)
    return task, group


def _left_out(data: object, where: str) -> tuple[str, str]:
    item = record(data, where, "rule", "obligation")
    if type(item["rule"]) is not str or type(item["obligation"]) is not str:
        refuse_malformed(where, data, "the names of a rule and an obligation")
    return item["rule"], item["obligation"]
