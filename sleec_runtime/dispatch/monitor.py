"""The online monitor: what a dispatch executed, against what the rules oblige in its context."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from types import TracebackType
from typing import TYPE_CHECKING, Any, TypeVar

from sleec_runtime.dispatch.dispatch import Done, Plan, run, run_async
from sleec_runtime.dispatch.implementations import Recording, recording, watched
from sleec_runtime.errors import WrongType
from sleec_runtime.evaluation.evaluation import Decision, Due, decide
from sleec_runtime.support.messages import listed

if TYPE_CHECKING:
    from sleec_runtime.dispatch.runtime import Sleec
    from sleec_runtime.dispatch.snapshot import Snapshot
    from sleec_runtime.model import Context, Obligation

T = TypeVar("T")


@dataclass(frozen=True)
class Difference:
    """A dispatch that did not do what was due: `due` and `executed` in order, a name once for each rule that asks for
    it. What raised counts as not executed, and as begun where it is prohibited."""

    context: Context
    due: tuple[str, ...]
    executed: tuple[str, ...]
    missing: tuple[str, ...]
    unexpected: tuple[str, ...]
    prohibited: tuple[str, ...]

    def __str__(self) -> str:
        parts = [
            f"{what}: {listed(names)}"
            for what, names in (
                ("not executed", self.missing),
                ("executed, and not due", self.unexpected),
                ("executed, and prohibited", self.prohibited),
            )
            if names
        ]
        order = f"executed {listed(self.executed)} where {listed(self.due)} was due"
        return f"{' and '.join(sorted(self.context.triggers))}: {'; '.join(parts) or order}"


class Monitor:
    """Looks at every dispatch of a running instance, and calls `on_difference` where what was executed is not what was
    due, in the order in which it was due.

    What is due is decided afresh from the rules and the context, not taken from the dispatch. An obligation with a
    window that another execution fulfils, for example that of another thread, is not missing. Executions are seen of
    callables marked with ``@obligation``, of those given to `implement`, and of the snake-case methods of bound objects
    and of those in `watch`. What a variant hands to another thread is not seen, nor what an inner trigger executes,
    which is looked at for itself, nor what the clock starts: what goes wrong there is in `Sleec.failures`. If
    `on_difference` raises, the trigger does.

    Cost: once more the evaluation of the rules of the trigger, and a note for each execution; see docs/runtime.md for
    figures. One monitor at a time.
    """

    def __init__(
        self, sleec: Sleec, on_difference: Callable[[Difference], object], watch: Iterable[object] = ()
    ) -> None:
        if not callable(on_difference):
            raise WrongType("on_difference", on_difference, "a callable", "give a function that takes a Difference")
        self._sleec = sleec
        self._on_difference = on_difference
        self._watch = tuple(watch)
        self._watched: dict[int, tuple[object, set[str]]] = {}
        self._on = ExitStack()

    def start(self) -> Monitor:
        """Raises SleecError if another monitor is on, or if an object to be watched takes no attributes."""
        self._sleec.hold(self._start)
        return self

    def _start(self, snapshot: Snapshot) -> None:
        with ExitStack() as undo:
            self._sleec.attach(self)
            undo.callback(self._sleec.detach, self)
            self._watch_with(undo, (*self._sleec.bound_objects(), *self._watch), snapshot.program.whole.obligations)
            self._on = undo.pop_all()

    def watch(self, robots: Iterable[object], obligations: Iterable[str]) -> None:
        """Sees the executions of `robots` too, which were bound since, and of obligations that came since."""
        self._watch_with(self._on, (*robots, *self._watch), obligations)

    def _watch_with(self, until: ExitStack, robots: Iterable[object], obligations: Iterable[str]) -> None:
        for robot in robots:
            _, seen = self._watched.setdefault(id(robot), (robot, set()))
            until.enter_context(watched(robot, [name for name in obligations if name not in seen]))
            seen.update(obligations)

    def stop(self) -> None:
        """Dispatches under way are still looked at."""
        self._on.close()
        self._watched.clear()

    def __enter__(self) -> Monitor:
        return self.start()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def run(self, plan: Plan, snapshot: Snapshot, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Done:
        """`dispatch.run`, looked at, unless it is refused before anything runs."""
        plan.refuse_misfits(args, kwargs)
        plan.refuse_coroutines()
        with recording(apart=True) as seen:
            try:
                return run(plan, snapshot, args, kwargs)
            finally:
                self._compare(plan.triggers, snapshot, seen)

    async def run_async(self, plan: Plan, snapshot: Snapshot, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Done:
        """`dispatch.run_async`, looked at, unless it is refused before anything runs."""
        plan.refuse_misfits(args, kwargs)
        with recording(apart=True) as seen:
            try:
                return await run_async(plan, snapshot, args, kwargs)
            finally:
                self._compare(plan.triggers, snapshot, seen)

    @contextmanager
    def looking(
        self,
        triggers: tuple[str, ...],
        snapshot: Snapshot,
        chained: Collection[str],
        fulfilled: Sequence[tuple[str, Obligation]],
    ) -> Iterator[None]:
        """Looks at a dispatch of rules with times, which is that of the block: at what it starts at once.

        `chained` are the responses that are events, and trigger rules when they are done. `fulfilled` are the
        obligations of the dispatch that another execution fulfils, each with the label of its rule; it is read when the
        block ends.
        """
        with recording(apart=True) as seen:
            try:
                yield
            finally:
                self._compare(triggers, snapshot, seen, chained, fulfilled)

    def _compare(
        self,
        triggers: tuple[str, ...],
        snapshot: Snapshot,
        seen: Recording,
        chained: Collection[str] = (),
        fulfilled: Sequence[tuple[str, Obligation]] = (),
    ) -> None:
        context = snapshot.context(triggers)
        decisions = list(_decided(triggers, snapshot, fulfilled))
        happened = set(triggers)
        for decision in decisions:
            for literal in decision.obligations:
                if literal.name in chained and literal.name not in happened and not literal.negated:
                    happened.add(literal.name)
                    decisions += _decided((literal.name,), snapshot, fulfilled, triggers)
        due = Due(tuple(decisions))
        in_order = tuple(o.name for decision in due.decisions for o in decision.obligations if not o.negated)
        executed = _without(seen.executed, seen.failed)
        prohibited = tuple(name for name in dict.fromkeys(seen.executed) if name in due.prohibitions)
        if executed != in_order or prohibited:
            self._on_difference(
                Difference(
                    context,
                    in_order,
                    executed,
                    missing=tuple(name for name in dict.fromkeys(in_order) if name not in executed),
                    unexpected=tuple(
                        name for name in dict.fromkeys(executed) if name not in in_order and name not in prohibited
                    ),
                    prohibited=prohibited,
                )
            )


def _decided(
    triggers: tuple[str, ...],
    snapshot: Snapshot,
    fulfilled: Sequence[tuple[str, Obligation]],
    others: tuple[str, ...] = (),
) -> Iterator[Decision]:
    """What the rules of `triggers` say where `others` occur as well, in their order: what counts at once, without what
    is `fulfilled`."""
    program = snapshot.program
    context = snapshot.context((*triggers, *others))
    rules = sorted(
        (rule for trigger in triggers for rule in program.cells[program.number_of[trigger]]),
        key=lambda rule: program.order[rule.label],
    )
    for rule in rules:
        decision = decide(rule, context, program.ruleset.reading, program.measures)
        if decision is not None:
            at_once = tuple(o for o in decision.obligations if _counts_at_once(o, snapshot.conditions))
            own = [(rule.label, o) for o in at_once]
            yield replace(decision, obligations=tuple(o for _, o in _without(own, fulfilled)))


def _counts_at_once(obligation: Obligation, conditions: Mapping[str, Any]) -> bool:
    window = None if obligation.timing is None else obligation.timing.window
    return window is None or window.start is None or window.start.seconds_where(conditions) == 0


def _without(items: Iterable[T], others: Iterable[T]) -> tuple[T, ...]:
    """`items` without `others`: the first one of each is left out, as often as it is in `others`."""
    rest = list(others)
    kept = []
    for item in items:
        if item in rest:
            rest.remove(item)
        else:
            kept.append(item)
    return tuple(kept)
