"""What relations and constraints call for, and forbid, at the moments of a timeline that leaves no way to go on."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from sleec_runtime.model import Measure, names_of
from sleec_runtime.model_time import EventRelation, Lasting
from sleec_verify.solver import MiniSat
from sleec_verify.timed.instant import Fixed, Formula, Instant
from sleec_verify.timed.laws import clauses_at
from sleec_verify.timed.program import Law, events_of, formulas_of_law
from sleec_verify.timed.timeline import Due, Moment, Timeline


def ruled(timeline: Timeline, laws: Sequence[tuple[str, Law]], measures: Mapping[str, Measure]) -> Timeline:
    """The timeline with what `laws`, each with what it is called, make of what occurs and what rules call for.

    What has to be told of a law is which events it brings or keeps off; those of the past brought theirs.
    """
    moments = list(timeline.moments)
    demands = [due for moment in moments for due in moment.due if not due.negated]
    for place, moment in enumerate(moments):
        here = _Here(moment, moments[:place], [due for due in demands if _covers(due, moment.time)], measures)
        said = list(here.says(laws, settled=place != timeline.now))
        said += _spread([*moment.due, *said], laws, measures)
        speaking = [law for _, law in laws if _tells(law, moment, said)]
        named = {name for law in speaking for formula in formulas_of_law(law) for name in names_of(formula)}
        telling = tuple(name for name in moment.conditions if name in moment.telling or name in named)
        moments[place] = replace(moment, due=(*moment.due, *said), telling=telling)
    return replace(timeline, moments=tuple(moments))


def _spread(dues: Sequence[Due], laws: Sequence[tuple[str, Law]], measures: Mapping[str, Measure]) -> Iterator[Due]:
    """What is forbidden as long as something else is, that laws have to occur with it."""
    ahead = [due for due in dues if due.negated and (due.end is None or due.start < due.end)]
    known = {(due.event, due.start, due.end) for due in ahead}
    while ahead:
        due = ahead.pop(0)
        for name, law in laws:
            events = set(events_of(law))
            for event in sorted(events - {due.event}) if due.event in events else ():
                window = (event, due.start, due.end)
                # What conditions and measures will be is not known.
                at_any_time = Moment(due.start, (), {}, ())
                if window not in known and not _possible(law, at_any_time, measures, [event], but=due.event):
                    known.add(window)
                    words = f"NOT {event} without {due.event}"
                    ahead.append(Due(name, 0, words, event, True, due.start, due.end, law=law.span))
                    yield ahead[-1]


def _possible(
    law: Law,
    moment: Moment,
    measures: Mapping[str, Measure],
    done: Collection[str],
    besides: str | None = None,
    but: str | None = None,
) -> bool:
    """Whether a law allows what is done at a moment, with an event besides, or without one."""
    formula = Formula()
    instant = Instant(
        formula, measures, formula.true, Fixed(moment.time, frozenset(), moment.conditions, complete=False)
    )
    formula.clauses += clauses_at(instant, law)
    assumed = [instant.event(name) for name in sorted({*done, *([] if besides is None else [besides])})]
    assumed += [] if but is None else [-instant.event(but)]
    instant.settle()
    with MiniSat(formula.clauses) as solver:
        return solver.solve(assumed) is not False


def _covers(due: Due, time: int) -> bool:
    return due.start <= time and (due.end is None or time <= due.end)


def _tells(law: Law, moment: Moment, said: Sequence[Due]) -> bool:
    """Whether conditions of a law bear on what is told of a moment."""
    if isinstance(law, Lasting):
        return law.event in moment.events
    return any(due.law == law.span for due in said) or not list(events_of(law))


class _Here:
    """One moment, with those before it and what is due at it."""

    def __init__(
        self, moment: Moment, before: Sequence[Moment], due: Sequence[Due], measures: Mapping[str, Measure]
    ) -> None:
        self._moment = moment
        self._before = before
        self._measures = measures
        self._due = {one.event for one in due} - set(moment.events)
        at_once = {d.event for d in due if d.start == d.end and (d.overdue or d.instead_of is None)}
        self._done = {*moment.events, *at_once}

    def says(self, laws: Sequence[tuple[str, Law]], settled: bool) -> Iterator[Due]:
        """What the laws call for and forbid; only the latter where all that occurs is `settled`."""
        grew = not settled
        while grew:
            grew = False
            for name, law in laws:
                for event in sorted(set(events_of(law)) - self._done):
                    if self._allows(law, self._done) and not self._allows(law, self._done, but=event):
                        grew = True
                        self._done.add(event)
                        yield self._said(name, law, event, event)
        called = (self._due | self._done) - set(self._moment.events)
        for name, law in laws:
            concerned = sorted(called.intersection(events_of(law)))
            alone = [event for event in concerned if self._forbids(law, event)]
            for event in alone:
                yield self._said(name, law, event, f"NOT {event}{_until(law)}")
            if not alone:
                several = self._excluded(law)
                words = " and ".join(several)
                for event in several:
                    yield self._said(name, law, event, f"NOT {words}{' together' if len(several) > 1 else ''}")

    def _forbids(self, law: Law, event: str) -> bool:
        """Whether a law forbids an event because of what occurs."""
        if isinstance(law, EventRelation) and law.relation == "happenBefore":
            came = any(law.left in moment.events for moment in self._before)
            return event == law.right and not came
        events = self._moment.events
        return self._allows(law, events) and not self._allows(law, events, besides=event)

    def _excluded(self, law: Law) -> list[str]:
        """A minimal set of events that are due at once, and that a law forbids together."""
        due = sorted((self._done - set(self._moment.events)).intersection(events_of(law)))
        if self._allows(law, self._done):
            return []
        kept = set(due)
        for event in due:
            if not self._allows(law, {*self._moment.events, *(kept - {event})}):
                kept.discard(event)
        return sorted(kept)

    def _allows(self, law: Law, done: Collection[str], besides: str | None = None, but: str | None = None) -> bool:
        return _possible(law, self._moment, self._measures, done, besides, but)

    def _said(self, name: str, law: Law, event: str, words: str) -> Due:
        time = self._moment.time
        return Due(name, 0, words, event, words.startswith("NOT "), time, time, law=law.span)


def _until(law: Law) -> str:
    return f" before {law.left}" if isinstance(law, EventRelation) and law.relation == "happenBefore" else ""
