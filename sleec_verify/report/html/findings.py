"""Findings beside the clauses that they concern."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

from sleec_verify.report.document.findings import SEVERITY_WORDS, NumberedFinding, details, place_words, steps
from sleec_verify.report.html.elements import element
from sleec_verify.report.html.pictures import picture
from sleec_verify.report.pictures.timeline import timeline_picture
from sleec_verify.wording.sentence import sentence
from sleec_verify.wording.translation import Language, translated

if TYPE_CHECKING:
    from sleec_verify.repairs.numbering import FindingRepairs


MOST_REPAIRS = 5
"""The most repairs of one finding that are shown."""

FIXES = "`sleec-verify check --fixes`"


def anchor(section: str, number: int) -> str:
    """The id of a finding on the page."""
    return f"{section}-finding-{number}"


def finding_note(one: NumberedFinding, section: str, language: Language) -> Element:
    """The whole finding: its message, the situation, the advice and the repairs."""
    finding = one.finding
    title = sentence(
        "{severity} {number} ({place})",
        severity=SEVERITY_WORDS[finding.severity],
        number=one.number,
        place=place_words(one),
    )
    found = element(
        "aside",
        element("p", element("strong", title), kind="kind"),
        element("p", sentence("{text}.", text=finding.message), kind="message"),
        kind=f"finding {finding.severity}",
        id=anchor(section, one.number),
        aria_label=title,
    )
    shown = element("dl")
    for name, text in details(finding):
        shown.extend((element("dt", name), element("dd", text)))
    if len(shown):
        found.append(shown)
    if finding.timeline is not None:
        title = sentence("Timeline of finding {number}", number=one.number)
        name = f"{anchor(section, one.number)}-timeline"
        found.append(picture(timeline_picture(finding.timeline, translated(title, language), language, name)))
    lines = steps(finding)
    if lines:
        found.append(element("p", sentence("How it happens"), kind="label"))
        found.append(element("ol", *(element("li", line) for line in lines), kind="moments"))
    if one.repairs is not None:
        found.append(_repairs(one.repairs))
    return found


def finding_link(one: NumberedFinding, section: str) -> Element:
    """A reference to a finding that is shown beside another clause."""
    severity = SEVERITY_WORDS[one.finding.severity]
    words = sentence("{severity} {number} concerns this clause, too", severity=severity, number=one.number)
    return element("p", element("a", words, href=f"#{anchor(section, one.number)}"), kind=f"see {one.finding.severity}")


def _repairs(found: FindingRepairs) -> Element:
    from sleec_verify.report.repair_phrases import effect_in_words

    if not found.repairs:
        why = found.undecided or found.reason
        words = sentence("No repair was found.") if why is None else sentence("No repair is shown: {why}.", why=why)
        return element("p", words, kind="limit")
    shown = element("ul", kind="repairs")
    for _, repair in found.repairs[:MOST_REPAIRS]:
        effect = element("p", sentence("Effect: {effect}.", effect=effect_in_words(repair)), kind="effect")
        shown.append(element("li", element("p", sentence("{text}.", text=repair.candidate.title)), effect))
    if found.undecided is not None:
        shown.append(element("li", sentence("There may be more repairs: {why}.", why=found.undecided)))
    elif len(found.repairs) > MOST_REPAIRS:
        words = sentence("{command} lists {number} more.", number=len(found.repairs) - MOST_REPAIRS, command=FIXES)
        shown.append(element("li", words))
    return element("details", element("summary", sentence("Verified repairs")), shown, open="open")
