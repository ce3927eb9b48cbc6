"""What one response asks for, in times of the clock: all of it is settled at the trigger.

Hedges behind `otherwise` and `else` are decided, and lengths that a measure says are read, in the context of the
trigger; so the whole tree of what may become due is known before anything runs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, Union

from sleec_runtime.errors import UndeterminedDecision, WrongType
from sleec_runtime.evaluation.evaluation import Decision, Situation, Undetermined, walk
from sleec_runtime.model import Clause, Length, Obligation, Rational, Rule
from sleec_runtime.timed.bounds import FURTHEST

if TYPE_CHECKING:
    from sleec_runtime.dispatch.instance import Instance
    from sleec_runtime.dispatch.snapshot import Snapshot
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.execution_plan import Unit

Path = tuple[Union[int, str], ...]

State = Literal["waiting", "under way", "done", "missed", "replaced", "withdrawn", "in force", "over"]
"""Of an obligation: its window is not open, or it is held back; started; done; its window closed, or it failed, with
nothing in its place; something is due in its place; called for by what did not happen. Of a prohibition: in force, or
over."""

_LENGTH = f"the length of a window, from 0 to {FURTHEST:,} seconds"

_OPEN: frozenset[State] = frozenset({"waiting", "under way", "in force"})


@dataclass(frozen=True, eq=False)
class Origin:
    """A rule that spoke at `moment`, and what all that it asks for is done with, until it is over: the context and
    rules, the code, the arguments, and the `triggers` that occurred, of that moment."""

    decision: Decision
    moment: Time
    snapshot: Snapshot
    instance: Instance
    args: tuple[Any, ...] = ()
    kwargs: Mapping[str, Any] = field(default_factory=dict)
    triggers: frozenset[str] = frozenset()

    @property
    def rule(self) -> Rule:
        return self.decision.rule


class Task:
    """One literal that is due from `first` to `last` on the clock (None: whenever), and what may come in its place.

    `at_once`: it is not watched, because nothing but the moment counts: without a window, or with one of length 0. What
    is due at once and takes time has no deadline that could be kept, and is pending without one.

    `path` is its place in the response: the index of an obligation of the clause, then, for what is due in the place of
    another, "otherwise" or "else" and the index there. `unit` is what starts it; None once it has been started, or
    given up. `conditional`: it is due only if an event happens that has not happened yet. `number` is higher than that
    of what was put on the agenda before.
    """

    __slots__ = (
        "at_once",
        "broken",
        "conditional",
        "first",
        "instead",
        "last",
        "literal",
        "number",
        "origin",
        "otherwise",
        "path",
        "state",
        "unit",
    )

    def __init__(
        self, literal: Obligation, origin: Origin, first: Time, last: Time | None, at_once: bool, path: Path
    ) -> None:
        self.literal = literal
        self.origin = origin
        self.first = first
        self.last = last
        self.at_once = at_once
        self.path = path
        self.otherwise: tuple[Task, ...] | None = None
        self.instead: tuple[Task, ...] | None = None
        self.state: State = "in force" if literal.negated else "waiting"
        self.broken = False
        self.unit: Unit | None = None
        self.conditional = False
        self.number = 0

    @property
    def name(self) -> str:
        return self.literal.name

    @property
    def is_alternative(self) -> bool:
        """Whether it is due in the place of another."""
        return len(self.path) > 1

    @property
    def is_open(self) -> bool:
        """Whether it is on the agenda, or about to be."""
        return self.state in _OPEN

    def state_at(self, now: Time) -> State:
        """`state`; a prohibition is over when its window is, though the agenda may still hold it."""
        if self.state == "in force" and self.last is not None and self.last < now:
            return "over"
        return self.state

    def is_open_at(self, now: Time) -> bool:
        """Whether it is still to be done, or still forbidden."""
        return self.state_at(now) in _OPEN

    @property
    def is_decided(self) -> bool:
        """Whether nothing may come in its place."""
        return self.otherwise is None and self.instead is None

    def covers(self, time: Time) -> bool:
        return self.first <= time and (self.last is None or time <= self.last)

    def counts_at(self, now: Time) -> bool:
        """Whether it is due, or forbidden, at `now`, the time at which it is called for or comes up."""
        return self.covers(now) or (self.at_once and self.first <= now)

    def covers_all(self, first: Time, last: Time | None) -> bool:
        """Whether its window holds all times from `first` to `last`."""
        return self.first <= first and (self.last is None or (last is not None and last <= self.last))


def tasks_of(obligations: Sequence[Obligation], due: Time, origin: Origin, path: Path = ()) -> tuple[Task, ...]:
    """What `obligations` ask for if they are due from the time `due` on; `path` leads to them.

    O(size of the responses). Raises UndeterminedDecision if a hedge of theirs, or the length of a window, depends on
    what nobody reported, and WrongType for a length that is none.
    """
    return tuple(_task(obligation, due, origin, (*path, index)) for index, obligation in enumerate(obligations))


def _task(obligation: Obligation, due: Time, origin: Origin, path: Path) -> Task:
    timing = obligation.timing
    window = None if timing is None else timing.window
    last: Time | None
    if window is None:
        first, last, at_once = due, None, True
    else:
        start = 0 if window.start is None else _seconds(window.start, origin)
        first = due + start
        if window.end is None:
            last, at_once = None, False
        else:
            end = _seconds(window.end, origin)
            if end < start:
                raise WrongType(
                    str(window.end), end, f"the end of a window that starts after {start} seconds", "end it later"
                )
            # A window of no length is kept by starting in it.
            last, at_once = due + end, end == start
    task = Task(obligation, origin, first, last, at_once, path)
    if timing is not None and timing.otherwise is not None:
        over = due if last is None else last
        task.otherwise = tasks_of(_active(timing.otherwise, origin), over, origin, (*path, "otherwise"))
    if timing is not None and timing.instead is not None:
        task.instead = tasks_of(_active(timing.instead, origin), due, origin, (*path, "else"))
    return task


def _active(clause: Clause, origin: Origin) -> tuple[Obligation, ...]:
    """What a chain of its own obliges, such as one behind `otherwise`: as a rule with nothing but that chain."""
    program = origin.snapshot.program
    situation = Situation(origin.snapshot.context(origin.triggers), program.measures, None if program.strict else False)
    outcome = walk(Rule("", "", None, clause, ()), situation, program.ruleset.reading)
    if isinstance(outcome, Undetermined):
        raise UndeterminedDecision((origin.rule.trigger,), outcome.missing)
    assert outcome is not None, "a rule without a guard always speaks"
    return outcome.obligations


def _seconds(length: Length, origin: Origin) -> Rational:
    values = {}
    for name in length.measures:
        value = origin.snapshot.conditions.get(name)
        if value is None:
            raise UndeterminedDecision((origin.rule.trigger,), (name,), f"report {name} with update(): it is how long")
        if isinstance(value, (bool, str)):
            raise WrongType(name, value, _LENGTH)
        values[name] = value
    found = length.seconds_where(values)
    if not 0 <= found <= FURTHEST:
        raise WrongType(str(length), found, _LENGTH)
    return found
