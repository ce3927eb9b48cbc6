"""The measures and constants of one text, and what both languages check of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.model import Constant, Measure, MeasureRef, Source, Span
from sleec_runtime.support.suggestions import Suggester

WrittenConstants = Mapping[str, tuple[Side, Constant]]
"""Constants by their names, as they are written: each with its right side, which may name another constant."""


class SymbolTable:
    """The names of one text and what they stand for."""

    constant_keyword: str

    def __init__(self, source: Source, problems: list[Problem]) -> None:
        self.measures: dict[str, Measure] = {}
        self.constants: dict[str, Constant] = {}
        self.complete = True
        """False once a declaration could not be read: then unknown names are not reported."""
        self.nearest = Suggester().nearest
        self._source = source
        self._problems = problems
        self._refs: dict[str, MeasureRef] = {}

    def problem(self, message: str, span: Span, hint: str | None) -> None:
        self._problems.append(Problem(message, span, hint))

    def line(self, span: Span) -> int:
        return self._source.place(span).line

    def measure_ref(self, name: str) -> MeasureRef:
        """The one reference to a measure that all its uses share."""
        ref = self._refs.get(name)
        if ref is None:
            ref = self._refs[name] = MeasureRef(name)
        return ref

    def check_scale(self, measure: Measure, spans: Sequence[Span]) -> None:
        """Reports values that a scale has twice."""
        seen: set[str] = set()
        for value, span in zip(measure.values, spans):
            if value in seen:
                self.problem(
                    f"the scale of {quoted(measure.name)} contains {quoted(value)} twice", span, "delete one of them"
                )
            seen.add(value)

    # Constants ------------------------------------------------------------------------------------------------

    def define_constants(self, written: WrittenConstants) -> None:
        """Gives each constant its value: a number, or the value of another constant, wherever that is defined."""
        for name in written:
            chain: dict[str, None] = {}
            at = name
            while at not in self.constants and at not in chain:
                chain[at] = None
                side, constant = written[at]
                if not isinstance(side.written, str):
                    self.constants[at] = constant
                elif side.written in written:
                    at = side.written
                else:
                    message, hint = self.unknown_constant(side.written, written)
                    example = f"write a number, or define it: {self.constant_keyword} {side.written} = 18"
                    self.problem(message, side.span, hint or example)
                    self.constants[at] = constant
            if at not in self.constants:
                names = list(chain)
                self._report_cycle(names[names.index(at) :], written[at][0].span)
                self.constants[at] = written[at][1]
            value = self.constants[at].value
            for link in chain:
                self.constants[link] = replace(written[link][1], value=value)

    def unknown_constant(self, name: str, known: WrittenConstants) -> tuple[str, str]:
        """The message and the hint, if any, for a name that is not a constant."""
        raise NotImplementedError

    def _report_cycle(self, names: Sequence[str], span: Span) -> None:
        example = f"for example: {self.constant_keyword} {names[0]} = 18"
        if len(names) == 1:
            self.problem(
                f"the constant {quoted(names[0])} is defined by itself, so it has no value",
                span,
                f"define it by a number or another constant, {example}",
            )
            return
        links = [quoted(name) for name in names]
        if len(links) > 5:
            links[4:] = ["..."]
        written = " = ".join((*links, quoted(names[0])))
        message = f"these constants are defined by each other, so they have no value: {written}"
        self.problem(message, span, f"define one of them by a number, {example}")
