"""Schedules: obligations and their windows, as lines of text and as a small chart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify.report.timeline import chart_of
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import joined, sentence
from sleec_verify.wording.times import duration

if TYPE_CHECKING:
    from sleec_runtime.model import Context
    from sleec_verify.entailment.answer import ScheduledResponse
    from sleec_verify.results.json_values import Json


def in_words(entries: Sequence[ScheduledResponse]) -> Iterator[str]:
    """A line with columns for each entry. The entries that follow an event are below a line for that event."""
    groups: dict[str | None, list[ScheduledResponse]] = {}
    for entry in entries:
        groups.setdefault(entry.after, []).append(entry)
    name = max(len(_what(entry)) for entry in entries)
    time = max(len(when_text(entry)) for entry in entries)
    for after, group in groups.items():
        if after is not None:
            yield sentence("after {event} (times count from then):", event=quoted(after))
        for entry in group:
            indent = "  " if after is not None else ""
            what, when = _what(entry), when_text(entry)
            columns = [indent + what.ljust(name), joined("", [when, " " * (time - len(when))]), _by(entry)]
            yield joined("  ", columns)


def _what(entry: ScheduledResponse) -> str:
    name = f"not {entry.event}" if entry.negated else entry.event
    return name if entry.instead_of is None else f"or {name}"


def when_text(entry: ScheduledResponse) -> str:
    """``within 5 minutes``, ``from 1 minute to 5 minutes``, ``eventually``"""
    if entry.unknown is not None:
        within = sentence("within {length}, whose value is not given", length=entry.unknown)
        if entry.lengths is None:
            return within
        shortest, longest = map(duration, entry.lengths)
        return sentence("{window} ({shortest} to {longest})", window=within, shortest=shortest, longest=longest)
    assert entry.start is not None, "a known window has a start"
    if entry.end is None:
        return _without_end(entry.start, entry.negated)
    if entry.end == entry.start:
        return sentence("immediately") if entry.start == 0 else sentence("after {time}", time=duration(entry.start))
    if entry.start:
        return sentence("from {start} to {end}", start=duration(entry.start), end=duration(entry.end))
    if entry.negated:
        return sentence("for {length}", length=duration(entry.end))
    return sentence("within {length}", length=duration(entry.end))


def _without_end(start: int, negated: bool) -> str:
    if not start:
        return sentence("always") if negated else sentence("eventually")
    if negated:
        return sentence("always from {start} on", start=duration(start))
    return sentence("eventually from {start} on", start=duration(start))


def _by(entry: ScheduledResponse) -> str:
    why = sentence("by {clause}", clause=entry.layer or entry.rule)
    if entry.instead_of is None:
        return why
    if entry.overdue and not entry.instead_of.startswith("NOT "):
        return sentence("{why}, if {response} was not done in time", why=why, response=quoted(entry.instead_of))
    if entry.overdue:
        response = quoted(entry.instead_of.removeprefix("NOT "))
        return sentence("{why}, if {response} was done", why=why, response=response)
    return sentence("{why}, instead of {response}", why=why, response=quoted(entry.instead_of))


def chart(entries: Sequence[ScheduledResponse], context: Context) -> list[str]:
    """The windows that start with the situation, with a column for each time at which one opens or closes."""
    from sleec_verify.results.timeline import Due, Moment, Timeline

    now = [
        entry
        for entry in entries
        if entry.after is None and entry.start is not None and (entry.end is None or entry.end >= entry.start)
    ]
    if not now:
        return []
    dues = tuple(
        Due(entry.rule, entry.clause, "", entry.event, entry.negated, entry.start or 0, entry.end) for entry in now
    )
    times = {0, *(due.start for due in dues), *(due.end for due in dues if due.end is not None)}
    if len(times) == 1:
        return []
    moments = [
        Moment(time, tuple(sorted(context.triggers)) if time == 0 else (), {}, (), dues if time == 0 else ())
        for time in sorted(times)
    ]
    return chart_of(Timeline(tuple(moments), now=0))


def as_json(entries: Sequence[ScheduledResponse]) -> Json:
    """The schedule for programs. Times are seconds from the situation, or from the event `after`. If `until` is null,
    the window has no end. `lengths` are the bounds of an unknown length."""
    return [
        {
            "obligation": entry.event,
            "negated": entry.negated,
            "from": entry.start,
            "until": entry.end,
            "rule": entry.rule,
            "clause": entry.clause,
            "after": entry.after,
            "instead_of": entry.instead_of,
            "overdue": entry.overdue,
            "unknown": entry.unknown,
            "lengths": None if entry.lengths is None else list(entry.lengths),
        }
        for entry in entries
    ]
