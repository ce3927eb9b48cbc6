"""For people: each finding with an excerpt of the text, a situation that shows it, and a suggestion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from sleec_verify.report.details import details
from sleec_verify.report.escape import as_text
from sleec_verify.report.excerpt import Mark, excerpt
from sleec_verify.report.outcome import (
    CheckedRuleset,
    Outcome,
    UnusableInput,
    deduplicated_findings,
    severity_count,
    tally,
)
from sleec_verify.results.finding import SEVERITIES
from sleec_verify.wording.phrases import counted, error_summary
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Source
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.repairs.numbering import FindingRepairs
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import Finding


@as_text
def render(outcomes: Sequence[Outcome], palette: Palette) -> Iterator[str]:
    """The findings of each ruleset and a summary line; if there are several rulesets, a summary of all at the end."""
    for outcome in outcomes:
        if isinstance(outcome, UnusableInput):
            unusable = palette("error", sentence("unusable"))
            yield joined(": ", [outcome.path, unusable, error_summary(outcome.error)])
            continue
        source = outcome.ruleset.source
        for finding in outcome.deduplicated:
            yield from finding_lines(finding, finding.source or source, palette, outcome.repairs_of(finding))
            yield ""
        for name, why in outcome.unlisted:
            yield joined(" ", [f"{source.path}:", palette("note", f"note[{name}]"), why])
            yield ""
        for name, why in outcome.undecided:
            yield joined(" ", [f"{source.path}:", palette("unknown", f"unknown[{name}]"), why])
            yield ""
        if outcome.audit is not None:
            from sleec_verify.report import audit

            yield from audit.lines(outcome.audit, outcome.ruleset)
        yield _on(outcome, palette)
    if len(outcomes) > 1:
        parts = [_counts(outcomes)]
        failed = sum(isinstance(outcome, UnusableInput) for outcome in outcomes)
        parts += [sentence("{number} unusable", number=failed)] if failed else []
        yield joined(": ", [counted(len(outcomes), "ruleset"), joined(", ", parts)])


def finding_lines(
    finding: Finding, source: Source, palette: Palette, repairs: FindingRepairs | None = None
) -> Iterator[str]:
    """The lines of one finding, with its repairs if somebody asked for them, without the blank line after it."""
    place = source.place(finding.span)
    label = palette(finding.severity, f"{finding.severity}[{finding.code}]")
    yield joined(" ", [f"{source.path}:{place.line}:{place.column}:", label, palette("strong", finding.message)])
    marks = [Mark(finding.span, finding.severity, main=True)]
    marks += (Mark(span, "help", word) for span, word in finding.related)
    if source.text:
        yield from excerpt(source, marks, palette)
    margin = " " * len(str(max(source.place(mark.span).end_line for mark in marks)))
    for title, text, lines in details(finding, chart=True):
        shown = joined("", [f"{margin} = ", palette("help" if title == "help" else "strong", title), ":"])
        yield joined(" ", [shown, text]) if text else shown
        yield from (joined("     ", [margin, line]) for line in lines)
    if repairs is not None:
        title = joined("", [f"{margin} = ", palette("help", sentence("repairs")), ":"])
        yield title if repairs.repairs or repairs.undecided else joined(" ", [title, _none(repairs)])
        yield from (joined("     ", [margin, line]) for line in _repair_lines(repairs, palette))


def _none(found: FindingRepairs) -> str:
    if found.reason is None:
        return sentence("none found")
    return sentence("none found: {reason}", reason=found.reason)


def _repair_lines(found: FindingRepairs, palette: Palette) -> Iterator[str]:
    from sleec_verify.report.repair_phrases import effect_in_words

    for identifier, repair in found.repairs:
        yield joined(" ", [palette("strong", identifier), repair.candidate.title])
        yield joined(" ", [" " * len(identifier), palette("faint", effect_in_words(repair))])
    if found.undecided is not None:
        yield sentence(
            "{unknown} There may be more: {reason}",
            unknown=palette("unknown", sentence("unknown")),
            reason=found.undecided,
        )


def error_lines(error: SleecError, palette: Palette) -> Iterator[str]:
    """The lines of an error of the input, with excerpts of the text if it has places."""
    from sleec_runtime.errors import CertificateRefused, LanguageError

    if not isinstance(error, LanguageError):
        messages = [message for _, message in error.problems] if isinstance(error, CertificateRefused) else []
        yield from (f"{palette('error', 'error')}: {message}" for message in messages or [error.message])
        if error.hint is not None:
            yield f"  = {palette('help', 'help')}: {error.hint}"
        return
    for problem in error.problems:
        place = error.source.place(problem.span)
        where = f"{error.source.path}:{place.line}:{place.column}"
        yield f"{where}: {palette('error', 'error')}: {palette('strong', problem.message)}"
        yield from excerpt(error.source, [Mark(problem.span, "error", main=True)], palette)
        if problem.hint is not None:
            yield f"{' ' * len(str(place.end_line))} = {palette('help', 'help')}: {problem.hint}"
        yield ""


def _on(outcome: CheckedRuleset, palette: Palette) -> str:
    ruleset = outcome.ruleset
    size = joined(", ", [counted(len(ruleset.rules), "rule"), counted(outcome.hedges, "exception")])
    if outcome.undecided:
        unknown = sentence("{number} unknown", number=len(outcome.undecided))
        verdict = palette("unknown", joined(", ", [_counts([outcome]), unknown]))
    elif outcome.findings:
        verdict = palette(_gravest(outcome), _counts([outcome]))
    else:
        passed = plural(len(outcome.results), "{number} check passed", "{number} checks passed")
        verdict = palette("good", passed)
    due = _DUE[outcome.untimed] if outcome.untimed is not None else ""
    return sentence(
        "{path}: {verdict} (reading {reading}; {size}{due})",
        path=ruleset.source.path,
        verdict=verdict,
        reading=ruleset.reading,
        size=size,
        due=due,
    )


_DUE: Mapping[Untimed, str] = {
    "at": sentence("; responses without a window: immediately"),
    "eventually": sentence("; responses without a window: eventually"),
}


def _gravest(outcome: CheckedRuleset) -> str:
    return min((f.severity for f in outcome.findings), key=SEVERITIES.index)


def _counts(outcomes: Sequence[Outcome]) -> str:
    found = tally(deduplicated_findings(outcomes)).items()
    return joined(", ", (severity_count(number, severity) for severity, number in found))
