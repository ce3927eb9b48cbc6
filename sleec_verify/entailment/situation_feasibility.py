"""Whether a situation is possible: assumptions and relations on the values that are given and not given."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Assume, Context, Formula, Measure, Value
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.solver import MiniSat, Undecided
from sleec_verify.query.names import names_in
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Relation


class SituationLaw(NamedTuple):
    """An assumption or relation, its formula for one situation, and whether that formula is true if everything that is
    not given counts as false, including comparisons with measures without a value."""

    said: Assume | Relation
    formula: Formula
    holds: bool


class Feasibility(NamedTuple):
    """`broken` are the assumptions and relations that exclude the situation for all values of missing measures. If
    there are none, `unsettled` are those that are false if all comparisons with missing measures are false.
    `possible` are values with which all of them hold, if there are any: of the measures in them, and, if some are
    broken, a minimal set of conditions that must be true."""

    broken: tuple[Assume | Relation, ...] = ()
    unsettled: tuple[Assume | Relation, ...] = ()
    possible: tuple[tuple[str, Value], ...] = ()


def check_feasibility(laws: Sequence[SituationLaw], context: Context, measures: Mapping[str, Measure]) -> Feasibility:
    """The result of `laws` for a situation in which some values are not given."""
    failing = [law for law in laws if not law.holds]
    if not failing:
        return Feasibility()
    try:
        return _Asked(laws, context, measures).check(context, measures)
    except Undecided:
        # Undecided for all values: report only the laws without missing measures.
        return Feasibility(tuple(law.said for law in failing if not _missing([law], context, measures)))


def _missing(laws: Iterable[SituationLaw], context: Context, measures: Mapping[str, Measure]) -> list[str]:
    """The measures in `laws` without a value."""
    names = (name for law in laws for _, name in names_in(law.formula))
    return [name for name in dict.fromkeys(names) if name in measures and name not in context.conditions]


class _Asked:
    """The assumptions and relations as clauses over the situation, each with a literal that activates it."""

    def __init__(self, laws: Sequence[SituationLaw], context: Context, measures: Mapping[str, Measure]) -> None:
        encoder = self._encoder = Encoder(measures)
        self._laws = [(encoder.literal(law.formula), law) for law in laws]
        for name in _missing(laws, context, measures):
            encoder.measures.mention(name)
        encoder.close()
        self._solver = MiniSat(encoder.clauses)
        self._names = {
            variable: name
            for (kind, name, *_), variable in encoder.variables.items()
            if kind == "condition" and name not in context.conditions
        }
        self._given = [literal for literal in encoder.assumptions(context) if -literal not in self._names]

    def check(self, context: Context, measures: Mapping[str, Measure]) -> Feasibility:
        """The broken or unsettled ones, and values with which all of them hold."""
        all_laws = [literal for literal, _ in self._laws]
        failing = [law for _, law in self._laws if not law.holds]
        open_ones = {-variable for variable in self._names}
        broken = [law for literal, law in self._laws if not law.holds and not self._ask(literal, *open_ones)]
        if not broken and not self._ask(*all_laws, *open_ones):
            broken = self._at_odds(open_ones)
        said = tuple(law.said for law in broken)
        if broken and not self._ask(*all_laws):
            return Feasibility(said)
        # If no law is broken, the model of the last question keeps all conditions false.
        true = self._made_true(all_laws, open_ones) if broken else []
        decoded = self._encoder.measures.decode(self._solver.holds)
        assert not isinstance(decoded, list), "a model is accepted only if its order has room"
        values = [(name, decoded[name]) for name in _missing(failing, context, measures)]
        possible = (*((name, True) for name in true), *values)
        return Feasibility(said, () if broken else tuple(law.said for law in failing), possible)

    def _made_true(self, laws: Sequence[int], open_ones: Collection[int]) -> list[str]:
        """A minimal set of conditions that must be true for all of them to hold. The solver keeps the model."""
        false: list[int] = []
        for literal in sorted(open_ones, reverse=True):
            if self._ask(*laws, *false, literal):
                false.append(literal)
        self._ask(*laws, *false)
        return [name for variable, name in self._names.items() if -variable not in false]

    def _at_odds(self, assumed: Collection[int]) -> list[SituationLaw]:
        """A minimal set of assumptions and relations that cannot hold together."""
        needed = list(self._laws)
        for one in self._laws:
            without = [other for other in needed if other is not one]
            if not self._ask(*(literal for literal, _ in without), *assumed):
                needed = without
        return [law for _, law in needed]

    def _ask(self, *literals: int) -> bool:
        while True:
            answer = self._solver.solve([*self._given, *literals])
            if answer is None:
                raise Undecided(sentence("the solver reached its limit of conflicts"))
            refused = self._encoder.measures.refused(self._solver.holds) if answer else None
            if refused is None:
                return answer
            self._solver.add([refused])
