"""Rules as cards: the flow with the findings, the text, and the decision table."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

from sleec_verify.report.html.elements import element
from sleec_verify.report.html.flow import flow
from sleec_verify.report.html.tables import decision_table
from sleec_verify.wording.names import spoken
from sleec_verify.wording.phrases import listed
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Rule
    from sleec_verify.report.document.content import Content

_RULE_OF_DASHES = re.compile(r"[-=*_/#]{4,}")
LONGEST_TEXT = 4_000
"""The most characters of the text of a rule that a card shows."""


def card(rule: Rule, heading: str, content: Content, notes: Callable[[str, int], Sequence[Element]]) -> Element:
    """The card of a rule. `heading` is the id of its heading, and `notes` gives the findings beside a clause."""
    domains = sentence("Applies in {domains}.", domains=listed(rule.domains)) if rule.domains else None
    comment = _RULE_OF_DASHES.sub("", " ".join((*rule.comments.above, rule.comments.behind or ""))).strip()
    found = element(
        "article",
        element("h4", spoken(rule.label), element("code", rule.label), id=heading),
        element("p", comment, kind="comment") if comment else None,
        element("p", domains, kind="limit") if domains else None,
        kind="card",
        aria_labelledby=heading,
    )
    found.append(flow(rule, content.ruleset.reading, lambda clause: notes(rule.label, clause)))
    found.append(_text(rule, content))
    shown = content.rule_tables[rule.label]
    if shown.total > 1 or shown.why:
        summary = element("summary", sentence("What the rule requires in each situation"))
        found.append(element("details", summary, *decision_table(shown, content.ruleset), open="open"))
    return found


def _text(rule: Rule, content: Content) -> Element:
    source = content.ruleset.source
    text = source.text[rule.span.start : rule.span.end]
    if len(text) > LONGEST_TEXT:
        text = f"{text[:LONGEST_TEXT]} …"
    line = source.place(rule.span).line
    return element(
        "figure",
        element("figcaption", sentence("The text, from line {line}", line=line)),
        element("pre", element("code", text), tabindex="0"),
        kind="text",
    )
