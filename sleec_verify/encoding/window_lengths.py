"""Windows whose length depends on measures, as one window with a fixed length for each value.

``X within {m} minutes`` is the chain "X within 1 minute, unless m >= 2 then X within 2 minutes, unless m >= 3 …" over
the range of the measure (instantiation of a small domain; A. Pnueli and others, "The small model property: how small
can it be?", 2002). The conditions are monotone, so the chain has one meaning under both readings of chains.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import prod

from sleec_runtime.model import (
    And,
    Calculation,
    Clause,
    Comparison,
    Formula,
    Lasting,
    Length,
    MeasureRef,
    Number,
    Obligation,
    Ruleset,
    Window,
    in_text_order,
)
from sleec_verify.encoding.measure_ranges import MeasureRanges
from sleec_verify.encoding.relations import Relation
from sleec_verify.encoding.solver import Undecided
from sleec_verify.wording.phrases import grouped, quoted
from sleec_verify.wording.sentence import sentence

MOST_VALUES = 1_000
"""The maximal number of values of the measures of one response."""


class WindowLengths:
    """The windows of a ruleset for each value of the measures that give their lengths."""

    def __init__(self, ruleset: Ruleset, relations: list[Relation]) -> None:
        self._syntax = ruleset.syntax
        self._ranges = MeasureRanges(relations, ruleset.measures)
        self._cases: dict[int, tuple[Obligation, Clause | None]] = {}

    def cases(self, obligation: Obligation) -> Clause | None:
        """A chain with this obligation for each value of one of its measures; None if it has none.

        Raises `Undecided` if the range of a measure has no bounds.
        """
        if obligation.timing is None:
            return None
        known = self._cases.get(id(obligation))
        if known is None or known[0] is not obligation:
            known = self._cases[id(obligation)] = obligation, self._split(obligation)
        return known[1]

    def _split(self, obligation: Obligation) -> Clause | None:
        measures = list(dict.fromkeys(name for length in lengths_of(obligation) for name in length.measures))
        if not measures:
            return None
        name, text = measures[0], str(obligation.timing)
        count = prod(len(self._values(measure, text)) for measure in measures)
        if count > MOST_VALUES:
            raise Undecided(
                sentence(
                    "the lengths of {window} have {number} combinations of values, more than the limit of {limit}",
                    window=quoted(text),
                    number=grouped(count),
                    limit=grouped(MOST_VALUES),
                )
            )
        first, *others = self._values(name, text)
        return Clause(
            None,
            (with_value(obligation, name, first),),
            tuple(
                Clause(Comparison(MeasureRef(name), ">=", Number(value)), (with_value(obligation, name, value),))
                for value in others
            ),
        )

    def of_relation(self, relation: Relation) -> Iterator[Relation]:
        """The relation, or one relation for each value of the measures of its duration, if these have bounds."""
        if not isinstance(relation, Lasting) or relation.duration is None or not relation.duration.measures:
            yield relation
            return
        name = relation.duration.measures[0]
        try:
            values = self._values(name, f"for {relation.duration}")
        except Undecided:
            yield relation
            return
        for value in values:
            equal = Comparison(MeasureRef(name), "=", Number(value))
            condition = equal if relation.condition is None else And((relation.condition, equal))
            duration = length_with_value(relation.duration, name, value)
            yield from self.of_relation(replace(relation, condition=condition, duration=duration))

    def _values(self, measure: str, text: str) -> range:
        least, greatest = self._ranges.bounds(measure)
        if least is None or greatest is None:
            raise Undecided(
                sentence(
                    "nothing bounds {measure}, which gives the length of {window}; declare a range, for example: "
                    "{example}",
                    measure=quoted(measure),
                    window=quoted(text),
                    example=self._example(measure),
                )
            )
        # Without any value, no instant is possible, and no window matters.
        found = range(least, max(least, greatest) + 1)
        if len(found) > MOST_VALUES:
            raise Undecided(
                sentence(
                    "{measure}, which gives the length of {window}, has {number} values, more than the limit of "
                    "{limit}; use a larger unit",
                    measure=quoted(measure),
                    window=quoted(text),
                    number=grouped(len(found)),
                    limit=grouped(MOST_VALUES),
                )
            )
        return found

    def _example(self, measure: str) -> str:
        if self._syntax == "dsl":
            return f"measure invariant ({{{measure}}} >= 0 and {{{measure}}} <= 60)"
        return f"ASSUME {measure} >= 0 AND {measure} <= 60"

    def formulas(self, clause: Clause) -> Iterator[Formula]:
        """The conditions of the cases of the responses of a clause, at any depth, without its hedges.

        Raises `Undecided` as `cases` does.
        """
        for obligation in clause.obligations:
            cases = self.cases(obligation)
            if cases is not None:
                yield from (member.condition for member in cases.hedges if member.condition is not None)
                chains = [cases]
            else:
                chains = [] if obligation.timing is None else list(obligation.timing.alternatives())
            for chain in chains:
                for member in in_text_order(chain):
                    yield from self.formulas(member)


def measures_of_lengths(clause: Clause) -> Iterator[str]:
    """The measures that give lengths of windows of a clause and its alternatives, repeats included."""
    for obligation in clause.obligations:
        yield from (name for length in lengths_of(obligation) for name in length.measures)


def lengths_of(obligation: Obligation) -> Iterator[Length]:
    """The lengths of the windows of an obligation and its alternatives, at any depth."""
    timing = obligation.timing
    if timing is None:
        return
    if timing.window is not None:
        yield from (length for length in (timing.window.start, timing.window.end) if length is not None)
    for clause in timing.alternatives():
        for member in in_text_order(clause):
            for other in member.obligations:
                yield from lengths_of(other)


def with_value(obligation: Obligation, measure: str, value: int) -> Obligation:
    """An obligation with a number in place of a measure in the lengths of its windows and alternatives."""
    timing = obligation.timing
    if timing is None:
        return obligation

    def of_length(length: Length | None) -> Length | None:
        return None if length is None else length_with_value(length, measure, value)

    def of_clause(clause: Clause | None) -> Clause | None:
        if clause is None:
            return None
        obligations = tuple(with_value(one, measure, value) for one in clause.obligations)
        hedges = tuple(hedge for hedge in map(of_clause, clause.hedges) if hedge is not None)
        return replace(clause, obligations=obligations, hedges=hedges)

    window = timing.window
    if window is not None:
        window = Window(of_length(window.end), of_length(window.start), window.span)
    otherwise, instead = of_clause(timing.otherwise), of_clause(timing.instead)
    return replace(obligation, timing=replace(timing, window=window, otherwise=otherwise, instead=instead))


def length_with_value(length: Length, measure: str, value: int) -> Length:
    """A length of time with a number in place of a measure."""
    amount = length.amount
    if isinstance(amount, MeasureRef) and amount.name == measure:
        return replace(length, amount=Number(value))
    if isinstance(amount, Calculation) and measure in amount.measures:
        terms = tuple(
            (factor * value ** names.count(measure), tuple(name for name in names if name != measure))
            for factor, names in amount.terms
        )
        changed = Calculation(terms, amount.line)
        return replace(length, amount=changed if changed.measures else Number(changed.value({})))
    return length
