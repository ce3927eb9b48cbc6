"""The requirements of the rules in a course: what each triggering demands and forbids, and from when to when."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from sleec_runtime.model import Context, Rule, Ruleset, Value
from sleec_verify.conformance.scenarios.compiled_rules import CompiledRules
from sleec_verify.conformance.scenarios.course import Course
from sleec_verify.encoding.response_windows import ResponseWindows, WindowedResponse
from sleec_verify.encoding.trace_scope import Untimed

_KEPT = 4096


@dataclass(eq=False)
class Requirement:
    """A response of an active clause, with its window in seconds of the course; no `last`: at some time.

    The rule was triggered at the happening `place`, at the time `since`. `otherwise` are the requirements that replace
    it when its window closes unfulfilled. `choices` are groups, each of which may be fulfilled in its place.
    """

    rule: Rule
    clause: int
    response: WindowedResponse
    since: int
    place: int
    act: int
    first: int
    last: int | None
    replaces: Requirement | None = None
    overdue: bool = False
    otherwise: list[Requirement] = field(default_factory=list)
    choices: list[Requirement] = field(default_factory=list)

    @property
    def name(self) -> str:
        return self.response.obligation.name

    @property
    def negated(self) -> bool:
        return self.response.obligation.negated

    @property
    def at_once(self) -> bool:
        """Whether its window is one instant."""
        return self.first == self.last

    @property
    def of_its_trigger(self) -> bool:
        """Whether its window is the instant of its trigger."""
        return self.at_once and self.first == self.since

    def covers(self, time: int) -> bool:
        """Whether its window contains `time`."""
        return self.first <= time and (self.last is None or time <= self.last)


class Requirements:
    """What the rules of a ruleset require when events occur. Answers are kept."""

    def __init__(self, ruleset: Ruleset, untimed: Untimed = "at") -> None:
        self._ruleset = ruleset
        self._untimed = untimed
        self._compiled = CompiledRules(ruleset)
        self._by_trigger: dict[str, list[Rule]] = {}
        for rule in ruleset.rules:
            self._by_trigger.setdefault(rule.trigger, []).append(rule)
        self._known: dict[object, tuple[tuple[Rule, int, tuple[WindowedResponse, ...]], ...]] = {}

    def triggers(self, name: str) -> bool:
        """Whether an event triggers a rule."""
        return name in self._by_trigger

    def decided(
        self, names: Iterable[str], events: frozenset[str], values: Mapping[str, Value]
    ) -> tuple[tuple[Rule, int, tuple[WindowedResponse, ...]], ...]:
        """For each rule that the events `names` trigger and whose guard holds: its active clause, and the responses
        with windows relative to now. `events` are all events of now."""
        key = tuple(sorted(names)), events, tuple(sorted(values.items(), key=lambda item: item[0]))
        found = self._known.get(key)
        if found is None:
            if len(self._known) >= _KEPT:
                self._known.clear()
            found = self._known[key] = tuple(self._decided(key[0], Context(events, values)))
        return found

    def _decided(
        self, names: Iterable[str], context: Context
    ) -> Iterator[tuple[Rule, int, tuple[WindowedResponse, ...]]]:
        windows = ResponseWindows(self._ruleset, context, self._untimed)
        for name in names:
            for rule in self._by_trigger.get(name, ()):
                number = self._compiled.clause(rule, context)
                if number is not None:
                    yield rule, number, tuple(windows.of(list(rule.clauses())[number]))

    def of_course(self, course: Course) -> Iterator[Requirement]:
        """All requirements in a course, each before its alternatives."""
        events: dict[int, set[str]] = {}
        for time, name in course.occurrences():
            events.setdefault(time, set()).add(name)
        for place, one in enumerate(course.happenings):
            if one.kind in ("occurs", "done"):
                decided = self.decided(one.names, frozenset(events[one.at]), course.values_at(one.at))
                for rule, clause, responses in decided:
                    yield from _requirements(rule, clause, responses, one.at, place, one.act)


def _requirements(
    rule: Rule, clause: int, responses: Iterable[WindowedResponse], since: int, place: int, act: int
) -> Iterator[Requirement]:
    made: dict[int, Requirement] = {}
    for one in responses:
        if one.start is None:
            continue  # The length of its window is a measure without a value.
        last = None if one.end is None else since + one.end
        replaces = None if one.instead is None else made[id(one.instead)]
        found = Requirement(rule, clause, one, since, place, act, since + one.start, last, replaces)
        if replaces is not None:
            # What is due at one instant or at some time, and its alternative, are a choice.
            found.overdue = one.overdue and not replaces.at_once and replaces.last is not None
            (replaces.otherwise if found.overdue else replaces.choices).append(found)
        made[id(one)] = found
        yield found
