"""The flow of a rule: the questions in the order in which they decide, each with the response that it leads to."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

from sleec_verify.report.document.questions import Question, nested_questions, questions
from sleec_verify.report.html.elements import element
from sleec_verify.wording.plain_language import condition_words, response_words, trigger_words
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Clause, Reading, Rule

Notes = Callable[[int], Sequence[Element]]
"""The findings beside a clause, by its number."""


def flow(rule: Rule, reading: Reading, notes: Notes) -> Element:
    """The flow from the trigger to the responses, with the findings beside them."""
    numbers = {id(clause): number for number, clause in enumerate(rule.clauses())}
    start = element("p", sentence("When {situation}", situation=trigger_words(rule.trigger)), kind="trigger")
    return element("div", start, _Steps(reading, numbers, notes).shown(*questions(rule, reading)), kind="flow")


class _Steps:
    """The steps of one rule. `numbers` are those of the clauses, by identity."""

    def __init__(self, reading: Reading, numbers: dict[int, int], notes: Notes) -> None:
        self._reading = reading
        self._numbers = numbers
        self._notes = notes

    def shown(self, asked: Sequence[Question], last: Clause, own: Clause | None = None) -> Element:
        """A list of the questions. `own` is the clause whose exceptions these are."""
        steps = [self._step(one, own) for one in asked]
        response, *notes = self._response(last, own)
        end = element("li", response, element("div", *notes, kind="beside") if notes else None, kind="step last")
        return element("ol", *steps, end, kind="steps")

    def _step(self, one: Question, own: Clause | None) -> Element:
        yes, no = sentence("Yes:"), sentence("No:")
        leads, goes_on = (yes, sentence("No: go on")) if one.deciding else (no, sentence("Yes: go on"))
        asked = element("p", sentence("{condition}?", condition=condition_words(one.condition)), kind="condition")
        answer = element("div", element("p", leads, kind="answer"), *self._response(one.response, own), kind="then")
        return element("li", asked, answer, element("p", goes_on, kind="else"), kind="step")

    def _response(self, clause: Clause | None, own: Clause | None) -> list[Element]:
        """The response of a clause, or the flow of its exceptions."""
        if clause is None:
            return [_box(sentence("nothing is required"))]
        if clause.hedges and clause is not own:
            return [self.shown(*nested_questions(clause, self._reading), clause)]
        return [_box(response_words(clause)), *self._notes(self._numbers[id(clause)])]


def _box(words: str) -> Element:
    return element("p", words, kind="response")
