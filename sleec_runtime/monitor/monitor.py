"""The online monitor."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from types import TracebackType
from typing import Protocol

from sleec_runtime.dispatch.implementations import watched
from sleec_runtime.dispatch.recording import recording
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import WrongType
from sleec_runtime.model import Obligation
from sleec_runtime.monitor.difference import Difference, difference


class Monitored(Protocol):
    """What a monitor needs of an instance: a `Sleec`."""

    def hold(self, act: Callable[[Snapshot], None]) -> None:
        """Calls `act` with the current context, which does not change meanwhile."""
        ...

    def attach(self, monitor: Monitor) -> None:
        """Lets `monitor` observe each dispatch. Raises SleecError if another monitor does."""
        ...

    def detach(self, monitor: Monitor) -> None:
        """Undoes `attach`."""
        ...

    def bound_objects(self) -> list[object]:
        """The objects whose methods are bound to rules."""
        ...


class Monitor:
    """Observes each dispatch of an instance, and calls `on_difference` if it does not execute what is due, in order.

    The monitor decides what is due again, from the rules and the context. An obligation with a window that another
    execution fulfils, for example that of another thread, is not missing. The monitor sees the executions of callables
    marked with ``@obligation``, of those given to `implement`, and of the snake-case methods of bound objects and of
    the objects in `watch`. It does not see other threads and what the clock starts, whose errors are in
    `Sleec.failures`. It observes inner triggers separately. If `on_difference` raises, the trigger does.

    Cost: one more evaluation of the rules of the trigger, and a record of each execution; docs/runtime.md has figures.
    An instance has at most one monitor.
    """

    def __init__(
        self, sleec: Monitored, on_difference: Callable[[Difference], object], watch: Iterable[object] = ()
    ) -> None:
        if not callable(on_difference):
            raise WrongType("on_difference", on_difference, "a callable", "give a function that takes a Difference")
        self._sleec = sleec
        self._on_difference = on_difference
        self._watch = tuple(watch)
        self._watched: dict[int, tuple[object, set[str]]] = {}
        self._on = ExitStack()

    def start(self) -> Monitor:
        """Starts to observe. Raises SleecError if another monitor is on, or if a watched object accepts no
        attributes."""
        self._sleec.hold(self._start)
        return self

    def _start(self, snapshot: Snapshot) -> None:
        with ExitStack() as undo:
            self._sleec.attach(self)
            undo.callback(self._sleec.detach, self)
            self._watch_with(undo, (*self._sleec.bound_objects(), *self._watch), snapshot.index.whole.obligations)
            self._on = undo.pop_all()

    def watch(self, robots: Iterable[object], obligations: Iterable[str]) -> None:
        """Also observes `robots` that are bound later, and `obligations` of later rules."""
        self._watch_with(self._on, (*robots, *self._watch), obligations)

    def _watch_with(self, until: ExitStack, robots: Iterable[object], obligations: Iterable[str]) -> None:
        for robot in robots:
            _, seen = self._watched.setdefault(id(robot), (robot, set()))
            until.enter_context(watched(robot, [name for name in obligations if name not in seen]))
            seen.update(obligations)

    def stop(self) -> None:
        """Stops. Dispatches that have begun are still observed."""
        self._on.close()
        self._watched.clear()

    def __enter__(self) -> Monitor:
        return self.start()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    @contextmanager
    def observe(
        self,
        triggers: tuple[str, ...],
        snapshot: Snapshot,
        chained: Collection[str] = (),
        fulfilled: Sequence[tuple[str, Obligation]] = (),
    ) -> Iterator[None]:
        """Observes a dispatch, which is that of the block. The parameters are those of `difference`; `fulfilled` is
        read when the block ends."""
        with recording(apart=True) as seen:
            try:
                yield
            finally:
                found = difference(triggers, snapshot, seen, chained, fulfilled)
                if found is not None:
                    self._on_difference(found)
