"""Mappings: they turn the messages of any robot into observations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from sleec_runtime.audit.message_field import NoSuchField
from sleec_runtime.audit.moment import UNKNOWN_DOMAIN
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, RawMessage, Reported
from sleec_runtime.audit.raw_value import raw_text
from sleec_runtime.audit.source import GOAL_STATES, Source, Unsuitable
from sleec_runtime.errors import MappingError
from sleec_runtime.model import Rational, Value
from sleec_runtime.support.messages import represent


@dataclass(frozen=True)
class Misfit:
    """A message that does not fit a source of the mapping. The value of the source is then unknown."""

    time: Rational
    source: Source
    message: str


class TopicMapping:
    """The sources of a mapping, and the state of earlier messages: the last results of comparisons, and the goals that
    have reached their state.

    If the observation begins `late`, the first message of a source gives its initial state: no condition becomes true,
    and no goal reaches its state.
    """

    def __init__(self, sources: Iterable[Source], late: bool = False) -> None:
        self.late = late
        self.sources = tuple(sources)
        self._by_topic: dict[str, list[int]] = {}
        for number, source in enumerate(self.sources):
            self._by_topic.setdefault(source.topic, []).append(number)
        self._held: dict[int, bool | None] = {}
        self._goals: dict[int, set[str]] = {}

    @property
    def topics(self) -> frozenset[str]:
        """The topics of the sources."""
        return frozenset(self._by_topic)

    @property
    def has_domain(self) -> bool:
        """Whether a source gives the domain."""
        return any(source.kind == "domain" for source in self.sources)

    def named(self, *kinds: str) -> frozenset[str]:
        """The names of the sources of these kinds."""
        return frozenset(source.name for source in self.sources if source.kind in kinds)

    def observations(self, message: RawMessage) -> Iterator[Observation | Misfit]:
        """What a message means: first the domain and the reported values, then events and executions."""
        reported: dict[str, Value | None] = {}
        happened: list[Observation] = []
        for number in self._by_topic.get(message.topic, ()):
            source = self.sources[number]
            value: Value | None = None
            try:
                if source.kind in ("event", "obligation"):
                    happened += self._happened(number, source, message)
                    continue
                value = self._value(number, source, message)
            except (NoSuchField, Unsuitable) as problem:
                yield Misfit(message.time, source, str(problem))
            if source.kind in ("condition", "measure"):
                reported[source.name] = value
            elif source.kind == "domain":
                yield Entered(message.time, value or None if isinstance(value, str) else UNKNOWN_DOMAIN)
        if reported:
            yield Reported(message.time, reported)
        yield from happened

    def state(self) -> Any:
        """The state of earlier messages, as plain data."""
        held = [[number, held] for number, held in self._held.items()]
        return {"held": held, "goals": [[number, sorted(goals)] for number, goals in self._goals.items()]}

    def restore(self, state: Any) -> None:
        """The inverse of `state`. Raises MappingError for other data."""
        try:
            self._held = {int(number): held for number, held in state["held"]}
            self._goals = {int(number): set(goals) for number, goals in state["goals"]}
        except (KeyError, TypeError, ValueError):
            raise MappingError(f"{represent(state)} is not the state of a mapping") from None

    def _value(self, number: int, source: Source, message: RawMessage) -> Value | None:
        assert source.path is not None
        raw = source.path.value(message.fields)
        if source.kind != "condition":
            return source.value(raw)
        held = source.holds(raw, self._held.get(number))
        self._held[number] = held
        return held

    def _happened(self, number: int, source: Source, message: RawMessage) -> list[Observation]:
        kind = Occurred if source.kind == "event" else Executed
        if source.goal is not None:
            return [kind(message.time, source.name)] * self._reached(number, source, message)
        if source.path is None:
            return [kind(message.time, source.name)]
        before = self._held.get(number, None if self.late else False)
        held = source.holds(source.path.value(message.fields), before)
        if held is not None:
            self._held[number] = held
        return [kind(message.time, source.name)] if held and (source.each or before is False) else []

    def _reached(self, number: int, source: Source, message: RawMessage) -> int:
        """How many goals reach the state of the source for the first time."""
        assert source.goal is not None
        assert source.path is not None
        goals = source.path.value(message.fields)
        if not isinstance(goals, (list, tuple)):
            raise Unsuitable(f"`{source.path.text}` is not a list of goals; it is {raw_text(goals)}")
        is_known = number in self._goals or not self.late
        before = self._goals.get(number, set())
        now = set()
        for goal in goals:
            try:
                if goal["status"] in GOAL_STATES[source.goal]:
                    now.add(repr(list(goal["goal_info"]["goal_id"]["uuid"])))
            except (KeyError, TypeError):
                raise Unsuitable(f"{raw_text(goal)} is not the status of a goal") from None
        self._goals[number] = now
        return len(now - before) if is_known else 0
