"""The possible situations of some formulas."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sleec_runtime.model import Assume, Atom, Calculation, Comparison, Formula, Ruleset, leaves, measures_of
from sleec_verify.changes.diagram.decision_diagram import TooLarge
from sleec_verify.changes.diagram.formulas import FormulaDiagram
from sleec_verify.decision_tables.paths import MOST_STATES, Path, Paths, most_rows
from sleec_verify.wording.sentence import sentence


class Situations:
    """The diagram of some formulas. `possible` is its node of the situations in which the trigger occurs and the
    assumptions hold, described by the names of the formulas alone. `why` says why the assumptions are not used."""

    def __init__(self, ruleset: Ruleset, trigger: str, formulas: Sequence[Formula]) -> None:
        """Raises `TooLarge`."""
        if any(map(_calculates, formulas)):
            raise TooLarge(sentence("it depends on a calculation with several measures"))
        assumed = [formula for formula in assumptions(ruleset) if not _calculates(formula)]
        self.why: str | None = None
        self._most = most_rows(len(ruleset.rules))
        try:
            self._build(ruleset, trigger, formulas, _related(formulas, assumed))
        except TooLarge as error:
            self._build(ruleset, trigger, formulas, [])
            self.why = sentence("the assumptions are not used: {why}", why=error.args[0])

    def _build(self, ruleset: Ruleset, trigger: str, formulas: Sequence[Formula], assumed: Sequence[Formula]) -> None:
        occurs = Atom("trigger", trigger)
        self.diagram = FormulaDiagram([occurs, *formulas, *assumed], ruleset.measures, MOST_STATES)
        possible = self.diagram.node(occurs)
        for formula in assumed:
            possible = self.diagram.both(possible, self.diagram.node(formula))
        kept = (self.diagram.support(self.diagram.node(one)) for one in (occurs, *formulas))
        self.possible = self.diagram.some(possible, set().union(*kept))

    def paths(self, shown: int, formulas: Sequence[Formula]) -> tuple[list[Path], int]:
        """The first paths of the possible situations in the node `shown`, and the number of all."""
        nodes = (self.diagram.node(one) for one in formulas)
        return Paths(self.diagram, self._most).below((self.possible, shown, *nodes))


def assumptions(ruleset: Ruleset) -> list[Formula]:
    """What holds in every situation: the assumptions, and the relations within one situation."""
    assumed = [one.formula for one in ruleset.constraints if isinstance(one, Assume)]
    if not ruleset.is_timed:
        return assumed
    from sleec_verify.encoding.relations import relations_on_situations

    return [*assumed, *(formula for _, formula in relations_on_situations(ruleset))]


def _related(formulas: Iterable[Formula], assumed: Sequence[Formula]) -> list[Formula]:
    """The assumptions that share names with the formulas, also through each other."""
    names = {name for formula in formulas for name in _names(formula)}
    left = list(assumed)
    found: list[Formula] = []
    while True:
        near = [formula for formula in left if not names.isdisjoint(_names(formula))]
        if not near:
            return found
        found += near
        left = [formula for formula in left if formula not in near]
        names.update(name for formula in near for name in _names(formula))


def _names(formula: Formula) -> set[str]:
    return {
        name for leaf in leaves(formula) for name in ((leaf.name,) if isinstance(leaf, Atom) else measures_of(leaf))
    }


def _calculates(formula: Formula) -> bool:
    return any(isinstance(leaf, Comparison) and isinstance(leaf.left, Calculation) for leaf in leaves(formula))
