"""Timelines: in words, and as a small chart of text.

The chart has a column for each moment and a row for each event: ``*`` where it occurs, ``-`` while it is due, ``x``
while it is forbidden, ``!`` while it is forbidden and is due, or occurs. ``>``: and so on, past the last moment.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
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
    demands = [due for moment in timeline.moments for due in moment.due]
    names = list(dict.fromkeys([e for m in timeline.moments for e in m.events] + [due.event for due in demands]))
    label = max(len(name) for name in names)
    marks = {name: _marks(name, timeline.moments, demands) for name in names}
    # A column has the mark of its moment and one at least for each stretch after it; "> " may end the last.
    stretches = max(len(after) for row in marks.values() for _, after in row)
    width = max(8, stretches + 3, *(len(head) + 2 for head in heads))
    rows = ["".ljust(label) + "  " + "".join(head.ljust(width) for head in heads).rstrip()]
    for name, row in marks.items():
        cells = [here + _spread(after, width - 1) for here, after in row[:-1]]
        here, after = row[-1]
        cells.append(here + (_spread(after, width - 3) + ">" if after else ""))
        rows.append(f"{name.ljust(label)}  {''.join(cells).rstrip()}")
    return rows


def _marks(name: str, moments: Sequence[Moment], demands: Sequence[Due]) -> list[tuple[str, str]]:
    """For each moment the mark of an event there, and those of the time up to the next moment, one for each stretch
    in which nothing changes. What comes after all demands is not among those of the last moment."""
    times = [moment.time for moment in moments if name in moment.events]
    mine = [_while_open(due, times) for due in demands if due.event == name]

    def mark(time: int) -> str:
        kinds = {due.negated for due in mine if due.start <= time and (due.end is None or time <= due.end)}
        if True in kinds and (False in kinds or time in times):
            return "!"
        if time in times:
            return "*"
        return "x" if True in kinds else "-" if kinds else " "

    changes = {due.start for due in mine} | {due.end + 1 for due in mine if due.end is not None}
    found = []
    for place, moment in enumerate(moments):
        first = moment.time + 1
        behind = moments[place + 1].time if place + 1 < len(moments) else None
        begins = sorted(time for time in {first, *changes} if time >= first and (behind is None or time < behind))
        after = "".join(kind for kind, _ in groupby(map(mark, begins)))
        found.append((mark(moment.time), after.rstrip() if behind is None else after))
    return found


def _while_open(due: Due, times: Sequence[int]) -> Due:
    """The demand for as long as it is one: what is called for is due until it is done, what is forbidden stays so."""
    done = [time for time in times if due.start <= time and (due.end is None or time <= due.end)]
    return replace(due, end=min(done)) if done and not due.negated else due


def _spread(marks: str, width: int) -> str:
    """The marks over so many characters, each of them about as many times."""
    return "".join(marks[place * len(marks) // width] for place in range(width)) if marks else " " * width


def _short(seconds: int) -> str:
    for size, unit in ((86400, "d"), (3600, "h"), (60, "min")):
        if seconds and seconds % size == 0:
            return f"{seconds // size} {unit}"
    return f"{seconds} s"
