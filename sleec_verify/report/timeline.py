"""Timelines: in words, and as a small chart of text.

The chart has a column for each moment, and for each time at which an alternative becomes due. It has a row for each
event: ``*`` where it occurs, ``-`` while it is due, ``x`` while it is forbidden, ``!`` where it is forbidden and due,
or forbidden and occurs. ``>`` means that this continues after the last column.

If the same happens at regular intervals, only the first and the last of these moments are shown.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import TYPE_CHECKING

from sleec_verify.wording.phrases import happening, quoted
from sleec_verify.wording.sentence import joined, sentence
from sleec_verify.wording.times import duration

if TYPE_CHECKING:
    from sleec_verify.results.timeline import Due, Moment, Timeline

FEW_ALIKE = 3
"""The most equal moments, at equal distances, that are shown one by one."""


def _alike(timeline: Timeline) -> list[list[Moment]]:
    """The moments, in groups of equal moments at equal distances. The moment `now` is a group of its own."""

    def same(moment: Moment, after: int) -> Moment:
        due = tuple(
            replace(one, start=one.start + after, end=None if one.end is None else one.end + after)
            for one in moment.due
        )
        return replace(moment, time=moment.time + after, due=due)

    def goes_on(run: Sequence[Moment], moment: Moment) -> bool:
        after = moment.time - run[0].time
        return after == len(run) * _step([*run, moment]) and same(run[0], after) == moment

    found: list[list[Moment]] = []
    for place, moment in enumerate(timeline.moments):
        if place == timeline.now or not found:
            found.append([moment])
            continue
        if len(found[-1]) == 2 and not goes_on(found[-1], moment):
            # The last may be the first of the next ones.
            found.append([found[-1].pop()])
        if goes_on(found[-1], moment):
            found[-1].append(moment)
        else:
            found.append([moment])
    return [part for run in found for part in ([run] if len(run) > FEW_ALIKE else [[one] for one in run])]


def _step(run: Sequence[Moment]) -> int:
    """The distance between two moments of a run, in seconds."""
    return run[1].time - run[0].time if len(run) > 1 else 0


def in_words(timeline: Timeline) -> Iterator[str]:
    """A line for each moment or group of equal moments, with a line below it for each obligation that it creates, and a
    line for each time at which an alternative becomes due."""
    told: list[tuple[int, str, list[str]]] = []
    late: list[tuple[int, str, str]] = []
    for moment, *others in _alike(timeline):
        lasts, step = others[-1].time - moment.time if others else 0, _step([moment, *others])
        told.append((moment.time, joined("", [_up_to(moment.time, lasts, step), _happens(moment)]), []))
        for due in moment.due:
            if due.overdue and due.start > moment.time:
                late.append((due.start, _up_to(due.start, lasts, step), _instead(due)))
            elif due.instead_of is None:
                told[-1][2].append(joined("  ", ["", says(due)]))
    for time, up_to, owed in sorted(late, key=lambda one: one[0]):
        # At a moment that has a line already, it is a line below that one.
        below = next((lines for at, _, lines in told if at == time and not up_to), None)
        if below is None:
            told.append((time, joined("", [up_to, owed]), []))
        else:
            below.append(joined("  ", ["", owed]))
    told.sort(key=lambda one: one[0])
    for time, happens, below in told:
        when = (
            sentence("at one moment, ")
            if len(told) == 1
            else sentence("at first, ")
            if time == told[0][0]
            else sentence("after {time}, ", time=duration(time))
        )
        yield joined("", [when, happens])
        yield from dict.fromkeys(below)
    if timeline.now is not None:
        now = timeline.moments[timeline.now].time
        if told[-1][0] <= now:
            yield sentence("after this, it is impossible to follow every rule")
        elif now == told[0][0]:
            yield sentence("from the first moment on, it is impossible to follow every rule")
        else:
            yield sentence("after {time}, it is impossible to follow every rule", time=duration(now))


def _up_to(time: int, lasts: int, step: int) -> str:
    every = sentence("every second") if step == 1 else sentence("every {time}", time=duration(step))
    return sentence("and {every} up to {time}, ", every=every, time=duration(time + lasts)) if lasts else ""


def says(due: Due) -> str:
    """``rule `a` requires `E within 5 minutes` ``, or ``forbids``."""
    rule = quoted(due.rule)
    if due.negated:
        return sentence("rule {rule} forbids {response}", rule=rule, response=quoted(due.words.removeprefix("NOT ")))
    return sentence("rule {rule} requires {response}", rule=rule, response=quoted(due.words))


def _instead(due: Due) -> str:
    assert due.instead_of is not None, "only an alternative is required instead of something"
    return sentence("instead of {response}, {demand}", response=quoted(due.instead_of), demand=says(due))


def _happens(moment: Moment) -> str:
    return happening(moment.events, {name: moment.conditions[name] for name in moment.telling})


def chart_of(timeline: Timeline) -> list[str]:
    """The chart of a timeline, as lines: moments are columns, events that occur or are due are rows."""
    shown = [moment for run in _alike(timeline) for moment in (run if len(run) == 1 else (run[0], run[-1]))]
    late = {due.start for moment in shown for due in moment.due if due.overdue}
    columns = sorted({*(moment.time for moment in shown), *late})
    heads = [_short(time) for time in columns]
    if timeline.now is not None:
        heads[columns.index(timeline.moments[timeline.now].time)] += " now"
    demands = [due for moment in timeline.moments for due in moment.due]
    names = list(dict.fromkeys([e for m in timeline.moments for e in m.events] + [due.event for due in demands]))
    label = max(len(name) for name in names)
    marks = {name: _marks(name, timeline.moments, columns, demands) for name in names}
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


def _marks(
    name: str, moments: Sequence[Moment], columns: Sequence[int], demands: Sequence[Due]
) -> list[tuple[str, str]]:
    """For each column, the mark of an event at its time, and the marks of the time up to the next column, one for each
    interval without a change. In the last column, these end with the last demand."""
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
    changes.update(moment.time for moment in moments)
    found = []
    for place, time in enumerate(columns):
        first = time + 1
        behind = columns[place + 1] if place + 1 < len(columns) else None
        begins = sorted(t for t in {first, *changes} if t >= first and (behind is None or t < behind))
        after = "".join(kind for kind, _ in groupby(map(mark, begins)))
        found.append((mark(time), after.rstrip() if behind is None else after))
    return found


def _while_open(due: Due, times: Sequence[int]) -> Due:
    """The demand with the end of its validity: an obligation ends when it is met, a prohibition with its window."""
    done = [time for time in times if due.start <= time and (due.end is None or time <= due.end)]
    return replace(due, end=min(done)) if done and not due.negated else due


def _spread(marks: str, width: int) -> str:
    """The marks stretched to `width` characters, each repeated about equally often."""
    return "".join(marks[place * len(marks) // width] for place in range(width)) if marks else " " * width


def _short(seconds: int) -> str:
    parts = []
    for size, unit in ((86400, "d"), (3600, "h"), (60, "min"), (1, "s")):
        count, seconds = divmod(seconds, size)
        if count:
            parts.append(f"{count} {unit}")
    return " ".join(parts) or "0 s"
