"""Schedules: obligations and their windows, as lines of text and as a small chart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify.report.timeline import chart_of, duration
from sleec_verify.results.phrases import quoted

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
    time = max(len(_when(entry)) for entry in entries)
    for after, group in groups.items():
        if after is not None:
            yield f"after {quoted(after)} (times count from then):"
        for entry in group:
            indent = "  " if after is not None else ""
            yield f"{indent}{_what(entry).ljust(name)}  {_when(entry).ljust(time)}  {_by(entry)}"


def _what(entry: ScheduledResponse) -> str:
    name = f"not {entry.event}" if entry.negated else entry.event
    return name if entry.instead_of is None else f"or {name}"


def _when(entry: ScheduledResponse) -> str:
    if entry.unknown is not None:
        if entry.lengths is None:
            return f"within {entry.unknown}, whose value is not given"
        shortest, longest = map(duration, entry.lengths)
        return f"within {entry.unknown}, whose value is not given ({shortest} to {longest})"
    assert entry.start is not None, "a known window has a start"
    if entry.end is None:
        start = f" from {duration(entry.start)} on" if entry.start else ""
        return f"always{start}" if entry.negated else f"eventually{start}"
    if entry.end == entry.start:
        return "immediately" if entry.start == 0 else f"after {duration(entry.start)}"
    if entry.start:
        return f"from {duration(entry.start)} to {duration(entry.end)}"
    return f"{'for' if entry.negated else 'within'} {duration(entry.end)}"


def _by(entry: ScheduledResponse) -> str:
    why = f"by {entry.layer or entry.rule}"
    if entry.instead_of is None:
        return why
    if entry.overdue and not entry.instead_of.startswith("NOT "):
        return f"{why}, if {quoted(entry.instead_of)} was not done in time"
    if entry.overdue:
        return f"{why}, if {quoted(entry.instead_of.removeprefix('NOT '))} was done"
    return f"{why}, instead of {quoted(entry.instead_of)}"


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
