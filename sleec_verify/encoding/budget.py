"""Budgets: how much work a file, a check or a question may take.

Work is counted in steps: literals that the solver propagates, clauses, iterations of a loop. A step takes about a
microsecond. The same text always takes the same steps, so a budget of steps ends at the same place on every machine. A
timeout is a time instead. The budget is a context variable, and code that works calls `spend`:

    with limited(seconds=60):
        results = run_checks(ruleset)
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from copy import copy
from time import monotonic
from typing import NoReturn

from sleec_runtime.errors import SleecError
from sleec_verify.wording.sentence import plural, sentence

FILE = 3_500_000
"""Steps for one ruleset. Rulesets that people write need a thousandth of it."""

PER_CHARACTER = 150
"""Additional steps for each character of the text, because large rulesets may take long."""

LEAST = 1_000
"""The steps, or microseconds, that must be left to start something new."""


class Undecided(SleecError):
    """A question that was given up. A check turns it into the verdict `Unknown`, which is never a pass."""


class OutOfBudget(Undecided):
    """A question that was given up because its budget is spent."""


class Budget:
    """A number of steps, or the time until a deadline."""

    def __init__(self, reason: str, steps: float = float("inf"), deadline: float = float("inf")) -> None:
        """`reason` is the message if the budget is not sufficient. `deadline` is a value of `time.monotonic`."""
        self.reason = reason
        self.steps = steps
        """The steps that are left."""
        self._deadline = deadline
        self.is_timed = deadline != float("inf")
        self.ran_out = False
        """Whether it, or a part of it, was not sufficient for something."""
        self.whole = self
        """The budget of which this is a part."""

    def spend(self, steps: float) -> None:
        """Count steps. Raises `OutOfBudget` if fewer are left, or the deadline has passed."""
        self.steps -= steps
        if self.steps < 0 or (self.is_timed and monotonic() > self._deadline):
            self.give_up()

    def give_up(self) -> NoReturn:
        """Raises OutOfBudget."""
        self.ran_out = True
        raise OutOfBudget(self.reason)

    def seconds(self) -> float:
        """The time that is left, in seconds."""
        return max(self._deadline - monotonic(), 0)

    def left(self) -> float:
        """What is left: seconds if there is a deadline, otherwise steps."""
        return self.seconds() if self.is_timed else self.steps

    def is_spent(self) -> bool:
        """Whether too little is left to start anything."""
        return self.steps < LEAST or (self.is_timed and self.seconds() < LEAST / 1e6)

    def part(self, part: float) -> Budget:
        """A budget with this fraction of what is left."""
        found = copy(self)
        found._deadline = monotonic() + self.seconds() * part if self.is_timed else self._deadline
        found.steps = max(self.steps, 0) * part
        found.ran_out = False
        return found


class InterruptibleBudget(Budget):
    """A budget for work that can be cancelled: `interrupt` then raises an exception."""

    def __init__(
        self, interrupt: Callable[[], None], reason: str, steps: float = float("inf"), deadline: float = float("inf")
    ) -> None:
        super().__init__(reason, steps, deadline)
        self._interrupt = interrupt

    def spend(self, steps: float) -> None:
        """Count steps, as every budget does, or raise the exception of `interrupt`."""
        self._interrupt()
        super().spend(steps)


_current: ContextVar[Budget | None] = ContextVar("budget", default=None)


def current() -> Budget | None:
    """The current budget, or None."""
    return _current.get()


def spend(steps: float) -> None:
    """Count steps of the current budget. Raises `OutOfBudget` if it is spent."""
    budget = _current.get()
    if budget is not None:
        budget.spend(steps)


@contextmanager
def limited(seconds: float, interrupt: Callable[[], None] | None = None) -> Iterator[None]:
    """Limit the time of the block, in place of the budget of each file. Anything undecided by then is unknown.
    `interrupt` is called again and again; its exception ends the work.

    A file is always read completely.
    """
    reason = plural(
        1 if seconds == 1 else 2,
        "the timeout of 1 second has passed",
        "the timeout of {seconds} seconds has passed",
        seconds=f"{seconds:g}",
    )
    deadline = monotonic() + seconds
    with _using(
        Budget(reason, deadline=deadline)
        if interrupt is None
        else InterruptibleBudget(interrupt, reason, deadline=deadline)
    ):
        yield


@contextmanager
def limited_to_steps(steps: int, reason: str) -> Iterator[Budget]:
    """Limit the steps of the block, unless there is a budget already. `reason` is the message if they are not
    sufficient."""
    budget = _current.get()
    if budget is not None:
        yield budget
        return
    budget = Budget(reason, steps)
    with _using(budget):
        yield budget


@contextmanager
def for_file(characters: int, interrupt: Callable[[], None] | None = None) -> Iterator[None]:
    """Use the budget for a text with this number of characters, unless there is a budget already. `interrupt` is
    called again and again; its exception ends the work."""
    if _current.get() is not None:
        yield
        return
    steps = steps_for(characters)
    with _using(Budget(FILE_SPENT, steps) if interrupt is None else InterruptibleBudget(interrupt, FILE_SPENT, steps)):
        yield


def steps_for(characters: int) -> int:
    """The budget for a text with this number of characters, in steps."""
    return FILE + PER_CHARACTER * characters


FILE_SPENT = sentence("the limit of steps for one file is reached; use --timeout SECONDS to allow more")


def begin() -> None:
    """Raises `OutOfBudget` if too little is left of the current budget to start anything."""
    budget = _current.get()
    if budget is not None and budget.is_spent():
        budget.give_up()


class share:  # noqa: N801
    """Limit the block to this fraction of what is left of the current budget. Unused steps return to it."""

    __slots__ = ("_given", "_inner", "_outer", "_part", "_token")

    def __init__(self, part: float) -> None:
        self._part = part

    def __enter__(self) -> Budget:
        self._outer = outer = _current.get()
        self._inner = inner = Budget("") if outer is None else outer.part(self._part)
        self._given = inner.steps
        self._token = None if outer is None else _current.set(inner)
        return inner

    def __exit__(self, *_: object) -> None:
        outer = self._outer
        if outer is not None and self._token is not None:
            _current.reset(self._token)
            outer.ran_out |= self._inner.ran_out
            if not outer.is_timed:
                outer.steps -= self._given - self._inner.steps


@contextmanager
def _using(budget: Budget) -> Iterator[None]:
    token = _current.set(budget)
    try:
        yield
    finally:
        _current.reset(token)


@contextmanager
def as_far_as_decided() -> Iterator[None]:
    """Continue after the block if a question in it is undecided, unless the budget is spent."""
    try:
        yield
    except OutOfBudget:
        raise
    except Undecided:
        pass
