"""Names that read like something else: the text says what people read."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Declaration, Measure, Ruleset, Span
from sleec_verify.checks.misread_names import replacements
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate, Operator
from sleec_verify.repairs.statement_edits import replaced, without
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import plural

_OTHER_NAME = ("SLEEC525", "SLEEC526")


def names(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The text to write instead of a name, at all of its places."""
    changes = replacements(ruleset, finding)
    if changes:
        edits = tuple(edit for span, text in changes for edit in _edits(ruleset, span, text))
        written = ruleset.source.text[slice(*finding.span)]
        operator: Operator = "renaming" if finding.code in _OTHER_NAME else "canonical-form"
        title = plural(
            len(changes),
            "replace {written} with {text}",
            "replace {written} with {text} in {number} places",
            written=quoted(written),
            text=quoted(changes[0][1]),
        )
        yield Candidate(operator, title, edits)


def _edits(ruleset: Ruleset, place: Span, text: str) -> tuple[TextEdit, ...]:
    """The name at a place is replaced. Its declaration is removed, because the other name has one."""
    for statement in ruleset.statements:
        if isinstance(statement, (Declaration, Measure)) and statement.span.start <= place.start < statement.span.end:
            return without(ruleset, statement.span)
    return replaced(place, text)
