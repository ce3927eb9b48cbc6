"""SVG documents within the page. Their styles and patterns are on the page once."""

from __future__ import annotations

import re
from xml.etree.ElementTree import Element, fromstring

from sleec_verify.report.html.elements import element
from sleec_verify.report.pictures.drawing import STYLE, patterns

WIDEST = 1_200
"""The width of the widest picture that is made smaller to fit on the page; others scroll, because of their text."""

STYLES = "".join(f".picture {rule}\n" for rule in STYLE.strip().splitlines())


def picture(document: str) -> Element:
    """An SVG document as a part of the page."""
    svg = fromstring(re.sub(r' xmlns="[^"]*"', "", document, count=1).encode())
    for shared in ("style", "defs"):
        for found in svg.findall(shared):
            svg.remove(found)
    width = svg.get("viewBox", "0 0 0 0").split()[2]
    svg.set("width", width)
    if int(width) <= WIDEST:
        svg.set("class", "picture fitting")
    return element("div", svg, kind="scroll", tabindex="0", role="group", aria_label=svg.findtext("title"))


def definitions() -> Element:
    """The patterns of all pictures."""
    svg = element("svg", width="0", height="0", aria_hidden="true", kind="definitions")
    patterns(svg)
    return svg
