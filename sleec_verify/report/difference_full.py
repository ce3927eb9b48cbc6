"""What `diff` says, in full."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify.report.difference_phrases import (
    RELATION_ROLES,
    WORDS,
    conflict_rules,
    contradiction_text,
    deciding_text,
    effect_text,
    extent_text,
    relation_text,
    rule_text,
    witness_text,
)
from sleec_verify.report.escape import as_text
from sleec_verify.report.timeline import in_words
from sleec_verify.results.phrases import counted, given, in_domains, listed, occurring, quoted

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.assertions.assertion import AssertionResult
    from sleec_verify.changes.compare import (
        Change,
        ConflictChange,
        DecidingClause,
        Difference,
        SituationChange,
        TimedConflictChange,
    )
    from sleec_verify.changes.compare.result import Way
    from sleec_verify.report.difference_report import DifferenceReport
    from sleec_verify.report.palette import Palette


@as_text
def render(report: DifferenceReport, palette: Palette) -> Iterator[str]:
    parts = [list(on_difference(found, palette)) for found in report.differences]
    if report.asked:
        parts.append(list(on_assertions(report.asked, palette)))
    if len(report.compared) + report.unchanged > 1:
        parts.append([_in_all(report, palette)])
    for number, part in enumerate(parts):
        yield from ("",) if number else ()
        yield from part


def on_difference(found: Difference, palette: Palette) -> Iterator[str]:
    """The lines on one ruleset."""
    word = palette(RELATION_ROLES[found.relation], found.relation)
    yield f"{paths_text(found.old, found.new)}: {word}: {relation_text(found)}"
    for change in found.changes:
        yield from _change(found, change, palette)
    for conflict in found.conflicts:
        yield from _conflict(found, conflict, palette)
    for timed in found.timed_conflicts:
        yield from _timed_conflict(found, timed, palette)
    for situation in found.situations:
        yield from _situation(situation, palette)
    if found.names or found.renamed or found.rewritten or found.reordered or found.undecided or found.notes:
        yield ""
    yield from _names(found, palette)
    yield from _same_meaning(found, palette)
    for what, why in found.undecided:
        yield f"  {palette('unknown', 'unknown')}: {what}: {why}"
    for note in found.notes:
        yield f"  {palette('note', 'note')}: {note}"


def paths_text(old: Ruleset, new: Ruleset) -> str:
    return f"{old.source.path} -> {new.source.path}"


def _change(found: Difference, change: Change, palette: Palette) -> Iterator[str]:
    yield ""
    yield f"  {palette('strong', rule_text(change))}: {effect_text(change)}"
    yield f"    {witness_text(change.witness)}:"
    yield from _before_and_after(found, change.before, change.after, palette)
    yield f"    {extent_text(change.extent)}{in_domains(change.domains)}"


def _before_and_after(
    found: Difference, before: Sequence[DecidingClause], after: Sequence[DecidingClause], palette: Palette
) -> Iterator[str]:
    for word, deciding, ruleset in (("before", before, found.old), ("after", after, found.new)):
        for at, line in enumerate(_decisions(deciding, ruleset)):
            yield f"      {palette('faint', f'{word if at == 0 else str():7}')} {line}"


def _decisions(deciding: Sequence[DecidingClause], ruleset: Ruleset) -> list[str]:
    """The obligations of each clause, with its place."""
    return [deciding_text(one, ruleset) for one in deciding] or ["no rule applies"]


def _timed_conflict(found: Difference, conflict: TimedConflictChange, palette: Palette) -> Iterator[str]:
    finding = conflict.finding
    source = (found.new if conflict.way == "added" else found.old).source
    yield ""
    place = f"{source.path}:{source.place(finding.span).line}"
    yield f"  {_conflict_head(conflict.way, palette)}: {finding.message} ({place}){in_domains(conflict.domains)}"
    if finding.timeline is not None:
        yield from (f"    {line}" for line in in_words(finding.timeline))
    elif finding.witness is not None:
        yield f"    {witness_text(finding.witness)}"


def _conflict_head(way: Way, palette: Palette) -> str:
    return palette("error", "new conflict") if way == "added" else palette("good", "resolved conflict")


def _conflict(found: Difference, conflict: ConflictChange, palette: Palette) -> Iterator[str]:
    ruleset = found.new if conflict.way == "added" else found.old
    head = _conflict_head(conflict.way, palette)
    lines = sorted({ruleset.source.place(span).line for span in conflict.origins})
    several = "s" if len(lines) > 1 else ""
    by = f" (constraint{several} in line{several} {listed(map(str, lines))})" if lines else ""
    yield ""
    yield f"  {head}: {conflict_rules(conflict)}: {contradiction_text(conflict)}{by}"
    yield f"    {witness_text(conflict.witness)}:"
    yield from _before_and_after(found, conflict.before, conflict.after, palette)
    yield f"    {extent_text(conflict.extent)}{in_domains(conflict.domains)}"


def _situation(one: SituationChange, palette: Palette) -> Iterator[str]:
    yield ""
    if one.way == "added":
        yield f"  {palette('strong', 'situations')}: removed assumption: {one.what}"
    else:
        yield f"  {palette('strong', 'situations')}: new assumption: {one.what}"
    if one.witness is not None and one.extent is not None:
        word = "is now possible" if one.way == "added" else "is now excluded"
        occurs = f"when {occurring(one.witness.triggers)}" if one.witness.triggers else ""
        facts = ", ".join(part for part in (occurs, *given(one.witness.conditions)) if part) or "any situation"
        yield f"    {word}, for example: {facts}"
        yield f"    {extent_text(one.extent)}{in_domains(one.domains)}"


def _names(found: Difference, palette: Palette) -> Iterator[str]:
    for way, title in (("added", "new names"), ("removed", "removed names")):
        names = [f"{quoted(one.name)} ({one.kind})" for one in found.names if one.way == way]
        if names:
            yield f"  {palette('strong', title)}: {listed(names)}"


def _same_meaning(found: Difference, palette: Palette) -> Iterator[str]:
    if found.renamed:
        named = listed(f"{quoted(old)} is now {quoted(new)}" for old, new in found.renamed)
        yield f"  {palette('strong', 'renamed')}: {named} (same meaning)"
    if found.rewritten:
        rules = listed(quoted(labels[-1]) for labels in found.rewritten)
        yield f"  {palette('strong', 'rewritten')}: {rules} (same meaning)"
    if found.reordered:
        yield f"  {palette('strong', 'reordered')}: the rules are in a different order (same meaning)"
    if found.old.reading != found.new.reading:
        yield f"  {palette('strong', 'readings')}: {found.old.reading} before, {found.new.reading} after"


def on_assertions(asked: Sequence[AssertionResult], palette: Palette) -> Iterator[str]:
    """The lines on all assertions."""
    if not asked:
        return
    from sleec_verify.changes.assertions.assertion import Violation

    for assertion, ruleset, answer in asked:
        path = ruleset.source.path
        if answer is None:
            yield f"{palette('good', 'holds')}: {assertion.text} ({path})"
        elif isinstance(answer, Violation):
            yield f"{palette('error', 'broken')}: {assertion.text} ({path})"
            yield f"  {witness_text(answer.witness)}{in_domains((answer.domain,) if answer.domain else ())}:"
            yield from (f"    {line}" for line in _decisions(answer.deciding, ruleset))
        else:
            yield f"{palette('unknown', 'unknown')}: {assertion.text} ({path}): {answer}"


def _in_all(report: DifferenceReport, palette: Palette) -> str:
    word = palette(RELATION_ROLES[report.relation], report.relation)
    number = len(report.compared) + report.unchanged
    unusable = sum(bool(one.errors) for one in report.compared)
    parts = [f"{report.unchanged} unchanged"] if report.unchanged else []
    parts += [f"{unusable} unusable"] if unusable else []
    return f"{counted(number, 'ruleset')}{f' ({listed(parts)})' if parts else ''}: {word}: {WORDS[report.relation]}"
