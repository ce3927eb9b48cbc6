"""What is open, and when the clock is to wake for it: changed as a whole or not at all."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from itertools import count
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.concurrency.fork import renew_after_fork
from sleec_runtime.errors import Forked
from sleec_runtime.timed.agenda import Agenda, Entry

if TYPE_CHECKING:
    from sleec_runtime.timed.bounds import CheckedClock
    from sleec_runtime.timed.clocks import Cancel, Time
    from sleec_runtime.timed.tasks import State, Task

T = TypeVar("T")


class Act(NamedTuple):
    """Something to do outside of a change. If it is interrupted and has not `begun`, it is done later."""

    do: Callable[[], object]
    begun: Callable[[], bool]


class Ledger:
    """The agenda, the states of the tasks on it, and the clock that wakes for it: `tick` is called then.

    All of it is changed within `change`, by the methods from `undo_by` to `after`.
    """

    def __init__(self, clock: CheckedClock, tick: Callable[[], object]) -> None:
        self.agenda = Agenda()
        self.clock = clock
        self.closed = False
        self.acts: deque[Act] = deque()
        """What has been decided to be done, first to last."""
        self._tick = tick
        self._section = CriticalSection(partial(self._undo_to, 0))
        self._numbers = count()
        self._undo: list[Callable[[], object]] = []
        self._new_acts: list[Act] = []
        self._woken_at: Time | None = None
        self._cancel: Cancel | None = None
        self._forked = False
        renew_after_fork(self)

    # Changes --------------------------------------------------------------------------------------------------

    def change(self, make: Callable[[], T]) -> T:
        """Makes one change, by `make`. If that raises, all is as it was before. No other thread sees part of it. Raises
        Reentrant within another change, and Forked in a process that was forked while something was pending."""
        if self._forked:
            raise Forked
        return self._section.run(partial(self._change, make))

    def look(self, at: Callable[[], T]) -> T:
        """As `change`, for what starts nothing: in a forked process, too."""
        return self._section.run(partial(self._change, at))

    def _change(self, make: Callable[[], T]) -> T:
        self._undo, self._new_acts = [], []
        try:
            result = make()
            self._rewake()
            self.acts.extend(self._new_acts)
        except BaseException:
            self._undo_to(0)
            with suppress(Exception):  # the clock has failed, and this is what is raised
                self._rewake()
            raise
        self._undo = []
        self.agenda.tidy()
        return result

    def after_fork(self) -> None:
        """What is pending is up to the process that was forked, and so is what it had decided to do."""
        self._section.after_fork()
        self._forked = self._forked or any(True for _ in self.agenda)
        self.acts.clear()
        self._woken_at = self._cancel = None

    def refuse_reentry(self) -> None:
        """Raises Reentrant within a change of this thread."""
        self._section.refuse_reentry()

    def attempt(self, make: Callable[[], T]) -> T:
        """A part of a change, which undoes what it has changed if it raises."""
        changes, acts = len(self._undo), len(self._new_acts)
        try:
            return make()
        except BaseException:
            self._undo_to(changes)
            del self._new_acts[acts:]
            raise

    def _undo_to(self, changes: int) -> None:
        while len(self._undo) > changes:
            self._undo.pop()()

    # Within a change ------------------------------------------------------------------------------------------

    def undo_by(self, undo: Callable[[], object]) -> None:
        """Has `undo` called if this change is not made. Call it before the change, so that nothing comes between."""
        self._undo.append(undo)

    def set(self, of: object, attribute: str, value: object) -> None:
        """Sets an attribute, of a task for example."""
        self.undo_by(partial(setattr, of, attribute, getattr(of, attribute)))
        setattr(of, attribute, value)

    def add(self, task: Task) -> None:
        """It is open from now on."""
        task.number = next(self._numbers)
        self.undo_by(partial(self.agenda.remove, task))
        self.agenda.add(task)

    def end(self, task: Task, state: State) -> None:
        """It is over, and what it is then."""
        self.set(task, "state", state)
        if task in self.agenda:
            self.undo_by(partial(self.agenda.add, task))
            self.agenda.remove(task)

    def schedule(self, at: Time, kind: int, tasks: Iterable[Task], decide: Callable[[Time], object]) -> None:
        """Has `decide` come up at the time `at`, if any of `tasks` is open then; it is given that time."""
        entry = Entry(at, kind, next(self._numbers), tuple(tasks), decide)
        self.undo_by(partial(self.agenda.drop, entry))
        self.agenda.insert(entry)

    def note(self, name: str, own: Task | None = None) -> tuple[list[Task], list[Task]]:
        """`name` happens now: the obligations that are done by it, and the prohibitions that it breaks, with nothing in
        their place."""
        now = self.clock.now()
        discharged = [task for task in self.agenda.to_do(name) if task.covers(now)]
        if own is not None and own.at_once and own not in discharged:
            discharged.append(own)
        for task in discharged:
            self.end(task, "done")
        broken = self.agenda.prohibitions(name, now)
        for task in broken:
            self.set(task, "broken", True)
        return discharged, [task for task in broken if task.is_decided]

    def decide_next(self) -> bool:
        """Decides what has come up first. False if nothing has."""
        # The alarm that is set may have gone off.
        self._woken_at = None
        entry = None if self.closed else self.agenda.next_entry()
        if entry is None or entry.at > self.clock.now():
            return False
        self.undo_by(partial(self.agenda.insert, entry))
        self.agenda.drop(entry)
        entry.decide(entry.at)
        return True

    def close(self) -> None:
        """Nothing comes up any more."""
        self.closed = True

    def after(self, act: Act) -> None:
        """Has `act` done once the change is made, outside of it."""
        self._new_acts.append(act)

    def do_next(self) -> bool:
        """Does what is to be done first, outside of a change; False if there is nothing."""
        try:
            act = self.acts[0]
        except IndexError:
            return False
        try:
            self.acts.remove(act)
        except ValueError:  # another thread does it
            return True
        except BaseException:
            self._put_back(act)
            raise
        try:
            act.do()
        except BaseException:
            if not act.begun():
                self._put_back(act)
            raise
        return True

    def wake_for_acts(self) -> None:
        """Has the clock wake for what is left to be done."""
        if self.acts:
            self.clock.wake(self.clock.now(), self._tick)

    def _put_back(self, act: Act) -> None:
        if act not in self.acts:
            self.acts.appendleft(act)

    def _rewake(self) -> None:
        """Has the clock wake for what comes next, if that is not what it wakes for already."""
        entry = None if self.closed or self._forked else self.agenda.next_entry()
        at = None if entry is None else entry.at
        # An alarm whose time has come may have been lost: what it called was interrupted before it did anything.
        if at == self._woken_at and (at is None or at > self.clock.now()):
            return
        # The new alarm first: one too many does no harm.
        cancel, self._cancel = self._cancel, None if at is None else self.clock.wake(at, self._tick)
        self._woken_at = at
        if cancel is not None:
            cancel()
