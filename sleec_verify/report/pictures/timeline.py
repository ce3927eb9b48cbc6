"""The timeline of a finding: events, and the windows of obligations and prohibitions."""

from __future__ import annotations

import re
from collections.abc import Mapping
from textwrap import wrap

from sleec_runtime.model import Value
from sleec_verify.report.pictures.document import document
from sleec_verify.report.pictures.drawing import Drawing, cut
from sleec_verify.report.timeline import in_words
from sleec_verify.results.timeline import Due, Timeline
from sleec_verify.wording.names import spoken
from sleec_verify.wording.phrases import value_words
from sleec_verify.wording.sentence import sentence
from sleec_verify.wording.times import duration
from sleec_verify.wording.translation import Language, translated

_LEFT, _COLUMN, _ROW = 236, 132, 28
"""The width of names, the distance of two times, and the height of a row."""
_LETTERS, _LINE = 22, 13
"""The letters of a line above a time, and the height of the line."""
_QUOTES: Mapping[Language, str] = {"en": "“”", "it": "«»", "de": "„“"}
_MOST_TIMES = 40
"""The most times that are shown."""


def timeline_picture(timeline: Timeline, title: str, language: Language = "en", name: str = "timeline") -> str:
    """The timeline as an SVG document. `title` says what it shows, and `name` begins the ids in it. Names in backticks
    become words in quotes there.

    Times are at equal distances, whatever the time between them.
    """
    head = _in_quotes(translated(title, language), timeline, language)
    picture = _Picture(timeline, head, language)
    words = "; ".join(translated(line, language).strip() for line in in_words(timeline))
    return document(head, words, picture.width, picture.draw, name)


def _in_quotes(title: str, timeline: Timeline, language: Language) -> str:
    """What backticks mark, in quotes; names as words. Conditions stay as the text of the rules has them."""
    names = {due.event for moment in timeline.moments for due in moment.due}
    names.update(name for moment in timeline.moments for name in (*moment.events, *moment.conditions))

    def quoted(found: re.Match[str]) -> str:
        words = spoken(found[1]) if found[1] in names else found[1]
        return f"{_QUOTES[language][0]}{words}{_QUOTES[language][1]}"

    return re.sub(r"`([^`]+)`", quoted, title)


class _Picture:
    """The places of times and rows."""

    def __init__(self, timeline: Timeline, title: str, language: Language) -> None:
        self._timeline = timeline
        self._title = title
        self._language = language
        self._dues = list(dict.fromkeys(due for moment in timeline.moments for due in moment.due))
        times = {moment.time for moment in timeline.moments}
        for due in self._dues:
            times.update([due.start] if due.end is None or due.end < due.start else [due.start, due.end])
        self._times = sorted(times)[:_MOST_TIMES]
        self.width = max(640, _LEFT + _COLUMN * len(self._times) + 24)

    def draw(self, drawing: Drawing) -> float:
        """Draws the timeline, and returns its height."""
        y = 28.0
        for line in wrap(self._title[:1].upper() + self._title[1:], int(self.width / 11)):
            drawing.text(16, y, line, "title")
            y += 22
        under = drawing.group()
        labels = {time: wrap(self._words(duration(time)), _LETTERS) for time in self._times}
        top = y + 18 + _LINE * (max(map(len, labels.values()), default=1) - 1)
        y = self._events(drawing, top + 6)
        y = self._conditions(drawing, y)
        y = self._windows(drawing, y)
        for time in self._times:
            under.line(self._x(time), top, self._x(time), y, "grid")
            for number, label in enumerate(reversed(labels[time])):
                drawing.text(self._x(time), top - 6 - number * _LINE, label, "small middle")
        if self._timeline.now is not None:
            now = self._timeline.moments[self._timeline.now].time
            under.line(self._x(now), top, self._x(now), y, "breach-line")
            words = sentence("after {time}, it is impossible to follow every rule", time=duration(now))
            drawing.text(16, y + 20, self._words(words), "small head")
            y += 20
        return self._legend(drawing, y + 26)

    def _x(self, time: int) -> float:
        return _LEFT + _COLUMN * (self._times.index(time) + 0.5)

    def _events(self, drawing: Drawing, y: float) -> float:
        for name in dict.fromkeys(event for moment in self._timeline.moments for event in moment.events):
            self._name(drawing, y, name)
            for moment in self._timeline.moments:
                if name in moment.events and moment.time in self._times:
                    drawing.trigger(self._x(moment.time), y + _ROW / 2)
            y += _ROW
        return y

    def _conditions(self, drawing: Drawing, y: float) -> float:
        for name in dict.fromkeys(name for moment in self._timeline.moments for name in moment.telling):
            self._name(drawing, y, name)
            for moment in self._timeline.moments:
                if name in moment.telling and moment.time in self._times:
                    words = cut(self._words(_value(moment.conditions, name)), 18)
                    drawing.text(self._x(moment.time), y + _ROW / 2 + 4, words, "middle")
            y += _ROW
        return y

    def _windows(self, drawing: Drawing, y: float) -> float:
        for due in self._dues:
            if due.start in self._times:
                self._name(drawing, y, due.event)
                self._window(drawing, y, due)
                y += _ROW
        return y

    def _window(self, drawing: Drawing, y: float, due: Due) -> None:
        left, right = self._x(due.start) - 7, float(self.width - 16)
        if due.end is not None and due.end in self._times:
            right = self._x(due.end) + 7
        words = cut(due.rule, 30)
        group = drawing.group(self._words(_title(due)))
        if due.end is not None and due.end < due.start:  # the window contains no instant
            group.text(left + 14, y + _ROW / 2 + 4, words, "small")
            return
        group.rectangle(left, y + 7, right, y + _ROW - 7, "prohibited" if due.negated else "met")
        if due.end is None:
            group.arrowhead(right + 8, y + _ROW / 2)
        if right - left > 7 * len(words) + 30:
            if due.negated:
                group.rectangle(left + 10, y + 8, left + 18 + 6 * len(words), y + _ROW - 8, "page")
            group.text(left + 14, y + _ROW / 2 + 4, words, "small")
        else:
            group.text(right + 6, y + _ROW / 2 + 4, words, "small")

    def _legend(self, drawing: Drawing, y: float) -> float:
        drawing.trigger(22, y - 4)
        drawing.text(34, y, self._words(sentence("the event occurs")), "small")
        drawing.rectangle(166, y - 10, 196, y + 2, "met")
        drawing.text(204, y, self._words(sentence("required, by the rule beside it")), "small")
        drawing.rectangle(396, y - 10, 426, y + 2, "prohibited")
        drawing.text(434, y, self._words(sentence("forbidden")), "small")
        return y + 16

    def _name(self, drawing: Drawing, y: float, name: str) -> None:
        drawing.group(name).text(16, y + _ROW / 2 + 4, cut(spoken(name), 32))

    def _words(self, text: str) -> str:
        return translated(text, self._language)


def _value(conditions: Mapping[str, Value], name: str) -> str:
    value = conditions[name]
    return spoken(value) if isinstance(value, str) else value_words(value)


def _title(due: Due) -> str:
    if due.negated:
        return sentence("rule {rule} forbids {response}", rule=due.rule, response=due.words.removeprefix("NOT "))
    return sentence("rule {rule} requires {response}", rule=due.rule, response=due.words)
