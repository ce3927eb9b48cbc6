"""Repairs of a conflict over time: the required response has more time, or an alternative.

This is the operator *deadline refinement* of SLEEC-PATCH (2026). A window of another length does not help, because a
prohibition can begin at the last instant of every window that ends.
"""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Obligation, Rule, Ruleset
from sleec_verify.repairs.clause_names import clause_name
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import printer_of, response_text
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def deadlines(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A required response is due at some time, or has another one of the rule as its alternative.

    Only for a conflict over several instants: at one instant, more time would leave open what the rules require then.
    """
    if finding.timeline is None:
        return
    for label, number in finding.clauses:
        rule = ruleset.by_label[label]
        for response in list(rule.clauses())[number].obligations:
            if response.name in finding.obligations and not response.negated:
                yield from _at_some_time(ruleset, rule, number, response)
                yield from _with_alternative(ruleset, rule, number, response)


def _at_some_time(ruleset: Ruleset, rule: Rule, number: int, response: Obligation) -> Iterator[Candidate]:
    timing, text = response.timing, printer_of(ruleset).keyword("eventually")
    if timing is None:
        edit = TextEdit(response.span.end, response.span.end, f" {text}")
    elif timing.window is not None:
        edit = TextEdit(*timing.window.span, text)
    else:
        return
    written = quoted(f"{response} {text}")
    title = sentence("write {written} in {clause}", written=written, clause=clause_name(ruleset, rule, number))
    yield Candidate("deadline-refinement", title, (edit,), rule.label)


def _with_alternative(ruleset: Ruleset, rule: Rule, number: int, response: Obligation) -> Iterator[Candidate]:
    timing = response.timing
    if timing is None or timing.window is None or any(True for _ in timing.alternatives()):
        return
    own = list(rule.clauses())[number]
    others = (one for clause in rule.clauses() if clause is not own for one in clause.obligations)
    for other in others:
        if not other.negated and other.name != response.name:
            text = f"{printer_of(ruleset).keyword('otherwise')} {response_text(ruleset, [other])}"
            title = sentence(
                "add to {response} in {clause}: {text}",
                response=quoted(str(response)),
                clause=clause_name(ruleset, rule, number),
                text=quoted(text),
            )
            start, end = response.span.start, timing.window.span.end
            edits: tuple[TextEdit, ...] = (TextEdit(end, end, f" {text}"),)
            if len(own.obligations) > 1:
                # The alternative would replace the following obligations, too.
                edits = (TextEdit(start, start, "("), TextEdit(end, end, f" {text})"))
            yield Candidate("deadline-refinement", title, edits, rule.label)
            return
