"""The graph of a ruleset: triggers, their rules, the conditions that rules share, and what the rules require.

Each rule is a row. Rules with the same trigger are together, so no line between triggers and rules crosses another. A
grid of dots shows the conditions that several rules mention. Curves lead to responses, which are as near to their rules
as their number allows (barycentre heuristic of Sugiyama, Tagawa and Toda, 1981). Many curves would hide each other, so
a large ruleset has a second grid instead.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from sleec_runtime.model import Rule, Ruleset, formulas_of, literals, names_of
from sleec_verify.report.pictures.document import document
from sleec_verify.report.pictures.drawing import Drawing, cut
from sleec_verify.wording.names import spoken
from sleec_verify.wording.phrases import counted
from sleec_verify.wording.sentence import joined, plural, sentence
from sleec_verify.wording.translation import Language, translated

_ROW, _GAP = 26, 12
"""The height of a rule, and the distance between rules of different triggers."""
_TRIGGER, _RULE, _RESPONSE = (16, 236), (276, 516), 240
"""The left and right side of triggers and of rules; the width of responses."""
_STEP = 17
"""The distance of two conditions."""
_CURVES = 170
"""The distance between rules and responses."""
_MOST_CURVES = 60
"""With more curves, the responses are a grid."""
_LETTERS = 32
"""The most characters in a box."""
_MOST_COLUMNS = 80
"""The most columns of a grid, those of most rules first."""


class _Response(NamedTuple):
    """A response, with the positions of the rules that require and that forbid it."""

    name: str
    required_by: list[int]
    forbidden_by: list[int]

    @property
    def users(self) -> set[int]:
        """The positions of the rules that require or forbid it."""
        return {*self.required_by, *self.forbidden_by}


def rule_graph(ruleset: Ruleset, language: Language = "en", name: str = "graph") -> str:
    """The graph as an SVG document. `name` begins the ids in it."""
    picture = _Graph(ruleset, language)
    return document(
        translated(sentence("Graph of the rules in {path}", path=ruleset.source.path), language),
        translated(picture.description(), language),
        picture.width,
        picture.draw,
        name,
    )


class _Graph:
    """The places of everything."""

    def __init__(self, ruleset: Ruleset, language: Language) -> None:
        self._language = language
        triggers = dict.fromkeys(rule.trigger for rule in ruleset.rules)
        order = {trigger: number for number, trigger in enumerate(triggers)}
        self._rules = sorted(ruleset.rules, key=lambda rule: order[rule.trigger])
        self._conditions = _shared_conditions(self._rules)
        self._triggers = triggers
        self._responses = _responses(self._rules)
        self._chains = [one for one in self._responses if one.required_by and one.name in triggers]
        self._is_grid = sum(len(one.users) for one in self._responses) > _MOST_CURVES
        columns = [*self._conditions, *(one.name for one in self._responses if self._is_grid)]
        self._top = 92.0 + max((len(spoken(name)) for name in columns), default=0) * 4.6
        self._y: list[float] = []
        boxes = 0 if self._is_grid else len(self._responses)
        spare = (boxes - len(self._rules)) * _ROW / max(1, len(triggers) - 1)
        y = self._top
        for number, rule in enumerate(self._rules):
            y += max(_GAP, spare) if number and rule.trigger != self._rules[number - 1].trigger else 0
            self._y.append(y + _ROW / 2)
            y += _ROW
        self._bottom = y
        self._right = _RULE[1] + (12 + _STEP * len(self._conditions) if self._conditions else 0)
        self._response_left = self._right + (_STEP if self._is_grid else _CURVES)
        if self._is_grid:
            self._responses = sorted(self._responses, key=lambda one: -len(one.users))[:_MOST_COLUMNS]
            self.width = self._response_left + _STEP * len(self._responses) + 120
        else:
            self.width = self._response_left + _RESPONSE + 24

    def description(self) -> str:
        """What the picture shows, in words."""
        parts = [
            counted(len(self._rules), "rule"),
            counted(len(self._triggers), "trigger"),
            counted(len(self._conditions), "shared condition"),
            counted(len(self._responses), "response"),
            plural(len(self._chains), "{number} response triggers rules", "{number} responses trigger rules")
            if self._chains
            else "",
        ]
        return joined(", ", [part for part in parts if part])

    def draw(self, drawing: Drawing) -> float:
        """Draws the graph, and returns its height."""
        self._heads(drawing)
        below, above = drawing.group(), drawing.group()
        self._draw_triggers(below, above)
        self._draw_rules(above)
        for number, (name, users) in enumerate(self._conditions.items()):
            self._draw_column(above, _RULE[1] + 20 + _STEP * number, _Response(name, [*users], []))
        if self._is_grid:
            for number, one in enumerate(self._responses):
                self._draw_column(above, self._response_left + 8 + _STEP * number, one)
            bottom = self._bottom
        else:
            bottom = self._draw_responses(below, above)
        return self._legend(drawing, max(self._bottom, bottom) + 28)

    def _heads(self, drawing: Drawing) -> None:
        drawing.text(16, 28, self._words(sentence("Rules and what they share")), "title")
        drawing.text(16, 47, self._words(self.description()), "small")
        y = self._top - 12
        drawing.text(_TRIGGER[0], y, self._words(sentence("Triggers")), "head")
        drawing.text(_RULE[0], y, self._words(sentence("Rules")), "head")
        if self._conditions:
            drawing.text(_RULE[1] + 16, 76, self._words(sentence("Shared conditions")), "head")
        drawing.text(self._response_left, 76 if self._is_grid else y, self._words(sentence("Responses")), "head")

    def _draw_triggers(self, below: Drawing, above: Drawing) -> None:
        for trigger in self._triggers:
            rows = [y for y, rule in zip(self._y, self._rules) if rule.trigger == trigger]
            y = (rows[0] + rows[-1]) / 2
            for row in rows:
                below.curve(_TRIGGER[1], y, _RULE[0], row, "edge")
            is_response = any(one.name == trigger for one in self._chains)
            self._box(above, *_TRIGGER, y, trigger, "chain-node" if is_response else "event-node")

    def _draw_rules(self, above: Drawing) -> None:
        for y, rule in zip(self._y, self._rules):
            above.line(_RULE[1], y, self._right if not self._is_grid else self.width - 100, y, "grid")
            self._box(above, *_RULE, y, rule.label, "rule-node", rule.label)

    def _draw_column(self, above: Drawing, x: float, one: _Response) -> None:
        """A column of a grid: a dot where a rule mentions the condition or requires the response, a cross where it
        forbids it."""
        group = above.group(one.name)
        group.line(x, self._top, x, self._bottom, "grid")
        group.slanted(x, self._top - 8, spoken(one.name), "small head" if one in self._chains else "small")
        for position in one.required_by:
            group.dot(x, self._y[position], "dot")
        for position in one.forbidden_by:
            group.cross(x, self._y[position], 4)

    def _draw_responses(self, below: Drawing, above: Drawing) -> float:
        y = self._top - _ROW / 2
        placed = sorted(self._responses, key=self._barycentre)
        spare = max(0.0, self._bottom - self._top - len(placed) * _ROW)
        for number, one in enumerate(placed):
            latest = self._top + spare + number * _ROW + _ROW / 2
            y = max(y + _ROW, min(self._barycentre(one), latest))
            for position in one.required_by:
                below.curve(self._right, self._y[position], self._response_left, y, "edge")
            for position in one.forbidden_by:
                aside = 6 if position in one.required_by else 0  # beside the line of the requirement
                below.curve(self._right, self._y[position] + aside, self._response_left, y + aside, "forbids")
                above.cross((self._right + self._response_left) / 2, (self._y[position] + y) / 2 + aside)
            kind = "chain-node" if one in self._chains else "node"
            self._box(above, self._response_left, self._response_left + _RESPONSE, y, one.name, kind)
            above.arrowhead(self._response_left, y)
        return y + _ROW / 2

    def _barycentre(self, one: _Response) -> float:
        rows = [self._y[position] for position in one.users]
        return sum(rows) / len(rows)

    def _legend(self, drawing: Drawing, y: float) -> float:
        if self._is_grid:
            drawing.dot(32, y - 4, "dot")
        else:
            drawing.line(16, y - 4, 46, y - 4, "edge")
            drawing.line(156, y - 4, 196, y - 4, "forbids")
        drawing.text(54, y, self._words(sentence("required")), "small")
        drawing.cross(176, y - 4, 4)
        drawing.text(206, y, self._words(sentence("forbidden")), "small")
        drawing.box(296, y - 12, 326, y + 2, "chain-node")
        drawing.text(334, y, self._words(sentence("a response that triggers rules")), "small")
        drawing.dot(572, y - 4, "dot")
        drawing.text(584, y, self._words(sentence("the rule mentions the condition")), "small")
        return y + 16

    def _box(
        self, drawing: Drawing, left: float, right: float, y: float, name: str, kind: str, words: str | None = None
    ) -> None:
        group = drawing.group(name)
        group.box(left, y - 10, right, y + 10, kind)
        group.text(left + 8, y + 4, cut(spoken(name) if words is None else words, _LETTERS))

    def _words(self, text: str) -> str:
        return translated(text, self._language)


def _shared_conditions(rules: Sequence[Rule]) -> Mapping[str, set[int]]:
    """The conditions that several rules mention, each with the positions of these rules."""
    users: dict[str, set[int]] = {}
    for position, rule in enumerate(rules):
        for formula in formulas_of(rule):
            for name in names_of(formula):
                users.setdefault(name, set()).add(position)
    shared = sorted((item for item in users.items() if len(item[1]) > 1), key=lambda item: -len(item[1]))
    return dict(shared[:_MOST_COLUMNS])


def _responses(rules: Sequence[Rule]) -> list[_Response]:
    found: dict[str, _Response] = {}
    for position, rule in enumerate(rules):
        for name, negated in dict.fromkeys(_literals(rule)):
            one = found.setdefault(name, _Response(name, [], []))
            (one.forbidden_by if negated else one.required_by).append(position)
    return list(found.values())


def _literals(rule: Rule) -> Iterator[tuple[str, bool]]:
    for clause in rule.clauses():
        yield from ((one.name, one.negated) for one in literals(clause))
