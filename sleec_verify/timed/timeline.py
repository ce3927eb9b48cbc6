"""A trace as a witness: what happens when, and what is due until when."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from sleec_runtime.model import Context, Rule, Span, Value, formulas_of, names_of
from sleec_runtime.model_time import described
from sleec_verify.timed.needs import Decided
from sleec_verify.timed.unfolding import Unfolding
from sleec_verify.timed.windowed import Windowed, Windows


@dataclass(frozen=True)
class Due:
    """What a rule calls for at some moment: in words, and the window of its event in seconds of the timeline. No `end`:
    at some time.

    `instead_of` is what it is due in place of, in words: from `start` on, as that was not kept in time (`overdue`), or
    at any time. Where a `law` calls for it, a relation or constraint of that place, `rule` is what that is called.
    """

    rule: str
    clause: int
    words: str
    event: str
    negated: bool
    start: int
    end: int | None
    instead_of: str | None = None
    overdue: bool = False
    law: Span | None = None


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
        events = tuple(sorted(unfolding.happening(number)))
        moments.append((Moment(schedule[number], events, conditions, tuple(conditions)), decided))
    return Timeline(_with_dues(unfolding, moments, over=True))


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
        moment = Moment(fixed.time, tuple(sorted(fixed.events)), conditions, telling)
        moments.append((moment, [d for d in decided if unfolding.true(d.guard)]))
    return Timeline(_with_dues(unfolding, moments, over=False), now)


def _with_dues(
    unfolding: Unfolding, moments: Sequence[tuple[Moment, Sequence[Decided]]], over: bool
) -> tuple[Moment, ...]:
    """The moments with what the clauses that decide there call for. After the last of them nothing happens any more if
    all is `over`; else that is open."""
    course = [moment for moment, _ in moments]
    found = []
    for moment, decided in moments:
        context = Context(frozenset(moment.events), moment.conditions)
        windows = Windows(unfolding.program.ruleset, context, unfolding.program.untimed)
        due = [
            _due(at, one, moment.time)
            for at in decided
            for one in windows.of(at.clause)
            if not any(_is_kept(other, moment.time, course, over) for other in _replaced(one))
        ]
        found.append(replace(moment, due=tuple(dict.fromkeys(due))))
    return tuple(found)


def _replaced(one: Windowed) -> Iterator[Windowed]:
    """What a response is due in place of, and what that is."""
    while one.instead is not None:
        one = one.instead
        yield one


def _is_kept(one: Windowed, triggered: int, course: Sequence[Moment], over: bool) -> bool:
    """Whether a response was kept, so that nothing is due in its place any more."""
    start, end = triggered + _known(one.start), None if one.end is None else triggered + one.end
    open_still = not over and (end is None or end >= course[-1].time)
    done = any(
        start <= moment.time and (end is None or moment.time <= end)
        for moment in course
        if one.obligation.name in moment.events
    )
    return not done and not open_still if one.obligation.negated else done


def _due(at: Decided, one: Windowed, time: int) -> Due:
    return Due(
        at.rule.label,
        at.number,
        described(one.obligation),
        one.obligation.name,
        one.obligation.negated,
        time + _known(one.start),
        None if one.end is None else time + one.end,
        None if one.instead is None else str(one.instead.obligation),
        one.overdue,
    )


def _known(start: int | None) -> int:
    assert start is not None, "rules with a window that a measure says are not analysed"
    return start
