"""What each name is: event, measure, constant, or value of a scale. Every name must be defined."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.problems import MAX_PROBLEMS, quoted
from sleec_runtime.language.common.symbol_table import SymbolTable, WrittenConstants
from sleec_runtime.model import (
    Constant,
    Declaration,
    Defect,
    Measure,
    Source,
    Span,
)
from sleec_runtime.support.suggestions import did_you_mean

NameKind = Literal["event", "boolean", "measure", "constant"]
_ARTICLE = {"event": "an event", "boolean": "a boolean measure", "measure": "a measure", "constant": "a constant"}


class DslNames(SymbolTable):
    """The names of one text and what they stand for."""

    constant_keyword = "constant"

    def __init__(self, source: Source, problems: list[Problem], defined: bool = True) -> None:
        """`defined` says whether the text has a block of definitions at all."""
        super().__init__(source, problems)
        self.kinds: dict[str, NameKind] = {}
        self.calculated_with: set[str] = set()
        """The constants in calculations that are evaluated while parsing and no longer name them."""
        self.defects: list[Defect] = []
        self._spans: dict[str, Span] = {}
        self._definitions: dict[str, Declaration | Measure | Constant] = {}
        self._owners: dict[str, Measure] = {}
        """Each value of a scale with the last measure that has it, be that a second definition of its name."""
        self._values: dict[str, tuple[str, Span]] = {}
        """Each value of a scale with the first measure that has it, and the place of that."""
        self._labels: dict[str, tuple[Span, int]] = {}
        self._defined = defined
        self._undefined: dict[str, tuple[int, int]] = {}
        """Names without a definition: the index of the problem that reports each, and how often each is used."""

    # Definitions ----------------------------------------------------------------------------------------------

    def define(self, kind: NameKind, name: str, span: Span, statement: Declaration | Measure | Constant) -> bool:
        """Adds a definition; False if the name is taken. The same definition again is a defect, another one of the
        same name a problem."""
        first = self._spans.setdefault(name, span)
        if first is span:
            self.kinds[name] = kind
            self._definitions[name] = statement
            return True
        other = self.kinds[name]
        if self._definitions[name] == statement:
            message = f"{quoted(name)} is defined again; the first time in line {self.line(first)}"
            self.defects.append(Defect("repeated-definition", message, span, "delete one of the two definitions"))
            return False
        if other == kind:
            message = f"{quoted(name)} is defined twice; the first time in line {self.line(first)}"
        else:
            message = f"{quoted(name)} is {_ARTICLE[kind]} here, and {_ARTICLE[other]} in line {self.line(first)}"
        self.problem(message, span, "delete or rename one of them")
        return False

    def define_measure(self, measure: Measure, span: Span, value_spans: list[Span]) -> None:
        if self.define("measure", measure.name, span, measure):
            self.measures[measure.name] = measure
        self.check_scale(measure, value_spans)
        for value, value_span in zip(measure.values, value_spans):
            self._values.setdefault(value, (measure.name, value_span))
            # As in other tools, a literal of the wrong scale counts by its place in the last scale with it.
            self._owners[value] = measure

    def check_values(self) -> None:
        """Reports values of scales with the name of something else: a comparison could mean either. Scales may share
        values."""
        for value in self._values.keys() & self.kinds.keys():
            owner, span = self._values[value]
            of_scale, other = f"a value of the scale of {quoted(owner)}", _ARTICLE[self.kinds[value]]
            first = self._spans[value]
            here, there, place = (of_scale, other, first) if span > first else (other, of_scale, span)
            self.problem(
                f"{quoted(value)} is {here} here, and {there} in line {self.line(place)}",
                max(span, first),
                "rename one of them",
            )

    def unknown_constant(self, name: str, known: WrittenConstants) -> tuple[str, str]:
        if name in self.kinds or name in self._owners:
            return f"{self.described(name)}, not a constant", "a constant is a whole number or another constant"
        return f"no constant is called {quoted(name)}", did_you_mean(self.nearest(name, known))

    def label(self, label: str, span: Span) -> str:
        """The label of a rule or claim. A repeated label is a defect; the second one becomes ``label#2``."""
        first, count = self._labels.get(label, (span, 0))
        self._labels[label] = first, count + 1
        if not count:
            return label
        self.defects.append(
            Defect(
                "repeated-label",
                f"there is another `{label}` in line {self.line(first)}; this one is called `{label}#{count + 1}`",
                span,
                "give each its own label",
            )
        )
        return f"{label}#{count + 1}"

    def described(self, name: str) -> str:
        """What a name is, and where it is defined: a name with a definition, or a value of a scale."""
        if name not in self.kinds:
            owner = self._owners[name]
            return f"{quoted(name)} is a value of {quoted(owner.name)} (line {self.line(owner.span)})"
        its = _ARTICLE[self.kinds[name]]
        measure = self.measures.get(name)
        if measure is not None:
            its = "a scale" if measure.kind == "scale" else "a numeric measure"
        return f"{quoted(name)} is {its} (line {self.line(self._spans[name])})"

    # Uses -----------------------------------------------------------------------------------------------------

    def event(self, name: str, span: Span, what: str) -> None:
        """Uses a name as an event; `what` says for what."""
        kind = self.kinds.get(name)
        if kind == "event" or (kind is None and not self.complete):
            return
        if kind is None:
            self._without_definition(name, span, "event", "event", f"event {name}")
        else:
            self.problem(
                f"{self.described(name)}, but {what} is an event",
                span,
                "use measures in conditions, after and or unless"
                if kind != "constant"
                else "use constants in comparisons and times",
            )

    def boolean(self, name: str, span: Span) -> None:
        """Uses a name alone as a condition."""
        kind = self.kinds.get(name)
        if kind is None and name not in self._owners:
            if not self.complete:
                return
            self._without_definition(name, span, "boolean measure", "boolean", f"measure {name}: boolean")
        elif kind == "boolean":
            return
        elif kind == "event":
            self.problem(
                f"{self.described(name)}, but a condition is needed here",
                span,
                f"define a condition, for example: measure {name[:1].lower()}{name[1:]}: boolean",
            )
        else:
            self.problem(f"{self.described(name)}, which is not true or false by itself", span, self._compare(name))

    def _compare(self, name: str) -> str:
        """How to compare a name that is not a condition by itself."""
        if name not in self.kinds:
            return f"compare the measure with it, for example: {self._owners[name].name} = {name}"
        if name in self.constants:
            return f"compare a measure with it, for example: {self.numeric_example()} > {name}"
        measure = self.measures.get(name)
        if measure is not None and measure.values:
            return f"compare it with one of its values, for example: {name} = {measure.values[0]}"
        return f"compare it with a number, for example: {name} > 0"

    def numeric_example(self) -> str:
        """A numeric measure to write into an example."""
        return next((name for name, measure in self.measures.items() if measure.kind != "scale"), "temperature")

    def _without_definition(self, name: str, span: Span, what: str, kind: NameKind, definition: str) -> None:
        """Reports the first use of a name without a definition, and counts the other uses. If the text has no
        definitions, this is one problem for the whole text."""
        if not self._defined:
            self._no_definitions()
            return
        if name in self._undefined:
            problem, uses = self._undefined[name]
            self._undefined[name] = problem, uses + 1
            return
        self._undefined[name] = len(self._problems), 1
        known = [other for other, its in self.kinds.items() if its == kind]
        near = self.nearest(name, known) if len(self._problems) < MAX_PROBLEMS else None
        self.problem(
            f"no {what} is called {quoted(name)}",
            span,
            did_you_mean(near) or f"define it, between def_start and def_end: {definition}",
        )

    def _no_definitions(self) -> None:
        self.complete = False
        self.problem(
            "there is no def_start block, so no name in this text is defined",
            Span(0, 0),
            "start with definitions, for example: def_start event SmokeDetected measure userAtHome: boolean def_end",
        )

    def count_uses(self) -> None:
        """Adds the number of uses to the problem of each name without a definition."""
        for problem, uses in self._undefined.values():
            if uses > 1:
                more = "1 more place" if uses == 2 else f"{uses - 1:,} more places"
                said = self._problems[problem]
                self._problems[problem] = replace(said, message=f"{said.message}; it is used in {more}")
