"""Names that read like something else: the text says what people read."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Ruleset
from sleec_verify.checks.misread_names import replacements
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate, Operator
from sleec_verify.results.finding import Finding
from sleec_verify.results.phrases import counted, quoted

_SIMILAR = "SLEEC525"


def names(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The text to write instead of a name, at all of its places."""
    edits = tuple(TextEdit(*span, text) for span, text in replacements(ruleset, finding))
    if edits:
        written = ruleset.source.text[slice(*finding.span)]
        places = f" in {counted(len(edits), 'place')}" if len(edits) > 1 else ""
        operator: Operator = "renaming" if finding.code == _SIMILAR else "canonical-form"
        yield Candidate(operator, f"write {quoted(edits[0].text)} for {quoted(written)}{places}", edits)
