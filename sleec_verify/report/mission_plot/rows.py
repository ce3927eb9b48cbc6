"""The rows of the plot of a mission: each draws one name over time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

from sleec_runtime.model import Rational, exact
from sleec_verify.report.mission_plot import grouping
from sleec_verify.report.mission_plot.grouping import Group
from sleec_verify.report.mission_plot.time_scale import TimeScale
from sleec_verify.report.pictures.drawing import Drawing, cut
from sleec_verify.results.mission_timeline import Change, DeviationMark, DueWindow, Occurrence
from sleec_verify.wording.phrases import counted, value_text

ROW = 24
"""Pixels."""
_LANE = 14
_MOST_LANES = 4
_NEAR = 9
"""Marks that are nearer than this many pixels are drawn as one."""
_NEAR_NUMBERED = 32
"""The same for rows with many marks, so that there is space for a number beside each."""
_MANY = 25
_CHARACTER = 6.2
"""Pixels."""
_FEW_VALUES = 12
"""The most changes of a measure that are drawn as values; more are drawn as a curve."""


class Place(NamedTuple):
    """Where a row is drawn: its top, and its times."""

    drawing: Drawing
    scale: TimeScale
    top: float


def occurrences(place: Place, found: Sequence[Occurrence], is_execution: bool) -> bool:
    """Triangles for events, or diamonds for executions. Near ones are one mark with their number.

    Returns whether some are.
    """
    y = place.top + ROW / 2
    places = [(place.scale.x(one.time), one) for one in found]
    groups = grouping.marks(places, _NEAR)
    if len(groups) > _MANY:
        groups = grouping.marks(places, _NEAR_NUMBERED)
    for group in groups:
        first, last = group.members[0], group.members[-1]
        times = place.scale.label(first.time)
        if len(group.members) > 1:
            times = f"{counted(len(group.members), 'time')} from {times} to {place.scale.label(last.time)}"
        mark = place.drawing.group(f"{first.name}: {'executed ' if is_execution else ''}{times}")
        (mark.execution if is_execution else mark.trigger)(group.left, y)
        if len(group.members) > 1:
            mark.text(group.left + 6, y - 2, f"×{len(group.members)}", "small")
    return len(groups) < len(found)


def values(place: Place, changes: Sequence[Change]) -> None:
    """A condition or measure over time: a bar while a condition is true, a line while it is false, a dotted line while
    it is unknown, and values or a curve for a measure."""
    scale = place.scale
    start = Change(scale.start, changes[0].name, None)
    ends = [*(change.time for change in changes), scale.end]
    spans = [(change, scale.x(change.time), scale.x(end)) for change, end in zip([start, *changes], ends)]
    spans = [(change, left, right) for change, left, right in spans if right > left or change.value is True]
    kinds = {type(change.value) for change in changes if change.value is not None}
    if kinds <= {bool}:
        _truth(place, spans)
    elif len(changes) > _FEW_VALUES and str not in kinds and bool not in kinds:
        _curve(place, spans)
    else:
        _boxes(place, spans)


def _truth(place: Place, spans: Iterable[tuple[Change, float, float]]) -> None:
    middle = place.top + ROW / 2
    true = []
    for change, left, right in spans:
        if change.value is True:
            true.append((left, right, change))
        else:
            place.drawing.line(left, middle, right, middle, "unknown" if change.value is None else "false")
    for group in grouping.bars(true, 1.5):
        times = counted(len(group.members), "time")
        first = place.scale.label(group.members[0].time)
        note = f"true from {first}" if len(group.members) == 1 else f"becomes true {times} from {first} on"
        bar = place.drawing.group(f"{group.members[0].name} {note}")
        bar.rectangle(group.left, middle - 6, max(group.right, group.left + 2), middle + 6, "true")


def _boxes(place: Place, spans: Iterable[tuple[Change, float, float]]) -> None:
    top, bottom = place.top + 4, place.top + ROW - 4
    for change, left, right in spans:
        if change.value is None:
            place.drawing.line(left, place.top + ROW / 2, right, place.top + ROW / 2, "unknown")
            continue
        words = value_text(change.value)
        box = place.drawing.group(f"{change.name} is {words} from {place.scale.label(change.time)}")
        box.rectangle(left, top, max(right, left + 2), bottom, "value")
        if len(words) * _CHARACTER + 6 < right - left:
            box.text(left + 4, bottom - 4, words)


def _curve(place: Place, spans: Sequence[tuple[Change, float, float]]) -> None:
    numbers = [number for change, _, _ in spans if (number := exact(change.value)) is not None]
    least, most = _float(min(numbers)), _float(max(numbers))
    low, high = place.top + ROW - 4, place.top + 4

    def y(number: float) -> float:
        return low - (number - least) / (most - least) * (low - high) if most > least else (low + high) / 2

    drawn = place.drawing.group(f"{spans[-1][0].name}: from {least:g} to {most:g}")
    points: list[tuple[float, float]] = []
    for _, group in groupby(spans, key=lambda span: (int(span[1]), span[0].value is None)):
        in_pixel = list(group)
        left, right = in_pixel[0][1], in_pixel[-1][2]
        heights = [y(_float(number)) for change, _, _ in in_pixel if (number := exact(change.value)) is not None]
        if heights:
            # All values of one column of pixels: from the first one to the extremes, and on with the last one.
            points += [(left, at) for at in dict.fromkeys([heights[0], min(heights), max(heights), heights[-1]])]
            points.append((right, heights[-1]))
        else:
            place.drawing.line(left, place.top + ROW / 2, right, place.top + ROW / 2, "unknown")
            if points:
                drawn.path(points, "curve")
            points = []
    if points:
        drawn.path(points, "curve")
    x = place.scale.left + place.scale.width + 4
    place.drawing.text(x, high + 5, f"{most:g}", "small")
    place.drawing.text(x, low + 2, f"{least:g}", "small")


def _float(number: Rational) -> float:
    """The nearest float of at most 1e300 and at least -1e300: a measure may have a value that no float has."""
    return float(max(-(10**300), min(number, 10**300)))


class WindowRow:
    """The windows of one event, in lanes so that few overlap, and its executions."""

    def __init__(self, windows: Sequence[DueWindow], executions: Sequence[Occurrence], scale: TimeScale) -> None:
        self.executions = executions
        self.bars: list[Group[DueWindow]] = []
        self.is_crowded = len(windows) > 60
        for state in ("prohibited", "met", "open", "missed"):
            spans = [(*_extent(window, scale), window) for window in windows if window.state == state]
            if self.is_crowded:
                self.bars += grouping.bars(spans, 1.0)
            else:
                self.bars += [Group(left, right, [window]) for left, right, window in spans]
        self.bars.sort(key=lambda bar: bar.left)
        self.lanes = grouping.lanes(self.bars, _MOST_LANES)
        self.height = max(ROW, _LANE * (1 + max(self.lanes, default=0)) + 8) + (ROW if executions and windows else 0)

    def draw(self, place: Place) -> bool:
        """Draws the windows, and the executions below them. Returns whether some marks are drawn as one."""
        for bar, lane in zip(self.bars, self.lanes):
            first = bar.members[0]
            more = f", and {len(bar.members) - 1} more" if len(bar.members) > 1 else ""
            end = "" if first.last is None else f" to {place.scale.label(first.last)}"
            title = f"{first.words}: {first.state}, from {place.scale.label(first.first)}{end}{more}"
            drawn = place.drawing.group(title)
            top = place.top + 5 + lane * _LANE
            bottom = top + _LANE - 3
            drawn.rectangle(bar.left, top, bar.right, bottom, first.state)
            if first.last is None:  # the window has no end
                drawn.path([(bar.right - 5, top), (bar.right, (top + bottom) / 2), (bar.right - 5, bottom)], "curve")
            if first.state == "missed":
                drawn.line(bar.right - 4, top - 2, bar.right + 4, bottom + 2, "missed")
                drawn.line(bar.right - 4, bottom + 2, bar.right + 4, top - 2, "missed")
            elif first.state == "open":
                drawn.text(bar.right + 3, bottom, "?", "head")
        return self.is_crowded | occurrences(place._replace(top=place.top + self.height - ROW), self.executions, True)


def _extent(window: DueWindow, scale: TimeScale) -> tuple[float, float]:
    left = scale.x(window.first)
    right = scale.x(scale.end if window.last is None else max(window.first, window.last))
    return left, max(right, left + 4)


def domains(place: Place, changes: Sequence[Change]) -> None:
    """The domains that the robot was in."""
    ends = [*(change.time for change in changes[1:]), place.scale.end]
    for change, end in zip(changes, ends):
        left, right = place.scale.x(change.time), place.scale.x(end)
        if right == left and len(changes) > 1:
            continue
        name = change.name or "all rules"
        box = place.drawing.group(f"{name} from {place.scale.label(change.time)}")
        box.rectangle(left, place.top + 4, max(right, left + 2), place.top + ROW - 4, "value")
        if (right - left) > 20:
            box.text(left + 4, place.top + ROW - 8, cut(name, max(1, int((right - left - 8) / _CHARACTER))))


def deviations(place: Place, found: Sequence[DeviationMark], bottom: float) -> None:
    """The numbers of deviations in the list below, and a line through the picture for each breach."""
    y = place.top + ROW / 2
    numbered = list(enumerate(found, 1))
    groups = grouping.marks([(place.scale.x(one.time), (number, one)) for number, one in numbered], 24)
    for group in groups:
        is_breach = any(one.is_breach for _, one in group.members)
        first, last = group.members[0][0], group.members[-1][0]
        number = str(first) if first == last else f"{first}–{last}"
        x = (group.left + group.right) / 2
        mark = place.drawing.group("; ".join(f"{number}: {one.words}" for number, one in group.members[:5]))
        if is_breach and len(groups) <= 30:
            mark.line(x, place.top + ROW, x, bottom, "breach-line")
        mark.deviation(x, y, number, is_breach)
