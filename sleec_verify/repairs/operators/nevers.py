"""Repairs of a conflict with a NEVER: it gets an exception for the situation of the rules, or is removed."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Ruleset
from sleec_verify.encoding.equation import conjunction, guard
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.operators.claim_cases import parts_of
from sleec_verify.repairs.operators.giving_way import nevers_of
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import formula_text, without
from sleec_verify.results.finding import Finding
from sleec_verify.results.phrases import quoted


def nevers(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Defeater introduction at a NEVER, or its removal."""
    parts = [
        part
        for label, number in finding.clauses
        for part in parts_of(guard(ruleset.by_label[label], ruleset.reading, number))
    ]
    for never in nevers_of(ruleset, finding):
        written = quoted(" ".join(ruleset.source.text[slice(*never.span)].split()))
        if parts:
            exception = f"UNLESS {formula_text(ruleset, conjunction(list(dict.fromkeys(parts))))}"
            edits = (TextEdit(never.span.end, never.span.end, f" {exception}"),)
            yield Candidate("defeater-introduction", f"add to {written}: {quoted(exception)}", edits)
        yield Candidate("rule-removal", f"remove {written}", without(ruleset, never.span))
