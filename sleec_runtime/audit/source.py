"""Sources: which messages mean a condition, a measure, an event or an execution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isinf
from typing import Literal

from sleec_runtime.audit.message_field import FieldPath
from sleec_runtime.audit.raw_value import raw_text
from sleec_runtime.model import Rational, Value, exact

SourceKind = Literal["domain", "condition", "measure", "event", "obligation"]
GoalState = Literal["accepted", "executing", "succeeded", "canceled", "aborted"]
GOAL_STATES: Mapping[GoalState, frozenset[int]] = {
    "accepted": frozenset({1, 2, 3, 4, 5, 6}),
    "executing": frozenset({2}),
    "succeeded": frozenset({4}),
    "canceled": frozenset({5}),
    "aborted": frozenset({6}),
}
"""The states of a goal, and their numbers in action_msgs/msg/GoalStatus. A goal in any later state was accepted."""


class Unsuitable(Exception):
    """A value that is not what a source expects. The text says why."""


@dataclass(frozen=True)
class Source:
    """One entry of a mapping: the messages on `topic` that mean `name`. `where` is its place in the file.

    `path` is that of the field with the value; without one, each message counts. A number is multiplied by `scale`, and
    `offset` is added. The value is compared: it is above or below a bound, or equals a value. A comparison that was
    true stays true up to the bound `until` (hysteresis). `values` names raw values. With `each`, each message for which
    the value is true is an event; otherwise, an event occurs when it becomes true. `goal` is the state of an action's
    goals that counts.
    """

    where: str
    kind: SourceKind
    name: str
    topic: str
    path: FieldPath | None = None
    scale: Rational = 1
    offset: Rational = 0
    above: Rational | None = None
    below: Rational | None = None
    until: Rational | None = None
    equals: object = None
    values: Mapping[str, object] = field(default_factory=dict)
    each: bool = False
    goal: GoalState | None = None

    def value(self, raw: object) -> Value | None:
        """The value of a condition, measure or domain that a raw value means; None if it is unknown, as NaN is. Raises
        Unsuitable."""
        if _is_missing(raw):
            return None
        if self.values:
            for name, expected in self.values.items():
                if _same(raw, expected):
                    return name
            raise Unsuitable(f"`values` has no name for {raw_text(raw)}")
        if isinstance(raw, str) and self.kind in ("measure", "domain"):
            return raw
        if self.kind == "domain":
            raise Unsuitable(f"{raw_text(raw)} is not a text; name the domains with `values`")
        return self._number(raw)

    def holds(self, raw: object, before: bool | None) -> bool | None:
        """Whether a raw value makes the condition or event true; None if it is unknown, as NaN is. `before` is the last
        answer. A bound can be compared with infinity, which range sensors send if nothing is near (REP 117). Raises
        Unsuitable."""
        if _is_missing(raw):
            return None
        if self.equals is not None:
            if _form(raw) != _form(self.equals):
                raise Unsuitable(f"{raw_text(raw)} is not {_form(self.equals)}, as in `equals`")
            return _same(raw, self.equals)
        if self.above is None and self.below is None:
            if isinstance(raw, bool):
                return raw
            raise Unsuitable(f"{raw_text(raw)} is not true or false; compare it with `equals`, `above` or `below`")
        number: Rational | float
        if isinstance(raw, float) and isinf(raw) and self.scale:
            number = raw if self.scale > 0 else -raw
        else:
            number = self._number(raw)
        bound = self.until if before and self.until is not None else None
        if self.above is not None:
            return number > (self.above if bound is None else bound)
        assert self.below is not None
        return number < (self.below if bound is None else bound)

    def _number(self, raw: object) -> Rational:
        number = exact(raw)
        if number is None:
            raise Unsuitable(f"{raw_text(raw)} is not a number")
        return number * self.scale + self.offset


def _is_missing(raw: object) -> bool:
    """Whether a raw value is null or NaN."""
    return raw is None or (isinstance(raw, float) and raw != raw)


def _form(value: object) -> str | None:
    """What a value can be compared with; None for a list or a mapping."""
    if isinstance(value, bool):
        return "true or false"
    if isinstance(value, str):
        return "a text"
    return "a number" if isinstance(value, float) or exact(value) is not None else None


def _same(raw: object, expected: object) -> bool:
    if isinstance(raw, (bool, str)) or isinstance(expected, (bool, str)):
        return type(raw) is type(expected) and raw == expected
    number = exact(raw)
    return number is not None and number == exact(expected)
