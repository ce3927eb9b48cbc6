"""The statements that declare names: MEASURE, CONSTANT, TRIGGER, CONDITION, OBLIGATION, EVENT."""

from __future__ import annotations

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.english.formulas import EnglishConditionParser
from sleec_runtime.language.english.keywords import PHRASE
from sleec_runtime.model import Agent, Constant, Declaration, Kind, Measure, MeasureKind, Span
from sleec_runtime.support.suggestions import did_you_mean, nearest

_KIND: dict[str, Kind] = {"TRIGGER": "trigger", "CONDITION": "condition", "OBLIGATION": "obligation"}
_BY = "BY"
_NUMERIC: dict[str, MeasureKind] = {"number": "number", "integer": "integer"}
_TYPE_SYNONYMS = {
    "numeric": "number",
    "numbers": "number",
    "float": "number",
    "real": "number",
    "decimal": "number",
    "int": "integer",
    "whole number": "integer",
    "bool": "boolean",
    "Boolean": "boolean",
}


class EnglishDeclarationParser(EnglishConditionParser):
    """Reads declarations. They apply to the whole text."""

    constants: dict[str, tuple[Side, Constant]]

    def declaration(self) -> Declaration | Measure | Constant | None:
        """The declaration at hand. Constants get their values once all of them are read."""
        keyword = self.kinds[self.at]
        if keyword == "MEASURE":
            return self._measure()
        if keyword == "CONSTANT":
            return self._constant()
        if keyword == "EVENT":
            return self._event()
        first = self.at
        self.at += 1
        kind = _KIND[keyword]
        names, spans = self.names_in_list(f"the name of {'an' if kind == 'obligation' else 'a'} {kind}")
        if not self.has_failed:
            for name, span in zip(names, spans):
                self.names.declare(kind, name, span)
        return Declaration(kind, names, self.span(first), spans, self.comments_of(first))

    def _event(self) -> Declaration:
        first = self.at
        at_by = first + 1
        while self.kinds[at_by] in PHRASE or self.kinds[at_by] == ",":
            if self.token_text(at_by) == _BY:
                self.kinds[at_by] = _BY
            at_by += 1
        self.at += 1
        names, spans = self.names_in_list("the name of an event")
        agent = self._agent() if self.kinds[self.at] == _BY else None
        if not self.has_failed:
            for name, span in zip(names, spans):
                self.names.declare_event(name, span, agent)
        return Declaration("event", names, self.span(first), spans, self.comments_of(first), agent)

    def _agent(self) -> Agent:
        self.at += 1
        written = self.token_text(self.at)
        if written not in ("system", "environment"):
            near = nearest(written, ("system", "environment"))
            self.expected("system or environment", did_you_mean(near) or "for example: EVENT SoundAlarm BY system")
        self.at += 1
        return "system" if written == "system" else "environment"

    def names_in_list(self, what: str) -> tuple[tuple[str, ...], tuple[Span, ...]]:
        """One name or more, with commas between them."""
        names: list[str] = []
        spans: list[Span] = []
        while True:
            first = self.at
            names.append(self._listed_name(what))
            spans.append(self.span(first))
            if self.kinds[self.at] != ",":
                break
            self.at += 1
        if self.kinds[self.at] in ("AND", "OR"):
            self.expected("a comma between the names", "write a comma instead")
        return tuple(names), tuple(spans)

    def _listed_name(self, what: str) -> str:
        return self.name(what) or self.expected(what)

    def _measure(self) -> Declaration | Measure:
        first = self.at
        self.at += 1
        at_name = self.at
        name = self._listed_name("the name of a measure")
        name_span = self.span(at_name)
        if self.kinds[self.at] == ",":
            self.expected("a colon after the name of the measure", "declare each measure separately")
        if self.kinds[self.at] != ":":
            self.expected("a colon after the name of the measure", f"for example: MEASURE {name}: number")
        self.at += 1
        at_type = self.at
        if self.kinds[at_type] == "number":
            self.expected("number, integer, boolean or a scale", f"for numbers, write MEASURE {name}: number")
        values = [self._listed_name("number, integer, boolean or a scale such as low < high")]
        spans = [self.span(at_type)]
        while self.kinds[self.at] == "operator" and self.token_text(self.at) == "<":
            self.at += 1
            at_value = self.at
            values.append(self._listed_name("a value of the scale"))
            spans.append(self.span(at_value))
        if self.kinds[self.at] in (",", "operator", "("):
            self.expected(
                "< between the values of the scale", "write a scale from its lowest value: low < middle < high"
            )
        span = self.span(first)
        comments = self.comments_of(first)
        if len(values) == 1 and values[0] == "boolean":
            self.names.declare("condition", name, name_span)
            return Declaration("condition", (name,), span, (name_span,), comments)
        if len(values) == 1:
            kind = _NUMERIC.get(values[0]) or self._refuse_type(at_type, values[0], spans[0])
            measure = Measure(name, kind, (), True, span, comments)
        else:
            measure = Measure(name, "scale", tuple(values), True, span, comments)
        if not self.has_failed:
            self.names.declare_measure(measure, name_span, spans)
        return measure

    def _refuse_type(self, first: int, written: str, span: Span) -> MeasureKind:
        for token in range(first + 1, self.at):
            if self.starts_line(token) and self.text[span.start : self.ends[token - 1]] in (*_NUMERIC, "boolean"):
                self.at = token
                self.expected("the next statement", "a statement starts with a keyword, such as MEASURE, RULE or WHEN")
        near = _TYPE_SYNONYMS.get(written) or nearest(written, ("number", "integer", "boolean"))
        self.fail(
            f"{quoted(written)} is not a type of measure",
            span,
            did_you_mean(near) or "write number, integer, boolean or a scale with two or more values: low < high",
        )

    def _constant(self) -> Constant | None:
        first = self.at
        self.at += 1
        at_name = self.at
        name = self._listed_name("the name of a constant")
        name_span = self.span(at_name)
        if self.kinds[self.at] != "operator" or self.token_text(self.at) not in ("=", "=="):
            self.expected("= after the name of the constant", f"for example: CONSTANT {name} = 18")
        self.at += 1
        side = self.side("a number or the name of another constant", "for example: CONSTANT LegalAge = 18")
        alias = side.written if isinstance(side.written, str) else None
        value = 0 if isinstance(side.written, str) else side.written
        constant = Constant(name, value, alias, self.span(first), self.comments_of(first))
        if not self.has_failed and self.names.is_new(name, name_span):
            self.constants[name] = (side, constant)
        return constant
