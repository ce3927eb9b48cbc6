"""The whole page. The browser loads nothing for it, and runs nothing in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.resources import files
from typing import TYPE_CHECKING, Union
from xml.etree.ElementTree import Element

from sleec_verify import __version__
from sleec_verify.report.document.names import names
from sleec_verify.report.document.verdict import headline, standing
from sleec_verify.report.html.elements import element, finished
from sleec_verify.report.html.pictures import STYLES, definitions
from sleec_verify.report.html.section import section
from sleec_verify.report.outcome import UnusableInput
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.report.document.content import Content
    from sleec_verify.wording.translation import Language

POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"


def render(contents: Sequence[Union[Content, UnusableInput]], language: Language) -> Iterator[str]:
    """The page as text."""
    title = sentence("Report on rules")
    body = element(
        "body",
        definitions(),
        element("header", element("h1", title), *_overview(contents)),
        element("main", *(_part(one, f"ruleset-{number}", language) for number, one in enumerate(contents, 1))),
        element("footer", element("p", sentence("Made by sleec-verify {version}.", version=__version__))),
    )
    rulesets = (one.ruleset for one in contents if not isinstance(one, UnusableInput))
    known = {name for ruleset in rulesets for name in _names(ruleset)}
    yield finished(element("html", _head(title), body, lang=language), language, known)


def _names(ruleset: Ruleset) -> Iterator[str]:
    """The labels, triggers, conditions, measures and obligations."""
    yield from (one.name for one in names(ruleset))
    yield from ruleset.by_label


def _head(title: str) -> Element:
    return element(
        "head",
        element("meta", charset="utf-8"),
        element("meta", http_equiv="Content-Security-Policy", content=POLICY),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("meta", name="referrer", content="no-referrer"),
        element("title", title),
        element("style", (files(__package__) / "page.css").read_text("utf-8") + STYLES),
    )


def _overview(contents: Sequence[Union[Content, UnusableInput]]) -> Iterator[Element]:
    """Links to the rulesets, if there are several."""
    if len(contents) <= 1:
        return
    found = element("ol")
    for number, one in enumerate(contents, 1):
        words, kind = (
            (sentence("It cannot be read."), "unknown")
            if isinstance(one, UnusableInput)
            else (headline(one), standing(one))
        )
        path = one.path if isinstance(one, UnusableInput) else one.ruleset.source.path
        link = element("a", element("code", path), href=f"#ruleset-{number}")
        found.append(element("li", link, element("br"), words, kind=kind))
    yield element("nav", found, aria_label=sentence("Rulesets"))


def _part(one: Content | UnusableInput, name: str, language: Language) -> Element:
    if not isinstance(one, UnusableInput):
        return section(one, name, language)
    from sleec_verify.report.full import error_lines
    from sleec_verify.report.palette import PLAIN

    lines = "\n".join(error_lines(one.error, PLAIN))
    return element(
        "section",
        element("h2", element("code", one.path), id=name),
        element(
            "blockquote",
            element("p", sentence("Nothing was checked, because these rules cannot be read.")),
            kind="verdict unknown",
        ),
        element("pre", lines, tabindex="0"),
        aria_labelledby=name,
    )
