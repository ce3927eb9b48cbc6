"""Timelines: in words, and as a small chart of text.

The chart has a column for each moment and a row for each event: ``*`` where it occurs, ``-`` while it is due, ``x``
while it is forbidden, ``!`` where it is both.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.report.words import listed, quoted, value_text

if TYPE_CHECKING:
    from sleec_verify.timed.timeline import Due, Moment, Timeline

_UNITS = ((86400, "day"), (3600, "hour"), (60, "minute"), (1, "second"))


def duration(seconds: int) -> str:
    """``0 seconds``, ``5 minutes``, ``1 hour 30 minutes``."""
    parts = []
    for size, unit in _UNITS:
        count, seconds = divmod(seconds, size)
        if count:
            parts.append(f"{count} {unit}{'' if count == 1 else 's'}")
    return " ".join(parts) or "0 seconds"


def in_words(timeline: Timeline) -> Iterator[str]:
    """A line for each moment, and one below it for each thing that is due by it."""
    for place, moment in enumerate(timeline.moments):
        last = place == timeline.now
        when = "at one moment" if len(timeline.moments) == 1 else _when(moment, first=place == 0)
        yield f"{when}, {_happens(moment)}"
        for due in moment.due:
            yield f"  {due.rule} {_calls(due)}"
        if last:
            yield "and then there is no way to keep every rule"


def _when(moment: Moment, first: bool) -> str:
    return "at first" if first else f"after {duration(moment.time)}"


def _calls(due: Due) -> str:
    return f"forbids {due.words.removeprefix('NOT ')}" if due.negated else f"calls for {due.words}"


def _happens(moment: Moment) -> str:
    events = (
        f"{listed(map(quoted, moment.events))} {'occurs' if len(moment.events) == 1 else 'occur'}"
        if moment.events
        else "nothing occurs"
    )
    facts = [f"{quoted(name)} is {value_text(moment.conditions[name])}" for name in moment.telling]
    return f"{events}, with {listed(facts)}" if facts else events


def chart_of(timeline: Timeline) -> list[str]:
    """The moments as columns, the events that occur or are due as rows."""
    times = [moment.time for moment in timeline.moments]
    heads = [_short(time) for time in times]
    if timeline.now is not None:
        heads[timeline.now] += " now"
    width = max(8, *(len(head) + 2 for head in heads))
    dues = [due for moment in timeline.moments for due in moment.due]
    names = list(dict.fromkeys([e for m in timeline.moments for e in m.events] + [due.event for due in dues]))
    label = max(len(name) for name in names)
    open_end = timeline.now is not None or any(_beyond(due, times) for due in dues)
    rows = ["".ljust(label) + "  " + "".join(head.ljust(width) for head in heads).rstrip()]
    for name in names:
        cells = [_cell(name, place, timeline, dues, width) for place in range(len(times))]
        row = "".join(cells)
        if not open_end:
            row = row.rstrip("-x ")
        rows.append(f"{name.ljust(label)}  {row.rstrip()}")
    return rows


def _cell(name: str, place: int, timeline: Timeline, dues: list[Due], width: int) -> str:
    moments = timeline.moments
    time = moments[place].time
    following = moments[place + 1].time if place + 1 < len(moments) else None
    mine = [due for due in dues if due.event == name]

    def mark(first: int, last: int) -> str:
        now = {due.negated for due in mine if due.start <= last and (due.end is None or first <= due.end)}
        return "!" if len(now) == 2 else "x" if True in now else "-" if now else " "

    here = mark(time, time)
    if name in moments[place].events:
        here = "!" if here == "x" else "*"
    if following is None:
        ahead = [due for due in mine if due.end is None or due.end > time]
        after = ("x" if ahead[0].negated else "-") if ahead else " "
        return here + after * (width - 3) + ("> " if ahead else "  ")
    if following <= time + 1:
        return here.ljust(width)
    return here + mark(time + 1, following - 1) * (width - 1)


def _beyond(due: Due, times: list[int]) -> bool:
    return due.end is None or due.end > times[-1]


def _short(seconds: int) -> str:
    for size, unit in ((86400, "d"), (3600, "h"), (60, "min")):
        if seconds and seconds % size == 0:
            return f"{seconds // size} {unit}"
    return f"{seconds} s"
