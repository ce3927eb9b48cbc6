"""What `diff` says, in full."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify.report.difference_phrases import (
    RELATION_NAMES,
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
from sleec_verify.wording.phrases import counted, given, in_domains, kind_words, listed, occurring, quoted
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.assertions.assertion import AssertionResult
    from sleec_verify.changes.compare import (
        Change,
        ConflictChange,
        DecidingClause,
        Difference,
        Relation,
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
    yield joined(": ", [paths_text(found.old, found.new), _relation(found.relation, palette), relation_text(found)])
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
        yield _titled(palette("unknown", sentence("unknown")), joined(": ", [what, why]))
    for note in found.notes:
        yield _titled(palette("note", sentence("note")), note)


def paths_text(old: Ruleset, new: Ruleset) -> str:
    return f"{old.source.path} -> {new.source.path}"


def _change(found: Difference, change: Change, palette: Palette) -> Iterator[str]:
    yield ""
    yield _titled(palette("strong", rule_text(change)), effect_text(change))
    yield from _sides(found, change, palette)


def _sides(found: Difference, one: Change | ConflictChange, palette: Palette) -> Iterator[str]:
    """The smallest situation, the clauses that decide in it on each side, and the number of affected situations."""
    yield joined("", ["    ", witness_text(one.witness), ":"])
    # Both words have eight characters in every language, so that the lines are aligned.
    for word, deciding, ruleset in (
        (sentence("before  "), one.before, found.old),
        (sentence("after   "), one.after, found.new),
    ):
        for at, line in enumerate(_decisions(deciding, ruleset)):
            yield joined("", ["      ", palette("faint", " " * 8 if at else word), line])
    yield joined("", ["    ", extent_text(one.extent), in_domains(one.domains)])


def _decisions(deciding: Sequence[DecidingClause], ruleset: Ruleset) -> list[str]:
    """The obligations of each clause, with its place."""
    return [deciding_text(one, ruleset) for one in deciding] or [sentence("no rule applies")]


def _timed_conflict(found: Difference, conflict: TimedConflictChange, palette: Palette) -> Iterator[str]:
    finding = conflict.finding
    source = (found.new if conflict.way == "added" else found.old).source
    yield ""
    place = f"{source.path}:{source.place(finding.span).line}"
    message = joined("", [finding.message, f" ({place})", in_domains(conflict.domains)])
    yield _titled(_conflict_head(conflict.way, palette), message)
    if finding.timeline is not None:
        yield from (joined("", ["    ", line]) for line in in_words(finding.timeline))
    elif finding.witness is not None:
        yield joined("", ["    ", witness_text(finding.witness)])


def _conflict_head(way: Way, palette: Palette) -> str:
    if way == "added":
        return palette("error", sentence("new conflict"))
    return palette("good", sentence("resolved conflict"))


def _conflict(found: Difference, conflict: ConflictChange, palette: Palette) -> Iterator[str]:
    ruleset = found.new if conflict.way == "added" else found.old
    head = _conflict_head(conflict.way, palette)
    lines = sorted({ruleset.source.place(span).line for span in conflict.origins})
    by = ""
    if lines:
        by = plural(
            len(lines),
            " (constraint in line {lines})",
            " (constraints in lines {lines})",
            lines=listed(map(str, lines)),
        )
    yield ""
    yield _titled(head, joined("", [conflict_rules(conflict), ": ", contradiction_text(conflict), by]))
    yield from _sides(found, conflict, palette)


def _situation(one: SituationChange, palette: Palette) -> Iterator[str]:
    is_added = one.way == "added"
    change = sentence("removed assumption: {text}", text=one.what)
    if not is_added:
        change = sentence("new assumption: {text}", text=one.what)
    yield ""
    yield _titled(palette("strong", sentence("situations")), change)
    if one.witness is not None and one.extent is not None:
        occurs = [sentence("when {events}", events=occurring(one.witness.triggers))] if one.witness.triggers else []
        facts = joined(", ", [*occurs, *given(one.witness.conditions)]) or sentence("any situation")
        if is_added:
            yield sentence("    is now possible, for example: {facts}", facts=facts)
        else:
            yield sentence("    is now excluded, for example: {facts}", facts=facts)
        yield joined("", ["    ", extent_text(one.extent), in_domains(one.domains)])


def _names(found: Difference, palette: Palette) -> Iterator[str]:
    for way, title in (("added", sentence("new names")), ("removed", sentence("removed names"))):
        here = (one for one in found.names if one.way == way)
        names = [sentence("{name} ({kind})", name=quoted(one.name), kind=kind_words(one.kind)) for one in here]
        if names:
            yield _titled(palette("strong", title), listed(names))


def _same_meaning(found: Difference, palette: Palette) -> Iterator[str]:
    if found.renamed:
        named = listed(sentence("{old} is now {new}", old=quoted(old), new=quoted(new)) for old, new in found.renamed)
        what = sentence("{changes} (same meaning)", changes=named)
        yield _titled(palette("strong", sentence("renamed")), what)
    if found.rewritten:
        rules = listed(quoted(labels[-1]) for labels in found.rewritten)
        what = sentence("{changes} (same meaning)", changes=rules)
        yield _titled(palette("strong", sentence("rewritten")), what)
    if found.reordered:
        what = sentence("the rules are in a different order (same meaning)")
        yield _titled(palette("strong", sentence("reordered")), what)
    if found.old.reading != found.new.reading:
        what = sentence("{old} before, {new} after", old=found.old.reading, new=found.new.reading)
        yield _titled(palette("strong", sentence("readings")), what)


def _titled(title: str, text: str) -> str:
    """An entry of a ruleset."""
    return joined("", ["  ", title, ": ", text])


def _relation(relation: Relation, palette: Palette) -> str:
    return palette(RELATION_ROLES[relation], RELATION_NAMES[relation])


def on_assertions(asked: Sequence[AssertionResult], palette: Palette) -> Iterator[str]:
    """The lines on all assertions."""
    if not asked:
        return
    from sleec_verify.changes.assertions.assertion import Violation

    for assertion, ruleset, answer in asked:
        path = ruleset.source.path
        if answer is None:
            yield joined("", [palette("good", sentence("holds")), f": {assertion.text} ({path})"])
        elif isinstance(answer, Violation):
            yield joined("", [palette("error", sentence("broken")), f": {assertion.text} ({path})"])
            where = in_domains((answer.domain,) if answer.domain else ())
            yield joined("", ["  ", witness_text(answer.witness), where, ":"])
            yield from (joined("", ["    ", line]) for line in _decisions(answer.deciding, ruleset))
        else:
            yield joined("", [palette("unknown", sentence("unknown")), f": {assertion.text} ({path}): ", str(answer)])


def _in_all(report: DifferenceReport, palette: Palette) -> str:
    number = len(report.compared) + report.unchanged
    unusable = sum(bool(one.errors) for one in report.compared)
    parts = [sentence("{number} unchanged", number=report.unchanged)] if report.unchanged else []
    parts += [sentence("{number} unusable", number=unusable)] if unusable else []
    size = counted(number, "ruleset")
    counts = sentence("{size} ({parts})", size=size, parts=listed(parts)) if parts else size
    return joined(": ", [counts, _relation(report.relation, palette), WORDS[report.relation]])
