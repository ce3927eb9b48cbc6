"""The range of a measure: the values that the relations and constraints of a ruleset allow at every instant."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sleec_runtime.model import Atom, Comparison, Measure, MeasureRef, Number, Rational
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.relations import Relation, at_one_instant
from sleec_verify.encoding.solver import MiniSat


class MeasureRanges:
    """The ranges of the integer measures of a ruleset.

    Each bound is a number that a relation compares with a measure. A range can be too wide if only arithmetic excludes
    a value, but it contains all values of the measure.
    """

    def __init__(self, relations: Iterable[Relation], measures: Mapping[str, Measure]) -> None:
        self._relations = tuple(relations)
        self._measures = measures
        self._known: dict[str, tuple[int | None, int | None]] = {}

    def bounds(self, measure: str) -> tuple[int | None, int | None]:
        """The least and the greatest value of an integer measure. None means that there is none."""
        if measure not in self._known:
            self._known[measure] = self._bounds(measure)
        return self._known[measure]

    def _bounds(self, measure: str) -> tuple[int | None, int | None]:
        encoder = Encoder(self._measures)

        def atom(one: Atom) -> int:
            return encoder.variable(("condition" if one.kind == "condition" else "trigger", one.name))

        for relation in self._relations:
            for part in at_one_instant(relation):
                encoder.clauses.append([encoder.literal(formula, atom) for formula in part])
        numbers: set[Rational] = set()
        for name in self._compared(encoder, measure):
            numbers.update(cut.value for cut in encoder.measures.cuts.get(name, ()))
        at_most = {
            bound: encoder.literal(Comparison(MeasureRef(measure), "<=", Number(bound)))
            for bound in sorted({int(number // 1) for number in numbers})
        }
        encoder.close()
        with MiniSat(encoder.clauses) as solver:
            highest = [bound for bound, literal in at_most.items() if solver.solve([-literal]) is False]
            lowest = [bound + 1 for bound, literal in at_most.items() if solver.solve([literal]) is False]
        return max(lowest, default=None), min(highest, default=None)

    def _compared(self, encoder: Encoder, measure: str) -> set[str]:
        """The measures that comparisons connect with a measure, and itself."""
        found = {measure}
        ahead = [measure]
        while ahead:
            name = ahead.pop()
            for one, other in encoder.measures.orders:
                if one == name and other not in found:
                    found.add(other)
                    ahead.append(other)
        return found
