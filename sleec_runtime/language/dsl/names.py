"""What each name of a text in the DSL is: event, measure, constant, or value of a scale. Every one is defined."""

from __future__ import annotations

import operator as operators
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from math import ceil, floor, gcd
from typing import Literal, Union

from sleec_runtime.errors import Problem
from sleec_runtime.language.dsl.operands import Operand, Side, Sum
from sleec_runtime.language.formulas import MAX_DIGITS
from sleec_runtime.language.resolve import MAX_PROBLEMS, did_you_mean
from sleec_runtime.language.suggest import Suggester
from sleec_runtime.language.token_reader import quoted
from sleec_runtime.model import (
    Calculated,
    Comparison,
    Constant,
    Defect,
    DefectKind,
    Formula,
    Measure,
    MeasureRef,
    Number,
    Operator,
    Rational,
    ScaleValue,
    Source,
    Span,
    Term,
    Truth,
)

NameKind = Literal["event", "boolean", "measure", "constant"]
_ARTICLE = {"event": "an event", "boolean": "a boolean measure", "measure": "a measure", "constant": "a constant"}

MAX_TERMS = 20
"""Parts that what a calculation comes to may have: written with all parentheses, they are no longer than one may be."""

_COMPARED: Mapping[Operator, Callable[[Rational, Rational], bool]] = {
    "<": operators.lt,
    "<=": operators.le,
    "=": operators.eq,
    "!=": operators.ne,
    ">=": operators.ge,
    ">": operators.gt,
}
_MIRRORED: Mapping[Operator, Operator] = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}


class Names:
    """The names of one text and what they stand for."""

    def __init__(self, source: Source, problems: list[Problem], defined: bool = True) -> None:
        """`defined` says whether the text has a block of definitions at all."""
        self.kinds: dict[str, NameKind] = {}
        self.measures: dict[str, Measure] = {}
        self.constants: dict[str, Constant] = {}
        self.calculated_with: set[str] = set()
        """The constants of what is worked out when it is read, and does not name them any more."""
        self.defects: list[Defect] = []
        self.complete = True
        """False once a definition could not be read: then a name without one is no news."""
        self._source = source
        self._problems = problems
        self._spans: dict[str, Span] = {}
        self._owners: dict[str, str] = {}
        self._labels: dict[str, tuple[Span, int]] = {}
        self._refs: dict[str, MeasureRef] = {}
        self._defined = defined
        self._undefined: dict[str, tuple[int, int]] = {}
        """Names without a definition: which problem says so, and how often each is used."""
        self._nearest = Suggester().nearest

    def problem(self, message: str, span: Span, hint: str | None) -> None:
        self._problems.append(Problem(message, span, hint))

    def line(self, span: Span) -> int:
        return self._source.place(span).line

    # Definitions ----------------------------------------------------------------------------------------------

    def define(self, kind: NameKind, name: str, span: Span) -> bool:
        """Takes a definition in; False, and a problem, if the name is taken."""
        first = self._spans.setdefault(name, span)
        if first is span:
            self.kinds[name] = kind
            return True
        other = self.kinds[name]
        if other == kind:
            message = f"{quoted(name)} is defined twice; the first time in line {self.line(first)}"
        else:
            message = f"{quoted(name)} is {_ARTICLE[kind]} here, and {_ARTICLE[other]} in line {self.line(first)}"
        self.problem(message, span, "delete or rename one of them")
        return False

    def define_measure(self, measure: Measure, span: Span, value_spans: list[Span]) -> None:
        if self.define("measure", measure.name, span):
            self.measures[measure.name] = measure
        seen: set[str] = set()
        for value, value_span in zip(measure.values, value_spans):
            if value in seen:
                self.problem(
                    f"the scale of {quoted(measure.name)} names {quoted(value)} twice",
                    value_span,
                    "each value of a scale has one place in it",
                )
            seen.add(value)
            # As in the tools of others, a literal of the wrong scale counts by its place in the last scale with it.
            self._owners[value] = measure.name

    def define_constants(self, written: dict[str, tuple[Side, Constant]]) -> None:
        """The constants with their values: each is a number or the value of another, wherever that stands."""
        for name in written:
            chain: dict[str, None] = {}
            at = name
            while at not in self.constants and at not in chain:
                chain[at] = None
                alias = written[at][0].written
                if not isinstance(alias, str):
                    self.constants[at] = written[at][1]
                elif alias in written:
                    at = alias
                else:
                    self._no_constant(written[at][0], written)
                    self.constants[at] = written[at][1]
            if at not in self.constants:
                self._circular(at, list(chain), written)
            value = self.constants[at].value
            for link in chain:
                self.constants[link] = replace(written[link][1], value=value)

    def _no_constant(self, side: Side, known: dict[str, tuple[Side, Constant]]) -> None:
        name = str(side.written)
        if name in self.kinds:
            message = f"{quoted(name)} is {_ARTICLE[self.kinds[name]]}, not a constant"
            hint = "a constant is a whole number or another constant"
        else:
            message, hint = f"there is no constant {quoted(name)}", did_you_mean(self._nearest(name, known))
        self.problem(message, side.span, hint or f"write a number, or define it: constant {name} = 18")

    def _circular(self, name: str, chain: list[str], written: dict[str, tuple[Side, Constant]]) -> None:
        circle = chain[chain.index(name) :]
        by_way = f", by way of {', '.join(quoted(other) for other in circle[1:4])}" if len(circle) > 1 else ""
        self.problem(
            f"the constant {quoted(name)} is defined by itself{by_way}",
            written[name][0].span,
            "give one of them a number",
        )
        self.constants[name] = written[name][1]

    def label(self, label: str, span: Span) -> str:
        """The label to call a rule or claim by. Others read texts in which two have the same; the second one becomes
        ``label#2``."""
        first, count = self._labels.get(label, (span, 0))
        self._labels[label] = first, count + 1
        if not count:
            return label
        self.defects.append(
            Defect(
                "repeated-label",
                f"there is another {label} in line {self.line(first)}; this one is called {label}#{count + 1} here",
                span,
                "give each a label of its own",
            )
        )
        return f"{label}#{count + 1}"

    # Uses -----------------------------------------------------------------------------------------------------

    def event(self, name: str, span: Span, what: str) -> None:
        """A name that stands where an event must."""
        kind = self.kinds.get(name)
        if kind == "event" or (kind is None and not self.complete):
            return
        if kind is None:
            self._without_definition(name, span, "event", "event", f"event {name}")
        else:
            self.problem(
                f"{quoted(name)} is {_ARTICLE[kind]} (line {self.line(self._spans[name])}); {what} is an event",
                span,
                "measures belong into conditions, behind and or unless"
                if kind != "constant"
                else "constants belong into comparisons and windows",
            )

    def boolean(self, name: str, span: Span) -> None:
        """A name that stands alone in a condition."""
        kind = self.kinds.get(name)
        if kind == "boolean" or (kind is None and not self.complete):
            return
        if kind is None:
            self._without_definition(name, span, "boolean measure", "boolean", f"measure {name}: boolean")
        elif kind == "event":
            self.problem(
                f"{quoted(name)} is an event (line {self.line(self._spans[name])}), and conditions speak of measures",
                span,
                f"define what is to be known as a measure: measure {name[:1].lower()}{name[1:]}: boolean",
            )
        else:
            measure = self.measures.get(name)
            example = f"= {measure.values[0]}" if measure is not None and measure.values else "> 0"
            self.problem(
                f"{quoted(name)} is {_ARTICLE[kind]} that is no boolean, and is not compared with anything",
                span,
                f"as in: {name} {example}",
            )

    def _without_definition(self, name: str, span: Span, what: str, kind: NameKind, definition: str) -> None:
        """Reports a name that has no definition where it is used first, and counts the other uses. Where nothing is
        defined, that is one problem, and none of any name."""
        if not self._defined:
            self._no_definitions()
            return
        if name in self._undefined:
            problem, uses = self._undefined[name]
            self._undefined[name] = problem, uses + 1
            return
        self._undefined[name] = len(self._problems), 1
        known = [other for other, its in self.kinds.items() if its == kind]
        near = self._nearest(name, known) if len(self._problems) < MAX_PROBLEMS else None
        self.problem(
            f"there is no {what} {quoted(name)}",
            span,
            did_you_mean(near) or f"define it, between def_start and def_end: {definition}",
        )

    def _no_definitions(self) -> None:
        self.complete = False
        self.problem(
            "there is no def_start block, so no name in this text is defined",
            Span(0, 0),
            "begin with definitions, as in: def_start event SmokeDetected measure userAtHome: boolean def_end",
        )

    def count_uses(self) -> None:
        """Adds to what is said of each name without a definition how often it is used, once all uses are known."""
        for problem, uses in self._undefined.values():
            if uses > 1:
                more = "1 more place" if uses == 2 else f"{uses - 1:,} more places"
                said = self._problems[problem]
                self._problems[problem] = replace(said, message=f"{said.message}; it is used in {more}")

    def amount(self, operand: Operand) -> Union[Number, MeasureRef, Calculated, None]:
        """How long something takes: a number, a constant, a numeric measure, or what is calculated from these; None,
        and a problem, if it is nothing of that."""
        if isinstance(operand, Side):
            return self.number(operand)
        whole = self._sum(operand)
        if whole is None:
            return None
        if not whole.terms:
            return Number(whole.number)
        (measures, factor), *more = whole.terms.items()
        if (len(measures), factor, whole.number) == (1, 1, 0) and not more:
            return self._ref(measures[0])
        terms = [(factor, names) for names, factor in whole.terms.items()]
        number = [(whole.number, ())] if whole.number else []
        return Calculated(tuple(sorted([*terms, *number], key=lambda term: term[0] < 0)), self.line(operand.span))

    def number(self, side: Side) -> Union[Number, MeasureRef, None]:
        """A number, a constant or a numeric measure; None, and a problem, if it is nothing of that."""
        name = side.written
        if not isinstance(name, str):
            return Number(name)
        constant = self.constants.get(name)
        if constant is not None and not side.braced:
            return Number(constant.value, name)
        measure = self.measures.get(name)
        if measure is not None and measure.kind != "scale":
            return self._ref(name)
        if name not in self.kinds:
            if self.complete:
                self._without_definition(
                    name, side.span, "constant or numeric measure", "measure", f"measure {name}: numeric"
                )
        else:
            self.problem(
                f"{quoted(name)} is {'a scale' if measure is not None else _ARTICLE[self.kinds[name]]}, not a number",
                side.span,
                "write a whole number, a constant or a numeric measure",
            )
        return None

    def _sum(self, side: Operand) -> Sum | None:
        """What a side comes to; None, and a problem, if it cannot be told."""
        if isinstance(side, Side):
            term = self.number(side)
            if term is None:
                return None
            if isinstance(term, MeasureRef):
                return Sum({(term.name,): 1}, 0)
            if term.constant is not None:
                self.calculated_with.add(term.constant)
            return Sum({}, int(term.value))
        left, right = self._sum(side.left), self._sum(side.right)
        if left is None or right is None:
            return None
        if side.operator != "*":
            found = left.plus(right, 1 if side.operator == "+" else -1)
        elif max(map(len, left.terms), default=0) + max(map(len, right.terms), default=0) > 2:
            self.problem(
                "a product of more than two measures is not analysed", side.span, "multiply two measures at most"
            )
            return None
        else:
            found = left.multiplied(right)
        return self._limited(found, side.span)

    def _limited(self, found: Sum, span: Span) -> Sum | None:
        """What a calculation comes to; None, and a problem, if that is too long."""
        if len(found.terms) > MAX_TERMS:
            self.problem(
                f"this calculation comes to a sum of {len(found.terms)} parts, more than {MAX_TERMS}",
                span,
                "multiply out less, or compare parts of it",
            )
            return None
        if found.digits() > MAX_DIGITS:
            message = f"this calculation comes to a number of more than {MAX_DIGITS} digits"
            self.problem(message, span, "count in a larger unit")
            return None
        return found

    def _ref(self, name: str) -> MeasureRef:
        ref = self._refs.get(name)
        if ref is None:
            ref = self._refs[name] = MeasureRef(name)
        return ref

    # Comparisons ----------------------------------------------------------------------------------------------

    def comparison(self, left: Side, operator: Operator, right: Side, span: Span) -> Comparison | Truth | None:
        """``left operator right``; None, and a problem, if the sides do not fit. With two fixed numbers it is true or
        false, whatever the situation."""
        one, two = self._scale(left), self._scale(right)
        terms: tuple[Term | None, Term | None]
        if one is not None and two is not None:
            if one.values != two.values:
                self.problem(
                    f"{quoted(one.name)} and {quoted(two.name)} have different scales: "
                    f"{_values(one)}, and {_values(two)}",
                    span,
                    "only measures of the same scale can be compared with each other",
                )
                return None
            terms = self._ref(one.name), self._ref(two.name)
        elif one is not None:
            terms = self._ref(one.name), self._value(one, right)
        elif two is not None:
            terms = self._value(two, left), self._ref(two.name)
        else:
            if self._stray(left, right) or self._stray(right, left):
                return None
            terms = number, other = self.number(left), self.number(right)
            if isinstance(number, Number) and isinstance(other, Number):
                self.calculated_with.update(name for name in (number.constant, other.constant) if name is not None)
                return Truth(_COMPARED[operator](number.value, other.value), span)
        first, second = terms
        return None if first is None or second is None else Comparison(first, operator, second, span)

    def calculated(self, left: Operand, operator: Operator, right: Operand, span: Span) -> Formula | None:
        """A comparison of calculations as one that compares a measure with a number, or two measures, or else what is
        calculated from several with a number; None, and a problem, if there is none."""
        one, two = self._sum(left), self._sum(right)
        if one is None or two is None:
            return None
        whole = self._limited(one.plus(two, -1), span)
        if whole is None:
            return None
        if not whole.terms:
            return Truth(_COMPARED[operator](whole.number, 0), span)
        (names, factor), *more = whole.terms.items()
        if factor < 0:
            operator = _MIRRORED[operator]
        divisor = gcd(*whole.terms.values()) * (1 if factor > 0 else -1)
        number = Fraction(-whole.number, divisor)
        if not more and len(names) == 1:
            return _with_whole_number(self._ref(names[0]), operator, number, span)
        if whole.number == 0 and [(len(other), times) for other, times in more] == [(1, -factor)] and len(names) == 1:
            return Comparison(self._ref(names[0]), operator, self._ref(more[0][0][0]), span)
        terms = tuple((times // divisor, product) for product, times in whole.terms.items())
        found = _with_whole_number(Calculated(terms, self.line(span)), operator, number, span)
        # A constant that stands alone on one side keeps its name.
        for side, other in ((right, one), (left, two)):
            if isinstance(side, Side) and isinstance(found, Comparison) and other.number == 0:
                alone = self.number(side)
                if isinstance(alone, Number) and isinstance(found.right, Number) and alone.value == found.right.value:
                    return replace(found, right=alone)
        return found

    def _scale(self, side: Side) -> Measure | None:
        measure = self.measures.get(side.written) if isinstance(side.written, str) else None
        return measure if measure is not None and measure.kind == "scale" else None

    def _value(self, measure: Measure, side: Side) -> ScaleValue | None:
        """The other side of a comparison with a scale. A literal of another scale and a number are read by their
        place, as others read them, and are defects."""
        value = side.written
        if isinstance(value, str) and not side.braced:
            if value in measure.values:
                return ScaleValue(value, measure.values.index(value))
            owner = self.measures.get(self._owners.get(value, ""))
            if owner is not None:
                said = f"{value} is no value of {measure.name} but of {owner.name}"
                return self._by_place(measure, value, owner.values.index(value), "foreign-value", said, side.span)
        number = self.constants[value].value if isinstance(value, str) and value in self.constants else value
        if isinstance(number, int) and not side.braced:
            named = f"{value}, which is {number}," if isinstance(value, str) else str(number)
            said = f"{measure.name} is a scale, and {named} a number"
            return self._by_place(measure, str(value), number, "number-as-value", said, side.span)
        near = self._nearest(value, measure.values) if isinstance(value, str) else None
        self.problem(
            f"{quoted(str(value))} is no value of {quoted(measure.name)}",
            side.span,
            f"{did_you_mean(near) + ' ' if near else ''}{quoted(measure.name)} can be {_values(measure)}",
        )
        return None

    def _by_place(
        self, measure: Measure, written: str, rank: int, kind: DefectKind, said: str, span: Span
    ) -> ScaleValue:
        """What is no value of the measure, as the value in that place of its scale; there may be none."""
        can_be = f"{measure.name} can be {_values(measure)}"
        if 0 <= rank < len(measure.values):
            meant = measure.values[rank]
            place = "the same place" if kind == "foreign-value" else f"place {rank}, counted from 0"
            read = f"it is read as {meant}, which has {place}"
            hint = f"write {meant}, if that is meant; {can_be}"
        else:
            side = "below" if rank > 0 else "above"
            read = f"every value of {measure.name} lies {side} it, so the answer is always the same"
            hint = f"write the value that is meant; {can_be}"
        self.defects.append(Defect(kind, f"{said}; {read}", span, hint))
        return ScaleValue(written, rank)

    def _stray(self, side: Side, other: Side) -> bool:
        """Whether one side is a value of a scale and the other no scale, which is then reported."""
        value = side.written
        if not isinstance(value, str) or value in self.kinds or value not in self._owners:
            return False
        compared = other.written
        if isinstance(compared, str) and compared not in self.kinds and compared not in self._owners:
            if self.complete:
                self._without_definition(
                    compared, other.span, "measure", "measure", f"measure {compared}: scale({value}, ...)"
                )
            return True
        self.problem(
            f"{quoted(str(other.written))} is no scale, and {quoted(value)} is a value of "
            f"{quoted(self._owners[value])}: they cannot be compared",
            side.span,
            f"compare {quoted(self._owners[value])} with it, or write a number",
        )
        return True


def _with_whole_number(measure: MeasureRef | Calculated, operator: Operator, number: Fraction, span: Span) -> Formula:
    """A comparison of a whole number with any."""
    if number.denominator == 1:
        return Comparison(measure, operator, Number(int(number)), span)
    if operator in ("=", "!="):
        return Truth(operator == "!=", span)
    up = operator in ("<", ">=")
    return Comparison(measure, operator, Number(ceil(number) if up else floor(number)), span)


def _values(measure: Measure) -> str:
    values = measure.values
    return " < ".join((*values[:4], "...", values[-1]) if len(values) > 8 else values)
