"""Comparisons: what each side is, and whether the two fit."""

from __future__ import annotations

from sleec_runtime.language.common.comparisons import Side, scale_text, values_hint
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.english.name_resolution import EnglishNames
from sleec_runtime.model import Comparison, Measure, MeasureRef, Number, Operator, ScaleValue, Span, Term
from sleec_runtime.support.suggestions import did_you_mean


class EnglishComparisons:
    """Makes comparisons with the declarations in `names`, and infers undeclared measures."""

    def __init__(self, names: EnglishNames) -> None:
        self._names = names

    def comparison(self, left: Side, operator: Operator, right: Side, span: Span) -> Comparison:
        """``left operator right``. Sides that do not fit are reported."""
        terms = self._term(left, right), self._term(right, left)
        self._check_fit(left, terms[0], right, terms[1], span)
        return Comparison(terms[0], operator, terms[1], span)

    def _term(self, side: Side, opposite: Side) -> Term:
        name = side.written
        if not isinstance(name, str):
            return Number(name)
        other = self._names.measures.get(opposite.written) if isinstance(opposite.written, str) else None
        if other is not None and name in other.values:
            return ScaleValue(name, other.values.index(name))
        constant = self._names.constants.get(name)
        if constant is not None:
            return Number(constant.value, name)
        self._names.compared.setdefault(name, side.span)
        if (
            name not in self._names.measures
            and name not in self._names.inferred
            and not self._is_out_of_place(name, other)
        ):
            self._names.inferred[name] = Measure(name, "number", declared=False, span=side.span)
        return self._names.measure_ref(name)

    def _is_out_of_place(self, name: str, other: Measure | None) -> bool:
        """Whether an undeclared name opposite `other` cannot be a number measure, which `_check_fit` reports."""
        return name in self._names.scales or (other is not None and other.kind == "scale")

    def _check_fit(self, left: Side, one: Term, right: Side, two: Term, span: Span) -> None:
        if isinstance(one, MeasureRef) and isinstance(two, MeasureRef):
            self._check_measures(left, right, span)
        elif isinstance(one, MeasureRef) and isinstance(two, Number):
            self._check_number(left, right)
        elif isinstance(two, MeasureRef) and isinstance(one, Number):
            self._check_number(right, left)
        elif isinstance(one, Number) and isinstance(two, Number):
            self._names.problem(
                f"{_written(left)} and {_written(right)} are both fixed numbers, so the result is always the same",
                span,
                "compare a measure with a number, or write true or false",
            )

    def _check_number(self, name: Side, number: Side) -> None:
        measure = self._names.measures.get(str(name.written))
        if measure is not None and measure.kind == "scale":
            self._names.problem(
                f"{_written(name)} is a scale and {_written(number)} is a number; they cannot be compared",
                number.span,
                f"compare it with one of its values: {scale_text(measure)}",
            )
        elif measure is None and str(name.written) in self._names.scales:
            self._problem_of_stray_value(name, number)

    def _check_measures(self, left: Side, right: Side, span: Span) -> None:
        one, two = self._measure(left), self._measure(right)
        if one is None and two is None:
            self._names.problem(
                f"{_written(left)} and {_written(right)} are both values of a scale, so the result is always the same",
                span,
                "compare a measure with one of its values",
            )
        elif one is None or two is None:
            measure, known, unknown = (one, left, right) if one is not None else (two, right, left)
            assert measure is not None
            if measure.kind == "scale":
                self._problem_of_wrong_value(measure, unknown)
            else:
                self._problem_of_stray_value(unknown, known)
        elif (one.kind == "scale") != (two.kind == "scale"):
            scale, other, values = (left, right, one) if one.kind == "scale" else (right, left, two)
            self._names.problem(
                f"{_written(scale)} is a scale and {_written(other)} is a number; they cannot be compared",
                span,
                f"compare {_written(scale)} with one of its values: {scale_text(values)}",
            )
        elif one.values != two.values:
            self._names.problem(
                f"{_written(left)} and {_written(right)} have different scales: "
                f"{scale_text(one)} and {scale_text(two)}",
                span,
                "compare measures of the same scale only",
            )

    def _measure(self, side: Side) -> Measure | None:
        return self._names.measures.get(str(side.written)) or self._names.inferred.get(str(side.written))

    def _problem_of_wrong_value(self, measure: Measure, side: Side) -> None:
        owners = self._names.scales.get(str(side.written))
        of_other = f", but of {quoted(owners[0])}" if owners else ""
        near = None if owners else self._names.nearest(str(side.written), measure.values)
        self._names.problem(
            f"{_written(side)} is not a value of {quoted(measure.name)}{of_other}",
            side.span,
            values_hint(measure, near),
        )

    def _problem_of_stray_value(self, value: Side, opposite: Side) -> None:
        """A value of a scale whose measure is not on the other side."""
        owner = self._names.measures.get(self._names.scales[str(value.written)][0])
        values = scale_text(owner) if owner else "low < high"
        if not isinstance(opposite.written, str) or opposite.written in self._names.constants:
            self._names.problem(
                f"{_written(value)} is a value of a scale and {_written(opposite)} is a number; "
                "they cannot be compared",
                opposite.span,
                f"compare {quoted(owner.name) if owner else 'its measure'} with it",
            )
        elif opposite.written in self._names.measures:
            self._names.problem(
                f"{_written(opposite)} is a number, and {_written(value)} is a value of "
                f"{quoted(owner.name) if owner else 'a scale'}; they cannot be compared",
                value.span,
                "compare it with a number",
            )
        else:
            near = self._names.nearest(opposite.written, self._names.measures)
            self._names.problem(
                f"{_written(opposite)} is compared with a value of a scale, but is not declared with a scale",
                opposite.span,
                did_you_mean(near) or f"declare it: MEASURE {opposite.written}: {values}",
            )


def _written(side: Side) -> str:
    return quoted(side.written if isinstance(side.written, str) else str(side.written))
