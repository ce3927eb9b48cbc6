"""Definitions: ``event E``, ``measure m: boolean``, ``constant K = 5``."""

from __future__ import annotations

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.dsl.formulas import FormulaParser
from sleec_runtime.language.dsl.slips import type_meant
from sleec_runtime.model import Agent, Constant, Declaration, Measure, Span
from sleec_runtime.support.suggestions import nearest

_TYPES = ("boolean", "numeric", "scale")


class DefinitionParser(FormulaParser):
    """Reads definitions; of a constant the value is not settled before all of them are read."""

    constants: dict[str, tuple[Side, Constant]]

    def definition(self, has_keyword: bool = True) -> Declaration | Measure | Constant:
        """The definition at hand, which may lack its keyword."""
        first = self.at
        kind = self.kinds[first]
        if has_keyword:
            self.at += 1
        else:
            self.kinds[first] = "word"
        if kind == "event":
            return self._event(first)
        return self._measure(first) if kind == "measure" else self._constant(first)

    def _event(self, first: int) -> Declaration:
        name = self.name("the name of an event", "as in: event SmokeDetected")
        span = self.token_span(self.at - 1)
        agent: Agent | None = None
        if self.kinds[self.at] == "word" and self.token_text(self.at) == "as":
            self.at += 1
            written = self.token_text(self.at)
            if written not in ("system", "environment"):
                near = nearest(written, ("system", "environment"))
                self.expected("system or environment", f"did you mean {near}?" if near else "as in: event E as system")
            agent = "system" if written == "system" else "environment"
            self.at += 1
        event = Declaration("event", (name,), self.span(first), (span,), self.comments_of(first), agent)
        self.names.define("event", name, span, event)
        return event

    def _measure(self, first: int) -> Declaration | Measure:
        name = self.name("the name of a measure")
        name_span = self.token_span(self.at - 1)
        self.require(":", "a colon after the name of the measure", self._without_colon(name))
        at_type = self.at
        written = self.token_text(at_type)
        if self.kinds[at_type] != "word" or written not in _TYPES:
            near = type_meant(written) or nearest(written, _TYPES) if self.kinds[at_type] == "word" else None
            self.expected(
                "boolean, numeric or scale(...)",
                f"did you mean {near}?" if near else f"as in: measure {name}: scale(low, medium, high)",
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

    def _without_colon(self, name: str) -> str:
        """What to do where no colon stands behind the name of a measure."""
        if self.token_text(self.at) == ",":
            return f"define each by itself, as in: measure {name}: boolean"
        written = self.token_text(self.at + (self.kinds[self.at] != "word"))
        its = {"numeric": "numeric", "scale": "scale(low, medium, high)"}.get(type_meant(written) or written, "boolean")
        return (
            f"as in: measure {self.token_text(self.at) if name in _TYPES else name}: {name if name in _TYPES else its}"
        )

    def _scale(self) -> tuple[list[str], list[Span]]:
        opened = self.at
        self.require("(", "the values of the scale in parentheses", "as in: scale(low, medium, high)")
        values: list[str] = []
        spans: list[Span] = []
        while True:
            values.append(self.name("a value of the scale", "as in: scale(low, medium, high)"))
            spans.append(self.token_span(self.at - 1))
            if not self.accept(","):
                break
        if self.kinds[self.at] in ("word", "operator") or self.token_text(self.at) == ";":
            self.fail(
                f"expected a comma between the values of the scale, but found {quoted(self.token_text(self.at))}",
                self.token_span(self.at),
                "as in: scale(low, medium, high)",
            )
        self.close(")", opened)
        if len(values) < 2:
            self.fail(
                f"the scale has one value, {quoted(values[0])}, so it says nothing",
                spans[0],
                "a scale has two values or more, lowest first",
            )
        return values, spans

    def _constant(self, first: int) -> Constant:
        name = self.name("the name of a constant", "as in: constant LIMIT = 18")
        name_span = self.token_span(self.at - 1)
        if self.kinds[self.at] != "operator" or self.token_text(self.at) != "=":
            self.expected("= after the name of the constant", f"as in: constant {name} = 18")
        self.at += 1
        what = "a whole number or the name of another constant"
        if self.kinds[self.at] in ("true", "false"):
            self.expected(what, f"what is true or false is a measure: measure {name}: boolean")
        side = self._side(what)
        self._refuse_more_than_number(name)
        alias = side.written if isinstance(side.written, str) else None
        value = 0 if isinstance(side.written, str) else side.written
        constant = Constant(name, value, alias, self.span(first), self.comments_of(first))
        if self.names.define("constant", name, name_span, constant):
            self.constants[name] = (side, constant)
        return constant

    def _refuse_more_than_number(self, name: str) -> None:
        """A constant has neither a unit nor a calculation behind its number."""
        written = self.token_text(self.at)
        if written in UNITS:
            self.fail(
                f"a constant is a number, without {quoted(written)}",
                self.token_span(self.at),
                f"the unit stands where the constant is used, as in: within {name} {written}",
            )
        if self.kinds[self.at] in ("+", "-", "*"):
            self.fail(
                "a constant is a number, and not calculated",
                self.token_span(self.at),
                f"write what it comes to, as in: constant {name} = 18",
            )
