"""A trace as a witness: what happens when, and what is due until when."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from sleec_runtime.model import Rule, Value, formulas_of, in_text_order, names_of
from sleec_runtime.model_time import described
from sleec_verify.timed.needs import Decided
from sleec_verify.timed.responses import occurrences
from sleec_verify.timed.unfolding import Unfolding


@dataclass(frozen=True)
class Due:
    """What a rule calls for at some moment: in words, and the window of its event in seconds of the timeline. No `end`:
    at some time."""

    rule: str
    clause: int
    words: str
    event: str
    negated: bool
    start: int
    end: int | None


@dataclass(frozen=True)
class Moment:
    """One instant: its time in seconds, the events that occur, and the conditions and measures that were looked at, of
    which those in `telling` bear on what is due."""

    time: int
    events: tuple[str, ...]
    conditions: Mapping[str, Value]
    telling: tuple[str, ...]
    due: tuple[Due, ...] = ()


@dataclass(frozen=True)
class Timeline:
    """Moments in the order of time. `now` is the place of the one at which a rule is triggered that leaves no way to go
    on; what comes after it is open. Without it, the timeline is a whole trace."""

    moments: tuple[Moment, ...]
    now: int | None = None


def timeline(unfolding: Unfolding) -> Timeline:
    """The trace of the last `ask`."""
    schedule, _ = unfolding.schedule()
    moments = []
    for number in sorted(unfolding.used(), key=lambda n: schedule[n]):
        decided = [d for d in unfolding.decided if d.at == number and unfolding.true(d.guard)]
        conditions = dict(sorted(unfolding.values(number).items()))
        due = _due(unfolding, decided, schedule[number])
        events = tuple(sorted(unfolding.happening(number)))
        moments.append(Moment(schedule[number], events, conditions, tuple(conditions), due))
    return Timeline(tuple(moments))


def excerpt(unfolding: Unfolding, chosen: Iterable[tuple[int, Sequence[Rule]]], now: int) -> Timeline:
    """Some instants of the beginning of the trace of the last `ask`, each with the rules that speak there."""
    prepared = [(at, rules, [d for rule in rules for d in unfolding.deciding(at, rule)]) for at, rules in chosen]
    again = unfolding.ask()
    assert again, "to look at what decides changes no answer"
    moments = []
    for at, rules, decided in prepared:
        fixed = unfolding.instants[at].fixed
        assert fixed is not None, "what is shown is the beginning"
        named = {name for rule in rules for formula in formulas_of(rule) for name in names_of(formula)}
        conditions = dict(sorted({**unfolding.values(at), **fixed.conditions}.items()))
        telling = tuple(name for name in conditions if name in named)
        due = _due(unfolding, [d for d in decided if unfolding.true(d.guard)], fixed.time)
        moments.append(Moment(fixed.time, tuple(sorted(fixed.events)), conditions, telling, due))
    return Timeline(tuple(moments), now)


def _due(unfolding: Unfolding, decided: Iterable[Decided], time: int) -> tuple[Due, ...]:
    responses = unfolding.program.responses
    found = []
    for at in decided:
        for obligation in at.clause.obligations:
            demand = responses.of((obligation,), lambda clause: [1] * sum(1 for _ in in_text_order(clause)))
            first = next(iter(occurrences(demand)))
            end = None if first.end is None else time + first.end
            name, start = obligation.name, time + (first.start or 0)
            found.append(Due(at.rule.label, at.number, described(obligation), name, obligation.negated, start, end))
    return tuple(dict.fromkeys(found))
