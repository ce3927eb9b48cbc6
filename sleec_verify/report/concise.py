"""For lists and logs: one line for each finding, and a summary line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify.report.escape import as_text
from sleec_verify.report.outcome import Outcome, UnusableInput, checked, in_short
from sleec_verify.wording.phrases import error_summary, in_domains, listed
from sleec_verify.wording.sentence import joined, sentence

if TYPE_CHECKING:
    from sleec_verify.repairs.numbering import FindingRepairs
    from sleec_verify.report.palette import Palette


@as_text
def render(outcomes: Sequence[Outcome], palette: Palette) -> Iterator[str]:
    """A line for each finding and each check without a verdict, in the order of the rulesets and their texts."""
    for outcome in outcomes:
        if isinstance(outcome, UnusableInput):
            unusable = palette("error", sentence("unusable"))
            yield joined(": ", [outcome.path, unusable, error_summary(outcome.error)])
            continue
        rules = outcome.ruleset.source
        for finding in outcome.deduplicated:
            source = finding.source or rules
            place = source.place(finding.span)
            label = palette(finding.severity, f"{finding.severity}[{finding.code}]")
            message = joined("", [finding.message, in_domains(finding.domains)])
            here = f"{source.path}:{place.line}:{place.column}:"
            yield joined(" ", [here, label, message])
            repairs = outcome.repairs_of(finding)
            if repairs is not None:
                yield from (joined(" ", [here, line]) for line in _repairs(repairs, palette))
        for name, why in outcome.unlisted:
            yield joined(" ", [f"{rules.path}:", palette("note", f"note[{name}]"), why])
        for name, why in outcome.undecided:
            yield joined(" ", [f"{rules.path}:", palette("unknown", f"unknown[{name}]"), why])
    readings = sorted({outcome.ruleset.reading for outcome in checked(outcomes) if not outcome.settings})
    summary = in_short(outcomes)
    yield sentence("{summary} (reading {reading})", summary=summary, reading=listed(readings)) if readings else summary


def _repairs(found: FindingRepairs, palette: Palette) -> Iterator[str]:
    from sleec_verify.report.repair_phrases import effect_in_words

    for identifier, repair in found.repairs:
        label = palette("help", f"repair[{identifier}]")
        effect = joined("", ["(", effect_in_words(repair), ")"])
        yield joined(" ", [label, repair.candidate.title, effect])
    if found.reason is not None:
        yield joined(" ", [palette("help", "repair[none]"), found.reason])
    if found.undecided is not None:
        yield sentence(
            "{unknown} there may be more: {reason}",
            unknown=palette("unknown", "unknown[repairs]"),
            reason=found.undecided,
        )
