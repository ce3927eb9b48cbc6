"""Repairs of a conflict over time: one of the windows changes, or the response has an alternative.

The lengths come from the other window. This is the operator *deadline refinement* of SLEEC-PATCH (2026).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.model import (
    RELATIONS,
    Assume,
    Exclusive,
    Length,
    Never,
    Number,
    Obligation,
    Rule,
    Ruleset,
    Window,
    literals,
)
from sleec_verify.encoding.relations import events_of
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import printer_of, response_text
from sleec_verify.results.finding import Finding
from sleec_verify.results.phrases import clause_name, quoted


class _Due(NamedTuple):
    """A response of a clause."""

    rule: Rule
    number: int
    response: Obligation

    @property
    def window(self) -> Window | None:
        return self.response.timing.window if self.response.timing is not None else None


def deadlines(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A required response may come after the end of the prohibition, or at any time, or it has an alternative; or the
    prohibition ends before the response is due."""
    if not ruleset.is_timed:
        return
    due = [
        _Due(ruleset.by_label[label], number, response)
        for label, number in finding.clauses
        for response in list(ruleset.by_label[label].clauses())[number].obligations
        if response.name in finding.obligations
    ]
    for required in due:
        for forbidden in due:
            name = required.response.name
            if not required.response.negated and forbidden.response.negated and forbidden.response.name == name:
                yield from _moved(ruleset, required, forbidden)


def _moved(ruleset: Ruleset, required: _Due, forbidden: _Due) -> Iterator[Candidate]:
    until, by = _end(forbidden.window), _end(required.window)
    # An event that nothing restricts may occur at every instant, so that its prohibitions never end.
    if forbidden.rule.trigger in _restricted(ruleset):
        if until is not None:
            yield from _with_window(ruleset, required, _within(ruleset, until, 1))
        if forbidden.window is not None and required.window is not None and by is not None:
            yield from _with_window(ruleset, forbidden, _within(ruleset, by, -1))
        if forbidden.window is not None:
            yield from _with_window(ruleset, forbidden, "")
    yield from _with_window(ruleset, required, printer_of(ruleset).keyword("eventually"))
    yield from _with_alternative(ruleset, required)


def _restricted(ruleset: Ruleset) -> set[str]:
    """The events that a rule forbids, or that a relation or constraint names."""
    clauses = (clause for rule in ruleset.rules for clause in rule.clauses())
    found = {one.name for clause in clauses for one in literals(clause) if one.negated}
    laws = (s for s in ruleset.statements if isinstance(s, (*RELATIONS, Never, Assume, Exclusive)))
    return found.union(*map(events_of, laws))


def _end(window: Window | None) -> Length | None:
    """The end of a window, if it is a number: now, without a window."""
    if window is None:
        return Length(Number(0), "seconds")
    return window.end if window.end is not None and isinstance(window.end.amount, Number) else None


def _within(ruleset: Ruleset, end: Length, units: int) -> str:
    """A window that ends that many units of time after another one; no window if none of its time is left."""
    assert isinstance(end.amount, Number), "a length that a measure gives has no number"
    amount = end.amount.value + units
    printer = printer_of(ruleset)
    return f"{printer.keyword('within')} {printer.length(Length(Number(amount), end.unit))}" if amount > 0 else ""


def _with_window(ruleset: Ruleset, due: _Due, text: str) -> Iterator[Candidate]:
    """The response with this window, or without one."""
    source = ruleset.source.text
    window, name = due.window, quoted(str(due.response))
    if window is None and due.response.timing is not None:
        return
    end = due.response.span.end if window is None else window.span.end
    start = len(source[: end if window is None else window.span.start].rstrip())
    place = clause_name(due.rule, due.number)
    what = f"write {quoted(text)} for {name}" if text else f"remove the window of {name}"
    edit = TextEdit(start, end, f" {text}" if text else "")
    yield Candidate("deadline-refinement", f"{what} in {place}", (edit,), due.rule.label)


def _with_alternative(ruleset: Ruleset, due: _Due) -> Iterator[Candidate]:
    """The response with another one of the same rule as its alternative, after its window."""
    timing = due.response.timing
    if timing is None or timing.window is None or timing.otherwise is not None or timing.instead is not None:
        return
    others = [one for clause in due.rule.clauses() for one in clause.obligations if not one.negated]
    for other in dict.fromkeys(one for one in others if one.name != due.response.name):
        text = f"{printer_of(ruleset).keyword('otherwise')} {response_text(ruleset, [other])}"
        end = timing.window.span.end
        title = f"add {quoted(text)} to {quoted(str(due.response))} in {clause_name(due.rule, due.number)}"
        yield Candidate("deadline-refinement", title, (TextEdit(end, end, f" {text}"),), due.rule.label)
        return
