"""Repairs of a conflict with a NEVER: it gets an exception for the situation of the rules, or is removed."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Ruleset
from sleec_verify.encoding.equation import conjunction, guard
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.operators.conditions import conjuncts
from sleec_verify.repairs.operators.giving_way import nevers_of
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import formula_text, without
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def nevers(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Defeater introduction at a NEVER, or its removal."""
    parts = [
        part
        for label, number in finding.clauses
        for part in conjuncts(guard(ruleset.by_label[label], ruleset.reading, number))
    ]
    for never in nevers_of(ruleset, finding):
        written = quoted(ruleset.source.in_one_line(never.span))
        if parts:
            exception = f"UNLESS {formula_text(ruleset, conjunction(list(dict.fromkeys(parts))))}"
            edits = (TextEdit(never.span.end, never.span.end, f" {exception}"),)
            yield Candidate(
                "defeater-introduction",
                sentence("add to {written}: {exception}", written=written, exception=quoted(exception)),
                edits,
            )
        yield Candidate("rule-removal", sentence("remove {written}", written=written), without(ruleset, never.span))
