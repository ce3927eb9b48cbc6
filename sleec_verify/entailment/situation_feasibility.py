"""Whether a situation can be: what assumptions and relations make of what is given, and of what is not."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Assume, Context, Formula, Measure, Value
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.solver import MiniSat, Undecided
from sleec_verify.query.names import names_in

if TYPE_CHECKING:
    from sleec_runtime.model import Relation


class SituationLaw(NamedTuple):
    """An assumption or relation, what it says of one situation, and whether that is true if what is not given is false,
    as are comparisons with measures that have no value."""

    said: Assume | Relation
    formula: Formula
    holds: bool


class Feasibility(NamedTuple):
    """`broken` are laws by which the situation cannot be, whatever the measures are worth that are not given. Without
    any, `unsettled` are those that do not hold if all comparisons with these measures are false. `possible` are values
    of what is not given with which all laws hold, if there are any: measures of these laws, and, where some are broken,
    as few conditions as will do, which would have to be true."""

    broken: tuple[Assume | Relation, ...] = ()
    unsettled: tuple[Assume | Relation, ...] = ()
    possible: tuple[tuple[str, Value], ...] = ()


def check_feasibility(laws: Sequence[SituationLaw], context: Context, measures: Mapping[str, Measure]) -> Feasibility:
    """What `laws` say of a situation of which not all is given."""
    failing = [law for law in laws if not law.holds]
    if not failing:
        return Feasibility()
    try:
        return _Asked(laws, context, measures).check(context, measures)
    except Undecided:
        # What cannot be decided for all values is not said of any.
        return Feasibility(tuple(law.said for law in failing if not _missing([law], context, measures)))


def _missing(laws: Iterable[SituationLaw], context: Context, measures: Mapping[str, Measure]) -> list[str]:
    """The measures without a value that laws speak of."""
    names = (name for law in laws for _, name in names_in(law.formula))
    return [name for name in dict.fromkeys(names) if name in measures and name not in context.conditions]


class _Asked:
    """The laws as clauses, each of which may be let in, over the situation."""

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
        """What is broken or unsettled, and what would mend it."""
        all_laws = [literal for literal, _ in self._laws]
        failing = [law for _, law in self._laws if not law.holds]
        open_ones = {-variable for variable in self._names}
        broken = [law for literal, law in self._laws if not law.holds and not self._ask(literal, *open_ones)]
        if not broken and not self._ask(*all_laws, *open_ones):
            broken = self._at_odds(open_ones)
        said = tuple(law.said for law in broken)
        if broken and not self._ask(*all_laws):
            return Feasibility(said)
        # Without anything broken, the last question left all conditions as they are.
        true = self._made_true(all_laws, open_ones) if broken else []
        decoded = self._encoder.measures.decode(self._solver.holds)
        assert not isinstance(decoded, list), "a model is accepted only if its order has room"
        values = [(name, decoded[name]) for name in _missing(failing, context, measures)]
        possible = (*((name, True) for name in true), *values)
        return Feasibility(said, () if broken else tuple(law.said for law in failing), possible)

    def _made_true(self, laws: Sequence[int], open_ones: Collection[int]) -> list[str]:
        """A minimal set of conditions that have to be true for the laws to hold; the solver's model has them so."""
        false: list[int] = []
        for literal in sorted(open_ones, reverse=True):
            if self._ask(*laws, *false, literal):
                false.append(literal)
        self._ask(*laws, *false)
        return [name for variable, name in self._names.items() if -variable not in false]

    def _at_odds(self, assumed: Collection[int]) -> list[SituationLaw]:
        """A minimal set of laws that cannot hold together."""
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
                raise Undecided("the solver gave up after its budget of conflicts")
            refused = self._encoder.measures.refused(self._solver.holds) if answer else None
            if refused is None:
                return answer
            self._solver.add([refused])
