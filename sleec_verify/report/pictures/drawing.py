"""Elements of an SVG picture. Shapes and patterns carry the meaning; colours only repeat it.

The colours are those of Okabe and Ito (https://jfly.uni-koeln.de/color/), which colour-blind people can distinguish.
"""

from __future__ import annotations

from xml.etree.ElementTree import Element, SubElement

from sleec_runtime.support.messages import escaped

STYLE = """
text { font: 12px sans-serif; fill: #1b1b1b; }
.page { fill: #ffffff; }
.title { font-size: 17px; font-weight: bold; }
.head { font-weight: bold; }
.small { font-size: 10.5px; fill: #444444; }
.middle { text-anchor: middle; }
.end { text-anchor: end; }
.grid { stroke: #d9d9d9; stroke-width: 1; }
.stripe { fill: #f5f6f8; }
.trigger { fill: #0072b2; }
.execution { fill: #1b1b1b; stroke: #ffffff; stroke-width: 1; }
.true { fill: #8ecbea; stroke: #0072b2; }
.false { stroke: #7a7a7a; stroke-width: 1.5; }
.unknown { stroke: #7a7a7a; stroke-width: 1.5; stroke-dasharray: 2 4; }
.value { fill: #eaf4fa; stroke: #56a3cc; }
.curve { fill: none; stroke: #0072b2; stroke-width: 1.5; }
.met { fill: #c5e8dc; stroke: #00795a; stroke-width: 1.2; }
.missed { fill: url(#missed); stroke: #b34700; stroke-width: 2; }
.open { fill: #ffffff; stroke: #555555; stroke-width: 1.2; stroke-dasharray: 4 3; }
.prohibited { fill: url(#prohibited); stroke: #8a4a74; stroke-width: 1.2; }
.breach { fill: #b34700; stroke: #b34700; stroke-width: 1.5; }
.doubt { fill: #ffffff; stroke: #555555; stroke-width: 1.5; }
.number { font-size: 10.5px; font-weight: bold; text-anchor: middle; }
.breach-number { fill: #ffffff; }
.node { fill: #ffffff; stroke: #1b1b1b; stroke-width: 1.2; }
.event-node { fill: #e3f0f8; stroke: #0072b2; stroke-width: 1.2; }
.rule-node { fill: #f5f6f8; stroke: #1b1b1b; stroke-width: 1.2; }
.chain-node { fill: #ffffff; stroke: #0072b2; stroke-width: 3; }
.question { fill: #fff7e0; stroke: #8a6d00; stroke-width: 1.2; stroke-dasharray: 5 3; }
.edge { fill: none; stroke: #4d4d4d; stroke-width: 1.2; }
.forbids { fill: none; stroke: #b34700; stroke-width: 1.4; stroke-dasharray: 5 4; }
.cross { stroke: #b34700; stroke-width: 2.2; }
.arrowhead { fill: #4d4d4d; }
.dot { fill: #1b1b1b; }
.breach-line { stroke: #b34700; stroke-width: 1; stroke-dasharray: 3 3; opacity: 0.55; }
"""


class Drawing:
    """An SVG element that shapes are added to."""

    def __init__(self, parent: Element) -> None:
        self.element = parent

    def group(self, title: str | None = None) -> Drawing:
        """A group of shapes. Its title is shown when the pointer is on it, and read by screen readers."""
        found = Drawing(SubElement(self.element, "g"))
        if title is not None:
            SubElement(found.element, "title").text = escaped(title)
        return found

    def text(self, x: float, y: float, words: str, kind: str = "") -> None:
        """Text whose baseline begins at a place."""
        self._shape("text", kind, x=x, y=y).text = escaped(words)

    def rectangle(self, left: float, top: float, right: float, bottom: float, kind: str) -> None:
        """A rectangle."""
        self._shape("rect", kind, x=left, y=top, width=right - left, height=bottom - top)

    def line(self, x1: float, y1: float, x2: float, y2: float, kind: str) -> None:
        """A straight line."""
        self._shape("line", kind, x1=x1, y1=y1, x2=x2, y2=y2)

    def path(self, points: list[tuple[float, float]], kind: str, closed: bool = False) -> None:
        """Straight lines through points."""
        steps = " L".join(f"{_short(x)} {_short(y)}" for x, y in points)
        self._shape("path", kind).set("d", f"M{steps}{' Z' if closed else ''}")

    def curve(self, x1: float, y1: float, x2: float, y2: float, kind: str) -> None:
        """A curve that leaves and arrives horizontally."""
        middle = (x1 + x2) / 2
        places = " ".join(map(_short, (middle, y1, middle, y2, x2, y2)))
        self._shape("path", kind).set("d", f"M{_short(x1)} {_short(y1)} C{places}")

    def box(self, left: float, top: float, right: float, bottom: float, kind: str) -> None:
        """A rectangle with round corners."""
        self._shape("rect", kind, x=left, y=top, width=right - left, height=bottom - top).set("rx", "5")

    def slanted(self, x: float, y: float, words: str, kind: str = "") -> None:
        """Text that rises from a place."""
        shape = self._shape("text", kind, x=x, y=y)
        shape.set("transform", f"rotate(-45 {_short(x)} {_short(y)})")
        shape.text = escaped(words)

    def cross(self, x: float, y: float, size: float = 5) -> None:
        """The mark of a prohibition: two crossed lines."""
        self.line(x - size, y - size, x + size, y + size, "cross")
        self.line(x - size, y + size, x + size, y - size, "cross")

    def arrowhead(self, x: float, y: float, kind: str = "head-right") -> None:
        """The end of an arrow to the right, or with the kind ``head-down`` to below."""
        points = [(x - 7, y - 4), (x, y), (x - 7, y + 4)]
        if kind == "head-down":
            points = [(x - 4, y - 7), (x, y), (x + 4, y - 7)]
        self.path(points, "arrowhead", closed=True)

    def dot(self, x: float, y: float, kind: str) -> None:
        """A filled circle."""
        self._shape("circle", kind, cx=x, cy=y, r=4)

    def trigger(self, x: float, y: float) -> None:
        """The mark of an event: a triangle that points down to its time."""
        self.path([(x - 5, y - 5), (x + 5, y - 5), (x, y + 5)], "trigger", closed=True)

    def execution(self, x: float, y: float) -> None:
        """The mark of an execution: a diamond."""
        self.path([(x, y - 5.5), (x + 5.5, y), (x, y + 5.5), (x - 5.5, y)], "execution", closed=True)

    def deviation(self, x: float, y: float, number: str, is_breach: bool) -> None:
        """The mark of a deviation: a filled round shape with a number for a breach, and an empty box otherwise."""
        half = max(8.0, 3.4 * len(number) + 4)
        if is_breach:
            shape = self._shape("rect", "breach", x=x - half, y=y - 8, width=2 * half, height=16)
            shape.set("rx", "8")
        else:
            self.rectangle(x - half, y - 7, x + half, y + 7, "doubt")
        self.text(x, y + 4, number, "number breach-number" if is_breach else "number")

    def _shape(self, tag: str, kind: str, **places: float) -> Element:
        attributes = {name: _short(value) for name, value in places.items()}
        return SubElement(self.element, tag, {"class": kind} if kind else {}, **attributes)


def patterns(parent: Element) -> None:
    """The patterns of windows: stripes for missed ones, and crossed lines for prohibitions."""
    definitions = SubElement(parent, "defs")
    for name, lines, ground, colour in (
        ("missed", "M-1 1 L1 -1 M0 6 L6 0 M5 7 L7 5", "#fbe3d3", "#d55e00"),
        ("prohibited", "M0 0 L6 6 M6 0 L0 6", "#f6e8f0", "#cc79a7"),
    ):
        pattern = SubElement(
            definitions, "pattern", {"id": name, "width": "6", "height": "6", "patternUnits": "userSpaceOnUse"}
        )
        SubElement(pattern, "rect", {"width": "6", "height": "6", "fill": ground})
        SubElement(pattern, "path", {"d": lines, "stroke": colour, "stroke-width": "1.2"})


def _short(value: float) -> str:
    """A number with at most one decimal."""
    return f"{value:.1f}".removesuffix(".0")


def cut(words: str, most: int) -> str:
    """At most `most` characters of a text, as it is shown: with escapes."""
    shown = escaped(words)
    return shown if len(shown) <= most else f"{shown[: most - 1]}…"
