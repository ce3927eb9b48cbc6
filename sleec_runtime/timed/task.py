"""Tasks: the obligations and prohibitions of one trigger, in times of the clock."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol, Union

from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.model import Obligation, Rule
from sleec_runtime.timed.clock import Time

Path = tuple[Union[int, str], ...]


State = Literal["waiting", "under way", "done", "missed", "replaced", "withdrawn", "in force", "over"]
"""The state of an obligation or a prohibition.

Of an obligation: "waiting" before it is started; "under way" once it is started; "done"; "missed" if its window closed
or its code failed, without an alternative; "replaced" by an alternative; "withdrawn" if the event that asks for it did
not happen. Of a prohibition: "in force" or "over".
"""


_OPEN: frozenset[State] = frozenset({"waiting", "under way", "in force"})


@dataclass(frozen=True, eq=False)
class Origin:
    """The decision of a rule at the time `moment`, and what its tasks use until they are over: the context and rules,
    the code, the arguments, and the `triggers` that occurred."""

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


class Start(Protocol):
    """What starts a task: a `Unit`."""

    at: Time


class Task:
    """A literal that is due from `first` to `last` on the clock (None: no end), and its alternatives.

    `at_once`: its window is missing or has length 0, so that only the time of the trigger counts. An obligation that is
    due at once and takes time is pending without a deadline.

    `path` is its place in the response: the index of an obligation of the clause; then, for an alternative, "otherwise"
    or "else" and the index there. `unit` starts it, and is None after that. `conditional`: it is due only if an event
    happens that has not happened yet. Tasks that enter the agenda later have a higher `number`.
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
        self.unit: Start | None = None
        self.conditional = False
        self.number = 0

    @property
    def name(self) -> str:
        return self.literal.name

    @property
    def is_alternative(self) -> bool:
        """Whether it is an alternative to another task."""
        return len(self.path) > 1

    @property
    def is_open(self) -> bool:
        """Whether it is on the agenda, or about to enter it."""
        return self.state in _OPEN

    def state_at(self, now: Time) -> State:
        """`state`. A prohibition is over when its window is over, even if the agenda still holds it."""
        if self.state == "in force" and self.last is not None and self.last < now:
            return "over"
        return self.state

    def is_open_at(self, now: Time) -> bool:
        """Whether the obligation is still to be done, or the prohibition still in force."""
        return self.state_at(now) in _OPEN

    @property
    def is_decided(self) -> bool:
        """Whether it has no alternatives."""
        return self.otherwise is None and self.instead is None

    def covers(self, time: Time) -> bool:
        """Whether its window contains `time`."""
        return self.first <= time and (self.last is None or time <= self.last)

    def counts_at(self, now: Time) -> bool:
        """Whether it is due, or forbidden, at `now`, the time of its trigger or of its start."""
        return self.covers(now) or (self.at_once and self.first <= now)

    def covers_all(self, first: Time, last: Time | None) -> bool:
        """Whether its window contains all times from `first` to `last`."""
        return self.first <= first and (self.last is None or (last is not None and last <= self.last))
