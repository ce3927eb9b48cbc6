"""The flow of one rule: its trigger, the conditions in the order in which they decide, and the response of each."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from sleec_runtime.model import Clause, Reading, Rule
from sleec_verify.report.document.questions import Question, questions
from sleec_verify.report.pictures.document import document
from sleec_verify.report.pictures.drawing import Drawing
from sleec_verify.wording.plain_language import condition_words, response_words, trigger_words
from sleec_verify.wording.sentence import joined, sentence
from sleec_verify.wording.translation import Language, translated

_QUESTION, _RESPONSE = (16, 366), (466, 866)
"""The left and right side of conditions and of responses."""
_LINE, _MARGIN, _BETWEEN = 17, 9, 30
"""The height of a line of text, the margin within a box, and the distance between boxes."""


def rule_flow(rule: Rule, reading: Reading, language: Language = "en", name: str = "flow") -> str:
    """The flow as an SVG document. `name` begins the ids in it."""
    title = sentence("Flow of the rule {rule}", rule=rule.label)
    asked, last = questions(rule, reading)
    return document(
        translated(title, language),
        translated(_description(rule, asked, last), language),
        _RESPONSE[1] + 16,
        lambda drawing: _Flow(drawing, language).draw(rule, title, asked, last),
        name,
    )


def _response(clause: Clause | None) -> str:
    if clause is None:
        return sentence("nothing is required")
    words = response_words(clause)
    return sentence("{response}, with exceptions of its own", response=words) if clause.hedges else words


def _description(rule: Rule, asked: Sequence[Question], last: Clause) -> str:
    steps = [sentence("When {situation}:", situation=trigger_words(rule.trigger))]
    for one in asked:
        response = _response(one.response)
        steps.append(
            sentence("if {condition}, {response};", condition=condition_words(one.condition), response=response)
            if one.deciding
            else sentence(
                "unless {condition}, {response};", condition=condition_words(one.condition), response=response
            )
        )
    steps.append(sentence("otherwise, {response}.", response=_response(last)))
    return joined(" ", steps)


class _Flow:
    """Draws one box below the other, with the responses beside them."""

    def __init__(self, drawing: Drawing, language: Language) -> None:
        self._drawing = drawing
        self._language = language

    def draw(self, rule: Rule, title: str, asked: Sequence[Question], last: Clause) -> float:
        """Draws the flow, and returns its height."""
        self._drawing.text(16, 28, self._words(title), "title")
        y = 48.0
        start = self._lines(sentence("When {situation}:", situation=trigger_words(rule.trigger)))
        bottom = self._box(_QUESTION, y, start, "event-node")
        for one in asked:
            y = bottom + _BETWEEN
            lines = self._lines(sentence("{condition}?", condition=condition_words(one.condition)))
            response = self._lines(_response(one.response))
            self._arrow_down(bottom, y)
            bottom = self._box(_QUESTION, y, lines, "question", len(response))
            middle = (y + bottom) / 2
            self._drawing.line(_QUESTION[1], middle, _RESPONSE[0], middle, "edge")
            self._drawing.arrowhead(_RESPONSE[0], middle)
            self._drawing.text(_QUESTION[1] + 36, middle - 6, self._answer(one.deciding), "small head")
            self._drawing.text(
                (_QUESTION[0] + _QUESTION[1]) / 2 + 8, bottom + 19, self._answer(not one.deciding), "small head"
            )
            self._box(_RESPONSE, y, response, "node", len(lines))
        y = bottom + _BETWEEN
        self._arrow_down(bottom, y)
        bottom = self._box(_QUESTION, y, self._lines(_response(last)), "node")
        return bottom + 20

    def _box(self, sides: tuple[int, int], y: float, lines: Sequence[str], kind: str, least: int = 0) -> float:
        """Draws text in a box, and returns its lower side."""
        bottom = y + max(len(lines), least) * _LINE + 2 * _MARGIN
        self._drawing.box(sides[0], y, sides[1], bottom, kind)
        at = (y + bottom - len(lines) * _LINE) / 2 + 12.5
        for number, line in enumerate(lines):
            self._drawing.text(sides[0] + 12, at + number * _LINE, line)
        return bottom

    def _arrow_down(self, top: float, bottom: float) -> None:
        x = (_QUESTION[0] + _QUESTION[1]) / 2
        self._drawing.line(x, top, x, bottom, "edge")
        self._drawing.arrowhead(x, bottom, "head-down")

    def _answer(self, holds: bool) -> str:
        return self._words(sentence("yes") if holds else sentence("no"))

    def _lines(self, text: str) -> list[str]:
        words = self._words(text)
        return wrap(words[:1].upper() + words[1:], 48)

    def _words(self, text: str) -> str:
        return translated(text, self._language)
