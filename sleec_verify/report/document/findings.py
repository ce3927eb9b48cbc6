"""Findings in sentences for people who do not know the language of rules."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.results.finding import ClauseRef
from sleec_verify.wording.phrases import listed
from sleec_verify.wording.plain_language import situation_words
from sleec_verify.wording.sentence import plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.repairs.numbering import FindingRepairs
    from sleec_verify.report.outcome import CheckedRuleset
    from sleec_verify.results.finding import Finding, Severity

SEVERITY_WORDS: Mapping[Severity, str] = {
    "error": sentence("Error"),
    "warning": sentence("Warning"),
    "note": sentence("Note"),
}


class NumberedFinding(NamedTuple):
    """A finding with its number in the report, from 1, its line, and its repairs, if there is a way to find some."""

    number: int
    finding: Finding
    line: int
    repairs: FindingRepairs | None


def numbered(outcome: CheckedRuleset) -> list[NumberedFinding]:
    """The findings of a ruleset, in the order of the text. The repairs of the outcome have the same order."""
    waiting = list(reversed(outcome.repairs or ()))
    return [
        NumberedFinding(
            number,
            finding,
            (finding.source or outcome.ruleset.source).place(finding.span).line,
            waiting.pop() if waiting and waiting[-1].finding == finding else None,
        )
        for number, finding in enumerate(outcome.deduplicated, 1)
    ]


def by_clause(found: list[NumberedFinding], ruleset: Ruleset) -> dict[ClauseRef, list[NumberedFinding]]:
    """The findings beside each clause that they concern. A finding that names rules but no clauses is beside their
    defaults."""
    places: dict[ClauseRef, list[NumberedFinding]] = {}
    for one in found:
        named = {clause.rule for clause in one.finding.clauses}
        others = (ClauseRef(label, 0) for label in one.finding.rules if label not in named)
        for clause in dict.fromkeys((*one.finding.clauses, *others)):
            if clause.rule in ruleset.by_label:
                places.setdefault(clause, []).append(one)
    return places


def place_words(one: NumberedFinding) -> str:
    """The code of a finding, and its line: ``SLEEC101, line 3``."""
    return sentence("{code}, line {line}", code=one.finding.code, line=one.line)


def details(finding: Finding) -> Iterator[tuple[str, str]]:
    """The situation, the domains, the note and the advice, each with its title. Timelines and strategies are shown in
    another way."""
    if finding.witness is not None and finding.timeline is None and finding.strategy is None:
        yield sentence("Situation"), sentence("{situation}. Nothing else matters.", situation=_begin(finding))
    if finding.domains:
        yield plural(len(finding.domains), "Domain", "Domains"), listed(finding.domains)
    if finding.note is not None:
        yield sentence("Why"), sentence("{text}.", text=finding.note)
    if finding.help is not None:
        is_question = finding.help.endswith("?")
        yield sentence("Advice"), finding.help if is_question else sentence("{text}.", text=finding.help)


def _begin(finding: Finding) -> str:
    assert finding.witness is not None, "only a finding with a witness has a situation"
    return sentence("It happens when {situation}", situation=situation_words(finding.witness))


def steps(finding: Finding) -> list[str]:
    """The instants of a timeline, or the moves of a strategy, as lines."""
    if finding.timeline is not None:
        from sleec_verify.report import timeline

        return list(timeline.in_words(finding.timeline))
    if finding.strategy is not None:
        from sleec_verify.report import strategy

        return list(strategy.in_words(finding.strategy))
    return []
