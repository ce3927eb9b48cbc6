"""The goals of a set of scenarios: those of situations, at the instant of a trigger, and those that windows add.

- A window is **met at the first second**, and **met at the last second**.
- A response is **missed** or **replaced**, so that its alternative is due: one goal for each clause of the
  alternative's chain, and the goals of the windows of that clause.
- A prohibition is **in force at the last second**: the event is required from that second on, and occurs one second
  later.
- A prohibition is **over one second later**: the event is required from then on, and occurs at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from sleec_runtime.language import print_formula
from sleec_runtime.model import Clause, Obligation, Rule, Timing, in_text_order, obligation_text
from sleec_verify.conformance.cases.goals import clause_name
from sleec_verify.conformance.scenarios.lawful_traces import LawfulTraces, fixed_window
from sleec_verify.conformance.scenarios.windows import WindowRef
from sleec_verify.traces.demands import Occurs
from sleec_verify.traces.index import TraceIndex

Literals = Callable[[LawfulTraces], Sequence[int]]
"""A function from a question to literals that together imply a goal."""


class TraceGoal(NamedTuple):
    """Something that a trace can reach. `situation` is about the instant `now` alone. It is asked first, because
    `windows` may add instants. Of the goals about one `response`, a trace reaches one at most. Unless it
    `is_startable`, an obligation is forbidden at the instant of its trigger, and only possible later. `window` is the
    one that it meets or misses."""

    name: str
    situation: Literals
    windows: Literals
    response: str = ""
    is_startable: bool = True
    window: WindowRef | None = None


def trace_goals(world: LawfulTraces, criterion: str) -> list[TraceGoal]:
    """The goals of all rules for a criterion of situations, except those of `LawfulTraces.unbounded`. Raises
    `Undecided`."""
    found: list[TraceGoal] = []
    for position in range(len(world.index.rules)):
        for number, goal in enumerate(world.situations(criterion, position)):

            def situation(other: LawfulTraces, position: int = position, number: int = number) -> list[int]:
                return [other.situations(criterion, position)[number].literal]

            found.append(TraceGoal(goal.name, situation, _nothing))
        if world.index.rules[position].label not in world.unbounded:
            found += _goals_of_windows(world, position)
    return list({goal.name: goal for goal in found}.values())


def _nothing(world: LawfulTraces) -> Sequence[int]:
    return ()


class _Response(NamedTuple):
    """A response in the words of the goals. It is due `after` seconds after now if `given` and `unmet` hold."""

    said: str
    obligation: Obligation
    given: Literals
    window: WindowRef
    unmet: tuple[Occurs, ...] = ()
    after: int = 0


def _goals_of_windows(world: LawfulTraces, position: int) -> Iterator[TraceGoal]:
    rule = world.index.rules[position]
    for number, clause in enumerate(world.index.clauses[position]):

        def decides(other: LawfulTraces, number: int = number) -> list[int]:
            return [other.guards(position)[number]]

        for obligation in clause.obligations:
            said = f"{clause_name(rule, number)}: {_words(obligation)}"
            window = WindowRef(rule.label, number, obligation_text(obligation))
            yield from _goals_of_response(world.traces, _Response(said, obligation, decides, window))


def _goals_of_response(traces: TraceIndex, one: _Response) -> Iterator[TraceGoal]:
    obligation, after = one.obligation, one.after
    lengths = traces.lengths.cases(obligation)
    if lengths is not None:
        yield from _shortest_and_longest(traces, one, lengths)
        return
    start, end = traces.responses.window(obligation)
    window = Occurs(obligation.name, after + start, None if end is None else after + end)
    timing = obligation.timing or Timing()
    if timing.window is not None:
        yield from _forbidden(traces, one, window) if obligation.negated else _required(one, window)
    unmet = (*one.unmet, window._replace(negated=not obligation.negated))
    if timing.otherwise is not None:
        closed = after if timing.window is None or end is None else after + end
        yield from _alternative(traces, one, "missed", unmet, timing.otherwise, closed)
    if timing.instead is not None:
        yield from _alternative(traces, one, "replaced", unmet, timing.instead, after)


def _shortest_and_longest(traces: TraceIndex, one: _Response, lengths: Clause) -> Iterator[TraceGoal]:
    """The goals of a response whose length is a measure, for its least and its greatest value."""
    members = list(in_text_order(lengths))
    for number in sorted({0, len(members) - 1}):

        def decides(world: LawfulTraces, number: int = number) -> list[int]:
            return [*one.given(world), world.chain(lengths)[number]]

        (obligation,) = members[number].obligations
        said = f"{one.said} ({_words(obligation).removeprefix(f'{obligation} ')})"
        yield from _goals_of_response(traces, one._replace(said=said, obligation=obligation, given=decides))


def _required(one: _Response, window: Occurs) -> Iterator[TraceGoal]:
    yield _goal(one, "met at the first second", window._replace(end=window.start))
    if window.end is not None and window.end != window.start:
        before = window._replace(end=window.end - 1, negated=True)
        yield _goal(one, "met at the last second", window._replace(start=window.end), before)


def _forbidden(traces: TraceIndex, one: _Response, window: Occurs) -> Iterator[TraceGoal]:
    if window.end is None:
        return
    last = window.end
    asking = list(_asking(traces, window.event))
    done = Occurs(window.event, last + 1, last + 1)
    waiting = [(rule, number, last - start) for rule, number, start, can_wait in asking if can_wait]
    at_once = [(rule, number, last + 1 - start) for rule, number, start, _ in asking]
    for what, ways in (("in force at the last second", waiting), ("over one second later", at_once)):
        if ways:
            yield TraceGoal(
                f"{one.said} {what}",
                one.given,
                lambda world, ways=ways: [  # type: ignore[misc]
                    *(world.occurs(each) for each in (*one.unmet, done)),
                    world.one_decides(ways),
                ],
                is_startable=ways is not waiting,
            )


def _asking(traces: TraceIndex, event: str) -> Iterator[tuple[Rule, int, int, bool]]:
    """The rules and clauses that require an event, with the start of its window, and whether it may occur later."""
    for rule in traces.obliging.get(event, ()):
        for number, clause in enumerate(rule.clauses()):
            for obligation in clause.obligations:
                window = fixed_window(traces, obligation)
                if window is not None and obligation.name == event and not obligation.negated:
                    yield rule, number, window[0], window[1] != window[0]


def _alternative(
    traces: TraceIndex, one: _Response, what: str, unmet: tuple[Occurs, ...], clause: Clause, after: int
) -> Iterator[TraceGoal]:
    """The goals of an alternative, in traces in which the response itself is not met."""
    members = list(in_text_order(clause))
    for number, member in enumerate(members):

        def decides(world: LawfulTraces, number: int = number) -> list[int]:
            return [*one.given(world), world.chain(clause)[number]]

        case = "default" if member.condition is None else print_formula(member.condition)
        said = f"{one.said} {what}" + (f" ({case})" if len(members) > 1 else "")
        missed = one.window._replace(missed=True)
        yield _goal(_Response(said, one.obligation, decides, missed, unmet), "")
        for obligation in member.obligations:
            window = one.window._replace(response=obligation_text(obligation))
            inner = _Response(f"{said}, {_words(obligation)}", obligation, decides, window, unmet, after)
            yield from _goals_of_response(traces, inner)


def _goal(one: _Response, what: str, *occurs: Occurs) -> TraceGoal:
    return TraceGoal(
        f"{one.said} {what}".rstrip(),
        one.given,
        lambda world: [world.occurs(each) for each in (*one.unmet, *occurs)],
        one.said if occurs else "",
        window=one.window,
    )


def _words(obligation: Obligation) -> str:
    """The response itself with its window, without its alternatives."""
    window = None if obligation.timing is None else obligation.timing.window
    return str(obligation) if window is None else f"{obligation} {window}"
