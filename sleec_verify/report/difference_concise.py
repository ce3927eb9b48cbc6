"""What `diff` says, a line for each change."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.changes.compare import by_obligation
from sleec_verify.report.difference_phrases import RELATION_ROLES
from sleec_verify.report.escape import as_text
from sleec_verify.wording.phrases import counted, in_domains, in_short, value_text

if TYPE_CHECKING:
    from sleec_verify.changes.compare import (
        Change,
        ConflictChange,
    )
    from sleec_verify.report.difference_report import DifferenceReport
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import Witness


@as_text
def render(report: DifferenceReport, palette: Palette) -> Iterator[str]:
    from sleec_verify.changes.assertions.assertion import Violation

    for found in report.differences:
        path = found.new.source.path
        for change, obligation, way in by_obligation(found.changes):
            sign = palette("good", "+") if way == "added" else palette("error", "-")
            yield f"{path}: {sign} {in_short(obligation)} {_short_cause(change)}"
        for conflict in found.conflicts:
            sign = palette("error", "+ conflict") if conflict.way == "added" else palette("good", "- conflict")
            at_odds = ", ".join(map(str, conflict.literals)) or "constraints"
            yield f"{path}: {sign} {at_odds} {_short_cause(conflict)}"
        for timed in found.timed_conflicts:
            sign = palette("error", "+ conflict") if timed.way == "added" else palette("good", "- conflict")
            yield f"{path}: {sign} {', '.join(timed.finding.obligations)} [{'/'.join(timed.rules)}] over time"
        for situation in found.situations:
            sign = "+" if situation.way == "added" else "-"
            yield f"{path}: {sign} situations: {situation.what}{in_domains(situation.domains)}"
        for way, kind, name in found.names:
            yield f"{path}: {'+' if way == 'added' else '-'} {kind} {name}"
        for what, why in found.undecided:
            yield f"{path}: {palette('unknown', 'unknown')} {what}: {why}"
        yield f"{path}: {palette(RELATION_ROLES[found.relation], found.relation)}"
    for assertion, ruleset, answer in report.asked:
        if isinstance(answer, Violation):
            broken = f"{palette('error', 'broken')} {assertion.text}"
            where = in_domains((answer.domain,) if answer.domain else ())
            yield f"{ruleset.source.path}: {broken}: {_short_witness(answer.witness)}{where}"
        elif answer is not None:
            yield f"{ruleset.source.path}: {palette('unknown', 'unknown')} {assertion.text}: {answer}"
    if len(report.compared) + report.unchanged > 1:
        yield f"{counted(len(report.compared) + report.unchanged, 'ruleset')}: {report.relation}"


def _short_cause(one: Change | ConflictChange) -> str:
    count = "" if one.extent.affected is None else f" ({one.extent.affected:,}/{one.extent.possible:,})"
    return f"[{'/'.join(one.rules)}] {_short_witness(one.witness)}{count}{in_domains(one.domains)}"


def _short_witness(witness: Witness) -> str:
    facts = [*witness.triggers, *(f"{name}={value_text(value)}" for name, value in witness.conditions.items())]
    return f"when {', '.join(facts)}"
