"""All responses to one situation, judged by the evaluator of the runtime: a second way to see that none complies.

The events of a response are tried at the instants at which a window begins or ends, and after a prohibition. An event
of a complying response can be moved to such an instant, because nothing changes between two of them (the regions of
R. Alur and D. Dill, "A theory of timed automata", Theoretical Computer Science 126, 1994).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import product

from sleec_runtime.evaluation.trace import Instant, Trace, Untimed
from sleec_runtime.model import (
    Atom,
    Clause,
    Comparison,
    Context,
    Lasting,
    Obligation,
    Rule,
    Ruleset,
    Value,
    formulas_of,
    in_text_order,
    leaves,
    literals,
)
from sleec_verify.encoding.relations import Relation, events_of, formulas_of_relation
from sleec_verify.encoding.response_windows import ResponseWindows
from sleec_verify.replay.trace_evaluator import RUNTIME
from sleec_verify.traces.trace import TraceInstant

MOST_RESPONSES = 1 << 13
"""The most responses that are tried."""

MOST_INSTANTS = 12
"""The most instants at which the events of a response are tried."""


def complies(ruleset: Ruleset, instants: Sequence[TraceInstant], untimed: Untimed) -> bool:
    """Whether the evaluator accepts a trace: it violates no statement of `ruleset`."""
    return not RUNTIME.violations(ruleset, Trace(tuple(Instant(*instant) for instant in instants)), untimed)


def none_complies(
    ruleset: Ruleset, history: Sequence[TraceInstant], mere_inputs: Collection[str], untimed: Untimed
) -> bool | None:
    """Whether the evaluator rejects every response to a history. Its last instant is now, where more events can occur,
    and any events later. None if too many responses would have to be tried.

    All statements of `ruleset` count. Mere inputs that the history does not have occur only later.
    """
    now = history[-1]
    acts = {o.name for rule in ruleset.rules for clause in rule.clauses() for o in literals(clause)}
    relations: list[Relation] = [one for one in ruleset.statements if not isinstance(one, Rule)]  # type: ignore[misc]
    acts |= {event for relation in relations for event in events_of(relation)}
    acts |= {name for rule in ruleset.rules for kind, name in _names(rule) if kind == "trigger"}
    times = _times(ruleset, history, untimed)
    if times is None:
        return None
    later = list(_values(ruleset, relations, acts, now)) if len(times) > 1 else [now.conditions]
    if not later:
        return None
    places = [(now.time, event) for event in sorted(acts - now.events - set(mere_inputs))]
    places += [(time, event) for time in times[1:] for event in sorted(acts)]
    if len(later) ** (len(times) - 1) << len(places) > MOST_RESPONSES:
        return None
    return not any(not RUNTIME.violations(ruleset, trace, untimed) for trace in _traces(places, history, later))


def _traces(
    places: Sequence[tuple[int, str]], history: Sequence[TraceInstant], later: Sequence[Mapping[str, Value]]
) -> Iterator[Trace]:
    """The history with each response: some of the events at these places, with some of the values at later instants."""
    *before, now = history
    past = tuple(Instant(*instant) for instant in before)
    for chosen in product((False, True), repeat=len(places)):
        events: dict[int, set[str]] = {now.time: set(now.events)}
        for (time, event), occurs in zip(places, chosen):
            if occurs:
                events.setdefault(time, set()).add(event)
        times = sorted(events)
        for values in product(later, repeat=len(times) - 1):
            given = (now.conditions, *values)
            yield Trace((*past, *(Instant(time, frozenset(events[time]), v) for time, v in zip(times, given))))


def _times(ruleset: Ruleset, history: Sequence[TraceInstant], untimed: Untimed) -> list[int] | None:
    """The instants from now on at which something can change. If rules can follow each other, they are sums and
    differences of lengths. None if there are too many."""
    now = history[-1].time
    times = {now}
    every: set[int] = set()
    for instant in history:
        steps = _steps(ruleset, instant, untimed)
        if steps is None:
            return None
        every |= steps
        times |= {instant.time + step for step in steps if instant.time + step > now}
    triggers = {rule.trigger for rule in ruleset.rules}
    links = sum(any(o.name in triggers for c in rule.clauses() for o in literals(c)) for rule in ruleset.rules)
    for _ in range(links if every else 0):
        times |= {
            time + sign * step for time in times for step in every for sign in (-1, 1) if time + sign * step > now
        }
        if len(times) > MOST_INSTANTS:
            return None
    return sorted(times)


def _steps(ruleset: Ruleset, instant: TraceInstant, untimed: Untimed) -> set[int] | None:
    """The lengths of time after an instant at which its rules change what is due. None if one is not known."""
    windows = ResponseWindows(ruleset, Context(instant.events, instant.conditions), untimed)
    steps: set[int] = set()
    for rule in ruleset.rules:
        for top in rule.clauses():
            for clause in (top, *_alternatives(top.obligations)):
                for one in windows.of(clause):
                    if one.start is None:
                        return None
                    ends = [one.start, *(() if one.end is None else (one.end,))]
                    if one.obligation.negated:
                        ends = [one.start - 1, *(() if one.end is None else (one.end + 1,))]
                    steps.update(ends if one.end != 0 else ())
                    if one.end is None:
                        steps.add(one.start + 1)
    for relation in ruleset.statements:
        if isinstance(relation, Lasting):
            length = None if relation.duration is None else relation.duration.seconds
            if relation.duration is not None and length is None:
                return None
            steps.add(1 if length is None else int(length))
    return steps


def _alternatives(obligations: Iterable[Obligation]) -> Iterator[Clause]:
    for obligation in obligations:
        for clause in () if obligation.timing is None else obligation.timing.alternatives():
            for member in in_text_order(clause):
                yield member
                yield from _alternatives(member.obligations)


def _values(
    ruleset: Ruleset, relations: Iterable[Relation], acts: Collection[str], now: TraceInstant
) -> Iterator[Mapping[str, Value]]:
    """The values that later instants can have, for each combination of the conditions that can matter there. None if
    measures matter."""
    formulas = [formula for relation in relations for formula in formulas_of_relation(relation)]
    formulas += [formula for rule in ruleset.rules if rule.trigger in acts for formula in formulas_of(rule)]
    found = [leaf for formula in formulas for leaf in leaves(formula)]
    if any(isinstance(leaf, Comparison) for leaf in found):
        return
    names = sorted({leaf.name for leaf in found if isinstance(leaf, Atom) and leaf.kind == "condition"})
    for chosen in product((False, True), repeat=len(names)):
        yield {**now.conditions, **dict(zip(names, chosen))}


def _names(rule: Rule) -> Iterator[tuple[str, str]]:
    for formula in formulas_of(rule):
        yield from ((leaf.kind, leaf.name) for leaf in leaves(formula) if isinstance(leaf, Atom))
