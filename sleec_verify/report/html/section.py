"""The part of the page about one ruleset."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

from sleec_runtime.model import Claim, Exclusive, Never
from sleec_verify.report.document.changes import changes, summary
from sleec_verify.report.document.findings import by_clause, numbered
from sleec_verify.report.document.names import names
from sleec_verify.report.document.verdict import (
    STANDING_WORDS,
    conditions_of_validity,
    fingerprint,
    headline,
    repetition,
    standing,
    verdicts,
)
from sleec_verify.report.html.cards import card
from sleec_verify.report.html.elements import element
from sleec_verify.report.html.findings import anchor, finding_link, finding_note
from sleec_verify.report.html.pictures import picture
from sleec_verify.report.html.tables import reading_table, table, trigger_table
from sleec_verify.report.pictures.rule_graph import rule_graph
from sleec_verify.results.deduplication import stands_for
from sleec_verify.results.finding import ClauseRef
from sleec_verify.wording.phrases import counted, listed
from sleec_verify.wording.sentence import joined, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.report.document.content import Content
    from sleec_verify.report.document.findings import NumberedFinding
    from sleec_verify.report.document.verdict import Verdict
    from sleec_verify.wording.translation import Language


MOST_DRAWN = 60
"""The most rules of a graph."""


def section(content: Content, name: str, language: Language) -> Element:
    """The section on a ruleset. All ids in it begin with `name`."""
    ruleset = content.ruleset
    found = numbered(content.outcome)
    size = joined(", ", [counted(len(ruleset.rules), "rule"), counted(content.outcome.hedges, "exception")])
    return element(
        "section",
        element("h2", element("code", ruleset.source.path), id=name),
        element("p", size, kind="limit"),
        element("blockquote", element("p", headline(content)), kind=f"verdict {standing(content)}"),
        _examined(content, found, name),
        _validity(content),
        *_about_no_rule(content, found, name, language),
        *_rules(content, found, name, language),
        *_limits_and_aims(content.ruleset),
        *_together(content),
        *_readings(content),
        *_changes(content),
        *_certificate(content),
        *_graph(content, name, language),
        _names(content),
        aria_labelledby=name,
    )


def _examined(content: Content, found: list[NumberedFinding], name: str) -> Element:
    rows = []
    for one, result in zip(verdicts(content), content.outcome.results):
        links = element("span")
        for finding in found:
            if stands_for(finding.finding, one.check, result.findings):
                link = element("a", f"{finding.number}", href=f"#{anchor(name, finding.number)}")
                links.append(link)
        rows.append((one.statement, _standing(one), links if len(links) else one.reason or ""))
    heads = (sentence("What was examined"), sentence("Verdict"), sentence("Findings"))
    return element("div", element("h3", sentence("The verdicts")), table(None, heads, rows, "verdicts"))


def _standing(one: Verdict) -> Element:
    return element("span", STANDING_WORDS[one.standing], kind=f"standing {one.standing}")


def _validity(content: Content) -> Element:
    return element(
        "div",
        element("h3", sentence("What the verdicts cover")),
        element("ul", *(element("li", words) for words in conditions_of_validity(content))),
        element(
            "p", sentence("The text has this SHA-256:"), element("br"), element("code", fingerprint(content.ruleset))
        ),
        element("p", sentence("To repeat the checks:"), element("br"), element("code", repetition(content))),
    )


def _about_no_rule(content: Content, found: list[NumberedFinding], name: str, language: Language) -> Iterator[Element]:
    """The findings that concern no clause."""
    beside = {one.number for notes in by_clause(found, content.ruleset).values() for one in notes}
    others = [one for one in found if one.number not in beside]
    if others:
        notes = (finding_note(one, name, language) for one in others)
        yield element("div", element("h3", sentence("Findings about other parts of the text")), *notes)


def _rules(content: Content, found: list[NumberedFinding], name: str, language: Language) -> Iterator[Element]:
    places = by_clause(found, content.ruleset)
    shown: set[int] = set()

    def notes(label: str, clause: int) -> list[Element]:
        these = []
        for one in places.get(ClauseRef(label, clause), ()):
            these.append(finding_link(one, name) if one.number in shown else finding_note(one, name, language))
            shown.add(one.number)
        return these

    cards = [
        card(rule, f"{name}-rule-{number}", content, notes) for number, rule in enumerate(content.ruleset.rules, 1)
    ]
    if cards:
        yield element("div", element("h3", sentence("The rules")), *cards)


def _limits_and_aims(ruleset: Ruleset) -> Iterator[Element]:
    """The text of the constraints, concerns and purposes, which the findings and verdicts name."""
    rows = []
    for one in ruleset.statements:
        if isinstance(one, (Exclusive, Never)):
            kind = sentence("constraint")
            if one.domains:
                kind = sentence("constraint in {domains}", domains=listed(one.domains))
        elif isinstance(one, Claim):
            kind = sentence("concern") if one.kind == "concern" else sentence("purpose")
        else:
            continue
        text = element("code", ruleset.source.in_one_line(one.span))
        rows.append((f"{ruleset.source.place(one.span).line}", kind, text))
    if rows:
        heads = (sentence("Line"), sentence("Kind"), sentence("Text"))
        title = sentence("Constraints, concerns and purposes")
        yield element("div", element("h3", title), table(None, heads, rows))


def _together(content: Content) -> Iterator[Element]:
    if not content.trigger_tables:
        return
    parts = []
    for domains, shown in content.trigger_tables:
        if domains:
            parts.append(element("p", sentence("In {domains}:", domains=listed(domains)), kind="limit"))
        parts += trigger_table(shown, content.ruleset)
    yield element("div", element("h3", sentence("Rules with the same trigger, together")), *parts)


def _readings(content: Content) -> Iterator[Element]:
    if not content.reading_tables:
        return
    about = sentence(
        "In these situations, a rule requires something else if its exceptions are read in the other way. The verdicts "
        "hold for the reading {reading}.",
        reading=content.ruleset.reading,
    )
    parts = [part for shown in content.reading_tables.values() for part in reading_table(shown, content.ruleset)]
    yield element("div", element("h3", sentence("Where the readings differ")), element("p", about), *parts)


def _changes(content: Content) -> Iterator[Element]:
    if content.base is not None:
        yield element(
            "div",
            element("h3", sentence("What changed since {version}", version=content.base.name)),
            element("p", summary(content.base.compared)),
            element("ul", *(element("li", words) for words in changes(content.base.compared))),
        )


def _certificate(content: Content) -> Iterator[Element]:
    if content.certificate:
        lines = element("pre", "\n".join(content.certificate), tabindex="0")
        yield element("div", element("h3", sentence("The certificate")), lines)


def _graph(content: Content, name: str, language: Language) -> Iterator[Element]:
    """The graph of the rules, if it is small enough to read."""
    if 1 < len(content.ruleset.rules) <= MOST_DRAWN:
        shown = picture(rule_graph(content.ruleset, language, f"{name}-graph"))
        yield element("div", element("h3", sentence("How the rules are connected")), shown)


def _names(content: Content) -> Element:
    rows = [
        (element("code", one.name), one.words, one.kind, listed(one.rules) if one.rules else sentence("no rule"))
        for one in names(content.ruleset)
    ]
    heads = (sentence("Name"), sentence("In words"), sentence("Kind"), sentence("Rules"))
    return element("div", element("h3", sentence("The names")), table(None, heads, rows, "names"))
