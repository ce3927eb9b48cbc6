"""The ledger: atomic changes of the agenda and of the alarm for its next entry."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial, wraps
from itertools import count
from typing import Concatenate, NamedTuple, ParamSpec, Protocol, TypeVar

from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.concurrency.fork import renew_after_fork
from sleec_runtime.errors import Forked
from sleec_runtime.timed.agenda import Agenda, Entry
from sleec_runtime.timed.clock import Cancel, CheckedClock, Time
from sleec_runtime.timed.task import State, Task
from sleec_runtime.timed.unit import Unit

T = TypeVar("T")
P = ParamSpec("P")


class Action(NamedTuple):
    """Something to do after a change. If it is interrupted before it has `begun`, it is done later."""

    do: Callable[[], object]
    begun: Callable[[], bool]


class Ledger:
    """The agenda, the states of its tasks, and the alarm for its next entry, which calls `tick`.

    All of them are changed within `change`, by the methods from `undo_by` to `after`.
    """

    def __init__(self, clock: CheckedClock, tick: Callable[[], object]) -> None:
        self.agenda = Agenda()
        self.clock = clock
        self.closed = False
        self.actions: deque[Action] = deque()
        """The actions that are decided and not begun, in order."""
        self._tick = tick
        self._section = CriticalSection(partial(self._undo_to, 0))
        self._numbers = count()
        self._undo: list[Callable[[], object]] = []
        self._new_actions: list[Action] = []
        self._woken_at: Time | None = None
        self._cancel: Cancel | None = None
        self._forked = False
        renew_after_fork(self)

    # Changes --------------------------------------------------------------------------------------------------

    def change(self, make: Callable[[], T]) -> T:
        """Makes an atomic change by `make`: no other thread sees a part of it, and an error undoes all of it.

        Raises Reentrant within another change, and Forked in a process that was forked while something was pending.
        """
        if self._forked:
            raise Forked
        return self._section.run(partial(self._change, make))

    def look(self, at: Callable[[], T]) -> T:
        """As `change`, also in a forked process, for a call that starts nothing."""
        return self._section.run(partial(self._change, at))

    def _change(self, make: Callable[[], T]) -> T:
        self._undo, self._new_actions = [], []
        try:
            result = make()
            self._rewake()
            self.actions.extend(self._new_actions)
        except BaseException:
            self._undo_to(0)
            with suppress(Exception):  # the error of the clock is raised instead
                self._rewake()
            raise
        self._undo = []
        self.agenda.tidy()
        return result

    def after_fork(self) -> None:
        """Leaves the pending obligations and the decided actions to the parent process."""
        self._section.after_fork()
        self._forked = self._forked or any(True for _ in self.agenda)
        self.actions.clear()
        self._woken_at = self._cancel = None

    def refuse_reentry(self) -> None:
        """Raises Reentrant within a change of this thread."""
        self._section.refuse_reentry()

    def attempt(self, make: Callable[[], T]) -> T:
        """A part of a change, which is undone if it raises."""
        changes, acts = len(self._undo), len(self._new_actions)
        try:
            return make()
        except BaseException:
            self._undo_to(changes)
            del self._new_actions[acts:]
            raise

    def _undo_to(self, changes: int) -> None:
        while len(self._undo) > changes:
            self._undo.pop()()

    # Within a change ------------------------------------------------------------------------------------------

    def undo_by(self, undo: Callable[[], object]) -> None:
        """Calls `undo` if this change fails. To be called before the change, so that nothing comes between."""
        self._undo.append(undo)

    def set(self, of: object, attribute: str, value: object) -> None:
        """Sets an attribute, for example of a task."""
        self.undo_by(partial(setattr, of, attribute, getattr(of, attribute)))
        setattr(of, attribute, value)

    def add(self, task: Task) -> None:
        """Adds an open task to the agenda."""
        task.number = next(self._numbers)
        self.undo_by(partial(self.agenda.remove, task))
        self.agenda.add(task)

    def end(self, task: Task, state: State) -> None:
        """Ends a task with this state."""
        self.set(task, "state", state)
        if task in self.agenda:
            self.undo_by(partial(self.agenda.add, task))
            self.agenda.remove(task)

    def schedule(self, at: Time, kind: int, tasks: Iterable[Task], unit: Unit | None = None) -> None:
        """Adds a timer event at the time `at`, which counts if one of `tasks` is open then."""
        entry = Entry(at, kind, next(self._numbers), tuple(tasks), unit)
        self.undo_by(partial(self.agenda.drop, entry))
        self.agenda.insert(entry)

    def note(self, name: str, own: Task | None = None) -> tuple[list[Task], list[Task]]:
        """`name` happens now. Returns the obligations that it fulfils, and the prohibitions without alternatives that
        it breaks."""
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

    def decide_next(self, decide: Callable[[Entry], object]) -> bool:
        """Takes the first entry whose time has come, and calls `decide` with it. False if there is none."""
        # The alarm may have gone off.
        self._woken_at = None
        entry = None if self.closed else self.agenda.next_entry()
        if entry is None or entry.at > self.clock.now():
            return False
        self.undo_by(partial(self.agenda.insert, entry))
        self.agenda.drop(entry)
        decide(entry)
        return True

    def close(self) -> None:
        """Stops all timer events."""
        self.closed = True

    def after(self, action: Action) -> None:
        """Does `action` after the change."""
        self._new_actions.append(action)

    def do_next(self) -> bool:
        """Does the first action, outside of a change. False if there is none."""
        try:
            action = self.actions[0]
        except IndexError:
            return False
        try:
            self.actions.remove(action)
        except ValueError:  # another thread does it
            return True
        except BaseException:
            self._put_back(action)
            raise
        try:
            action.do()
        except BaseException:
            if not action.begun():
                self._put_back(action)
            raise
        return True

    def wake_for_actions(self) -> None:
        """Sets an alarm for the remaining actions."""
        if self.actions:
            self.clock.wake(self.clock.now(), self._tick)

    def _put_back(self, action: Action) -> None:
        if action not in self.actions:
            self.actions.appendleft(action)

    def _rewake(self) -> None:
        """Sets an alarm for the next entry, unless it is set already."""
        entry = None if self.closed or self._forked else self.agenda.next_entry()
        at = None if entry is None else entry.at
        # An alarm whose time has come may be lost: its call was interrupted before it did anything.
        if at == self._woken_at and (at is None or at > self.clock.now()):
            return
        # The new alarm first: an additional one does no harm.
        cancel, self._cancel = self._cancel, None if at is None else self.clock.wake(at, self._tick)
        self._woken_at = at
        if cancel is not None:
            cancel()


class _HasLedger(Protocol):
    _ledger: Ledger


S = TypeVar("S", bound=_HasLedger)


def transaction(method: Callable[Concatenate[S, P], T]) -> Callable[Concatenate[S, P], T]:
    """Makes a method one change of the ledger of its object."""

    @wraps(method)
    def change(self: S, /, *args: P.args, **kwargs: P.kwargs) -> T:
        return self._ledger.change(partial(method, self, *args, **kwargs))

    return change
