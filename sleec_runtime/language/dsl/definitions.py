"""Definitions: ``event E``, ``measure m: boolean``, ``constant K = 5``."""

from __future__ import annotations

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.dsl.formulas import DslConditionParser
from sleec_runtime.language.dsl.hints import TYPE_SYNONYMS
from sleec_runtime.model import Agent, Constant, Declaration, Measure, Span
from sleec_runtime.support.suggestions import did_you_mean, nearest

_TYPES = ("boolean", "numeric", "scale")
_SCALE_EXAMPLE = "for example: scale(low, medium, high)"


class DslDefinitionParser(DslConditionParser):
    """Reads definitions. Constants get their values once all of them are read."""

    constants: dict[str, tuple[Side, Constant]]

    def definition(self) -> Declaration | Measure | Constant:
        """The definition at hand."""
        first = self.at
        kind = self.kinds[first]
        self.at += 1
        if kind == "event":
            return self._event(first)
        return self._measure(first) if kind == "measure" else self._constant(first)

    def _event(self, first: int) -> Declaration:
        name = self.name("the name of an event", "for example: event SmokeDetected")
        span = self.token_span(self.at - 1)
        agent: Agent | None = None
        if self.kinds[self.at] == "word" and self.token_text(self.at) == "as":
            self.at += 1
            written = self.token_text(self.at)
            if written not in ("system", "environment"):
                near = nearest(written, ("system", "environment"))
                self.expected("system or environment", did_you_mean(near) or "for example: event E as system")
            agent = "system" if written == "system" else "environment"
            self.at += 1
        event = Declaration("event", (name,), self.span(first), (span,), self.comments_of(first), agent)
        self.names.define("event", name, span, event)
        return event

    def _measure(self, first: int) -> Declaration | Measure:
        name = self.name("the name of a measure")
        name_span = self.token_span(self.at - 1)
        self.require(":", "a colon after the name of the measure", "for example: measure userAtHome: boolean")
        at_type = self.at
        written = self.token_text(at_type)
        if self.kinds[at_type] != "word" or written not in _TYPES:
            near = TYPE_SYNONYMS.get(written.lower()) or nearest(written, _TYPES)
            self.expected(
                "boolean, numeric or scale(...)",
                did_you_mean(near) or f"for example: measure {name}: scale(low, medium, high)",
            )
        self.at += 1
        comments = self.comments_of(first)
        if written == "boolean":
            boolean = Declaration("condition", (name,), self.span(first), (name_span,), comments)
            self.names.define("boolean", name, name_span, boolean)
            return boolean
        values, spans = self._scale() if written == "scale" else ([], [])
        measure = Measure(
            name, "scale" if written == "scale" else "integer", tuple(values), True, self.span(first), comments
        )
        self.names.define_measure(measure, name_span, spans)
        return measure

    def _scale(self) -> tuple[list[str], list[Span]]:
        opened = self.at
        self.require("(", "the values of the scale in parentheses", _SCALE_EXAMPLE)
        values: list[str] = []
        spans: list[Span] = []
        while True:
            values.append(self.name("a value of the scale", _SCALE_EXAMPLE))
            spans.append(self.token_span(self.at - 1))
            if not self.accept(","):
                break
        if self.kinds[self.at] in ("word", "operator") or self.token_text(self.at) == ";":
            self.fail(
                f"expected a comma between the values of the scale, but found {quoted(self.token_text(self.at))}",
                self.token_span(self.at),
                _SCALE_EXAMPLE,
            )
        self.close(")", opened)
        if len(values) < 2:
            self.fail(
                f"the scale has only one value, {quoted(values[0])}",
                spans[0],
                "a scale has two or more values, lowest first",
            )
        return values, spans

    def _constant(self, first: int) -> Constant:
        name = self.name("the name of a constant", "for example: constant LIMIT = 18")
        name_span = self.token_span(self.at - 1)
        if self.kinds[self.at] != "operator" or self.token_text(self.at) != "=":
            self.expected("= after the name of the constant", f"for example: constant {name} = 18")
        self.at += 1
        what = "a whole number or the name of another constant"
        if self.kinds[self.at] in ("true", "false"):
            self.expected(what, f"for true or false, write measure {name}: boolean")
        side = self.side(what)
        self._refuse_more_than_number(name)
        alias = side.written if isinstance(side.written, str) else None
        value = 0 if isinstance(side.written, str) else side.written
        constant = Constant(name, value, alias, self.span(first), self.comments_of(first))
        if self.names.define("constant", name, name_span, constant):
            self.constants[name] = (side, constant)
        return constant

    def _refuse_more_than_number(self, name: str) -> None:
        """Gives up at a unit or a calculation after the number."""
        written = self.token_text(self.at)
        if written in UNITS:
            self.fail(
                f"a constant has no unit, but found {quoted(written)}",
                self.token_span(self.at),
                f"write the unit where you use the constant: within {name} {written}",
            )
        if self.kinds[self.at] in ("+", "-", "*"):
            self.fail(
                "a constant cannot be calculated",
                self.token_span(self.at),
                f"write the number, for example: constant {name} = 18",
            )
