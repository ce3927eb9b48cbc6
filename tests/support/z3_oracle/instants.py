"""Instants of a trace with symbolic times, for z3."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import z3

from sleec_runtime.model import (
    Ruleset,
)

TRUE, FALSE = z3.BoolVal(True), z3.BoolVal(False)


def every(parts: Iterable[Any]) -> Any:
    """As z3.And, which looks at the sort of each part first: that took most of the time of the tests."""
    return _joined(z3.Z3_mk_and, parts)


def some(parts: Iterable[Any]) -> Any:
    """As z3.Or, likewise."""
    return _joined(z3.Z3_mk_or, parts)


def _joined(make: Callable[..., Any], parts: Iterable[Any]) -> Any:
    found = [part.ast for part in parts]
    return z3.BoolRef(make(z3.main_ctx().ref(), len(found), (z3.Ast * len(found))(*found)))


class Moment(NamedTuple):
    """An instant of a model: as plain values."""

    time: int
    events: frozenset[str]
    conditions: dict[str, Any]


class Answer(NamedTuple):
    """`found` as in the table of checks. `moments` is the trace that shows what is answered, if there is one:

    one that breaks the rule and nothing else (not redundant), one in which it is triggered (not vacuous), one with the
    concern (found), one with the purpose (not found), the history (conflict found; its last moment is now).
    """

    found: bool
    moments: tuple[Moment, ...] | None = None


class Undecided(Exception):
    """z3 gave up, or the refinement took too many rounds."""


# Instants -------------------------------------------------------------------------------------------------


class Instant:
    """A symbolic instant: its variables have its name in theirs, so that those nobody asks for do not exist."""

    def __init__(self, ruleset: Ruleset, name: str) -> None:
        self.ruleset, self.name = ruleset, name
        self.time = z3.Int(f"{name}.time")
        self.used = z3.Bool(f"{name}.used")
        self._events: dict[str, Any] = {}

    def event(self, name: str) -> Any:
        found = self._events.get(name)
        if found is None:
            found = self._events[name] = z3.Bool(f"{self.name}.event.{name}")
        return found

    def condition(self, name: str) -> Any:
        return z3.Bool(f"{self.name}.condition.{name}")

    def measure(self, name: str) -> Any:
        """A number, or a place in a scale."""
        sort = z3.Real if self.ruleset.measures[name].kind == "number" else z3.Int
        return sort(f"{self.name}.measure.{name}")

    def possible(self) -> Any:
        """That its time and its scales have values."""
        scales = [m for m in self.ruleset.measures.values() if m.kind == "scale"]
        inside = [z3.And(self.measure(m.name) >= 0, self.measure(m.name) < len(m.values)) for m in scales]
        return z3.And(self.time >= 0, *inside)


class Extended(Instant):
    """An instant with more events, and else as another."""

    def __init__(self, base: Instant, name: str) -> None:
        super().__init__(base.ruleset, name)
        self.base, self.time, self.used = base, base.time, base.used

    def event(self, name: str) -> Any:
        return some((self.base.event(name), super().event(name)))

    def condition(self, name: str) -> Any:
        return self.base.condition(name)

    def measure(self, name: str) -> Any:
        return self.base.measure(name)


class Known(Instant):
    """An instant whose values are known, but for `time`; of a model, to be tried elsewhere."""

    def __init__(self, instant: Instant, model: Any, time: Any) -> None:
        super().__init__(instant.ruleset, instant.name)
        self.instant, self.model, self.time = instant, model, time
        self.used = model.eval(instant.used, model_completion=True)

    def event(self, name: str) -> Any:
        return TRUE if z3.is_true(self.model.eval(self.instant.event(name), model_completion=True)) else FALSE

    def condition(self, name: str) -> Any:
        return self.model.eval(self.instant.condition(name), model_completion=True)

    def measure(self, name: str) -> Any:
        return self.model.eval(self.instant.measure(name), model_completion=True)


class More(Extended):
    """An instant with the further events of a model."""

    def __init__(self, base: Instant, extended: Extended, model: Any) -> None:
        super().__init__(base, extended.name)
        self.model = model

    def event(self, name: str) -> Any:
        return z3.Or(self.base.event(name), self.model.eval(z3.Bool(f"{self.name}.event.{name}"), True))


Instants = Sequence[Instant]


def ordered(instants: Instants, first_used: bool) -> Any:
    """Times that increase; the instants that are not used are the last ones, or the first."""
    parts = [instant.possible() for instant in instants]
    for earlier, later in pairwise(instants):
        parts.append(z3.Implies(z3.And(earlier.used, later.used), earlier.time < later.time))
        parts.append(z3.Implies(later.used, earlier.used) if first_used else z3.Implies(earlier.used, later.used))
    return z3.And(parts)
