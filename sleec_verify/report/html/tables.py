"""Tables of situations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

from sleec_verify.report.document.table_words import (
    cell_words,
    column_words,
    contradictions,
    decision_words,
    left_out,
    reading_words,
)
from sleec_verify.report.html.elements import Child, element
from sleec_verify.wording.names import spoken
from sleec_verify.wording.plain_language import trigger_words
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.diagram.variables import Variable
    from sleec_verify.decision_tables.table import DecisionTable, Row

ANY = "–"
"""The cell of a name that does not matter."""


def table(caption: str | None, heads: Sequence[str], rows: Sequence[Sequence[Child]], kind: str = "") -> Element:
    """A table whose first column names the rows."""
    body = element("tbody")
    for first, *others in rows:
        line = element("tr", element("th", first, scope="row"), *(element("td", cell) for cell in others))
        body.append(line)
    head = element("thead", element("tr", *(element("th", one, scope="col") for one in heads)))
    found = element("table", element("caption", caption) if caption else None, head, body, kind=kind or None)
    return element("div", found, kind="scroll", tabindex="0", role="group", aria_label=caption or heads[0])


def decision_table(shown: DecisionTable, ruleset: Ruleset) -> list[Element]:
    """The table of one rule: the situations, and what the rule requires."""
    columns = shown.variables
    caption = sentence("When {event}", event=trigger_words(shown.trigger))
    rows: list[Sequence[Child]] = [(*_cells(row, columns, ruleset), _required(row, ruleset)) for row in shown.rows]
    return _with_limits(caption, shown, sentence("Then"), rows)


def trigger_table(shown: DecisionTable, ruleset: Ruleset) -> list[Element]:
    """The table of several rules with one trigger. A rule of the row is named before what it requires."""
    columns = shown.variables
    caption = sentence("When {event}", event=trigger_words(shown.trigger))
    rows: list[Sequence[Child]] = [
        (*_cells(row, columns, ruleset), _required_by_each(row, ruleset)) for row in shown.rows
    ]
    return _with_limits(caption, shown, sentence("Then"), rows)


def reading_table(shown: DecisionTable, ruleset: Ruleset) -> list[Element]:
    """The situations in which a rule requires something else in the other reading."""
    caption = sentence("Rule {rule} when {event}", rule=spoken(shown.rules[0]), event=trigger_words(shown.trigger))
    columns = shown.variables
    rows: list[Sequence[Child]] = []
    for row in shown.rows:
        cascade, priority = reading_words(row, ruleset)
        rows.append((*_cells(row, columns, ruleset), cascade, priority))
    return _with_limits(caption, shown, sentence("Read as a cascade"), rows, sentence("Read by priority"))


def _with_limits(
    caption: str, shown: DecisionTable, last: str, rows: Sequence[Sequence[Child]], *more: str
) -> list[Element]:
    heads = [*map(column_words, shown.variables)] or [sentence("Situation")]
    notes = [element("p", note, kind="limit") for note in left_out(shown)]
    kind = "readings" if more else "decision"
    return [*([table(caption, [*heads, last, *more], rows, kind)] if rows else []), *notes]


def _cells(row: Row, columns: Sequence[Variable], ruleset: Ruleset) -> list[str]:
    by_variable = {cell.variable: cell_words(cell, ruleset) for cell in row.cells}
    return [by_variable.get(variable, ANY) for variable in columns] or [sentence("in every situation")]


def _required(row: Row, ruleset: Ruleset) -> Element:
    words = next((words for _, words in decision_words(row, ruleset)), sentence("the rule does not apply"))
    return element("ul", element("li", words), *_contradictions(row, ruleset), kind="plain")


def _required_by_each(row: Row, ruleset: Ruleset) -> Element:
    found = element("ul", kind="plain")
    for label, words in decision_words(row, ruleset):
        found.append(element("li", element("strong", spoken(label)), element("span", ": "), words))
    if not len(found):
        found.append(element("li", sentence("no rule applies")))
    found.extend(_contradictions(row, ruleset))
    return found


def _contradictions(row: Row, ruleset: Ruleset) -> list[Element]:
    return [element("li", words, kind="clash") for words in contradictions(row, ruleset)]
