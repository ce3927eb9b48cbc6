"""SVG documents, also for use within an HTML page."""

from __future__ import annotations

from collections.abc import Callable
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from sleec_runtime.support.messages import escaped
from sleec_verify.report.pictures.drawing import STYLE, Drawing, patterns

_NAMESPACE = "http://www.w3.org/2000/svg"


def document(title: str, description: str, width: float, draw: Callable[[Drawing], float], name: str) -> str:
    """An SVG document. `draw` adds the shapes and returns the height. `name` begins all its ids, so that one HTML page
    can contain several documents. The styles apply only within pictures."""
    root = Element("svg", {"xmlns": _NAMESPACE, "class": "picture", "role": "img"})
    root.set("aria-labelledby", f"{name}-title {name}-desc")
    SubElement(root, "title", id=f"{name}-title").text = escaped(title)
    SubElement(root, "desc", id=f"{name}-desc").text = escaped(description)
    SubElement(root, "style").text = "".join(f"\n.picture {rule}" for rule in STYLE.strip().splitlines()) + "\n"
    patterns(root)
    page = SubElement(root, "rect", {"class": "page", "width": f"{width:.0f}"})
    height = draw(Drawing(root))
    page.set("height", f"{height:.0f}")
    root.set("viewBox", f"0 0 {width:.0f} {height:.0f}")
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, "unicode")}\n'
