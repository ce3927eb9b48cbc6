"""The timeline of a mission as one picture: domains, triggers, conditions, obligations with their windows, and
deviations."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from sleec_verify.report.mission_plot import rows
from sleec_verify.report.mission_plot.rows import ROW, Place, WindowRow
from sleec_verify.report.mission_plot.time_scale import TimeScale
from sleec_verify.report.pictures.document import document
from sleec_verify.report.pictures.drawing import Drawing, cut
from sleec_verify.results.mission_timeline import Change, DueWindow, MissionTimeline, Occurrence
from sleec_verify.wording.phrases import counted

_WIDTH = 1252
_LEFT, _RIGHT = 284, 48
_MOST_ROWS = 40
"""The most rows of a section."""
_MOST_LINES = 40
"""The most deviations in the list."""
_LABEL = 34
"""Characters."""

T = TypeVar("T", Occurrence, Change, DueWindow)
M = TypeVar("M")


def plot(timeline: MissionTimeline) -> str:
    """The timeline as an SVG document. Titles and a description are its text alternative."""
    return document(
        f"Timeline of {timeline.title}",
        _description(timeline),
        _WIDTH,
        lambda drawing: _Picture(timeline, drawing).draw(),
        "mission",
    )


def _description(timeline: MissionTimeline) -> str:
    breaches = sum(one.is_breach for one in timeline.deviations)
    return (
        f"{counted(len(timeline.triggers), 'trigger')}, {counted(len(timeline.executions), 'execution')} and "
        f"{counted(len(timeline.windows), 'window')} of obligations and prohibitions; "
        f"{counted(breaches, 'broken rule')}, {counted(len(timeline.deviations) - breaches, 'other note')}."
    )


class _Picture:
    """Draws one section below the other."""

    def __init__(self, timeline: MissionTimeline, drawing: Drawing) -> None:
        self.timeline = timeline
        self.scale = TimeScale(timeline.start, timeline.end, _LEFT, _WIDTH - _LEFT - _RIGHT)
        self.under = drawing.group()
        self.drawing = drawing.group()
        self.y = 0.0
        self.striped = False
        self.merged = False

    def draw(self) -> float:
        """Draws everything, and returns the height."""
        timeline = self.timeline
        self.drawing.text(16, 28, cut(timeline.title, 110), "title")
        self.drawing.text(16, 47, f"{_description(timeline)} In the picture, {self.scale.start_text()}.", "small")
        self.y = 76
        top = self.y
        if timeline.deviations:
            marks = Place(self.drawing.group(), self.scale, self.y)
            self.drawing.text(16, self.y + 16, "Deviations", "head")
            self.y += ROW + 6
        if timeline.domains:
            self._row("Domain", ROW, lambda place: rows.domains(place, timeline.domains), "head")
        self._section("Triggers", _by_name(timeline.triggers), self._triggers)
        self._section("Conditions and measures", _by_name(timeline.changes), self._values)
        windows = _by_name(timeline.windows)
        executions = _by_name(timeline.executions)
        names = dict.fromkeys([*windows, *executions])
        rows_of = {name: (windows.get(name, []), executions.get(name, [])) for name in names}
        self._section("Obligations and prohibitions", rows_of, self._windows)
        bottom = self.y
        if timeline.deviations:
            rows.deviations(marks, timeline.deviations, bottom)
        self._axis(top, bottom)
        self._legend()
        self._list()
        return self.y + 8

    def _section(self, head: str, named: Mapping[str, M], draw: Callable[[str, M], None]) -> None:
        if not named:
            return
        self.y += 6
        self.drawing.text(16, self.y + 15, head, "head")
        self.y += 20
        for name in list(named)[:_MOST_ROWS]:
            draw(name, named[name])
        if len(named) > _MOST_ROWS:
            self.drawing.text(28, self.y + 15, f"… and {len(named) - _MOST_ROWS} more, which are not shown", "small")
            self.y += 20

    def _triggers(self, name: str, found: list[Occurrence]) -> None:
        self.merged |= bool(self._row(name, ROW, lambda place: rows.occurrences(place, found, False)))

    def _values(self, name: str, found: list[Change]) -> None:
        self._row(name, ROW, lambda place: rows.values(place, found))

    def _windows(self, name: str, found: tuple[list[DueWindow], list[Occurrence]]) -> None:
        row = WindowRow(*found, self.scale)
        self.merged |= bool(self._row(name, row.height, row.draw))

    def _row(self, name: str, height: float, draw: Callable[[Place], bool | None], kind: str = "") -> bool | None:
        if self.striped:
            self.under.rectangle(0, self.y, _WIDTH, self.y + height, "stripe")
        self.striped = not self.striped
        label = self.drawing.group(name)
        label.text(16 if kind else 28, self.y + 16, cut(name, _LABEL), kind)
        place = Place(self.drawing, self.scale, self.y)
        self.y += height
        return draw(place)

    def _axis(self, top: float, bottom: float) -> None:
        for x, label in self.scale.ticks():
            self.under.line(x, top - 8, x, bottom, "grid")
            self.drawing.text(x, top - 12, label, "small middle")
        self.y += 12

    def _legend(self) -> None:
        y = self.y + 8
        x = 16.0
        drawing = self.drawing.group("Legend")
        drawing.trigger(x + 6, y)
        drawing.execution(x + 96, y)
        for words, at in (("trigger", x + 16), ("execution", x + 106)):
            drawing.text(at, y + 4, words, "small")
        x += 190
        for kind, words, width in (
            ("met", "required, met", 120),
            ("missed", "required, missed", 136),
            ("open", "required, not decided", 158),
            ("prohibited", "prohibited", 102),
            ("true", "condition true", 118),
            ("false", "false", 70),
            ("unknown", "not reported", 108),
        ):
            if kind in ("false", "unknown"):
                drawing.line(x, y, x + 26, y, kind)
            else:
                drawing.rectangle(x, y - 6, x + 26, y + 5, kind)
            drawing.text(x + 32, y + 4, words, "small")
            x += width
        drawing.deviation(x + 10, y, "1", True)
        drawing.text(x + 24, y + 4, "breach", "small")
        drawing.deviation(x + 86, y, "2", False)
        drawing.text(x + 100, y + 4, "other", "small")
        self.y += 26

    def _list(self) -> None:
        timeline = self.timeline
        for number, one in enumerate(timeline.deviations[:_MOST_LINES], 1):
            self.y += 20
            self.drawing.deviation(32, self.y - 4, str(number), one.is_breach)
            self.drawing.text(58, self.y, cut(f"{self.scale.label(one.time)}: {one.words}", 165))
        notes = []
        if self.merged:
            notes.append("Marks and windows that are close to each other are drawn as one; ×3 means three.")
        if len(timeline.deviations) > _MOST_LINES:
            notes.append(f"… and {counted(len(timeline.deviations) - _MOST_LINES, 'more deviation')}.")
        if timeline.cut is not None:
            notes.append(f"The log has more than can be shown: the picture ends at {self.scale.label(timeline.cut)}.")
        for note in notes:
            self.y += 20
            self.drawing.text(16, self.y, note, "small")


def _by_name(found: Sequence[T]) -> dict[str, list[T]]:
    """The members by name, names in the order of their first member."""
    named: dict[str, list[T]] = {}
    for one in found:
        named.setdefault(one.name, []).append(one)
    return named
