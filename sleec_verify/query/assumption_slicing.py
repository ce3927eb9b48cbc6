"""Assumption slicing: the parts of assumptions that can matter if only some triggers occur.

If a situation with a trigger is possible, it is usually possible without it. ``NOT (Rung AND Asleep)`` only prevents
triggers, and ``NOT Rung OR Answered`` requires one only if another one occurs. So a question about a trigger stays a
question about its own rules, even if the assumptions that name it also name a hundred others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property

from sleec_runtime.model import And, Assume, Atom, Formula, Measure, Not, Or, Ruleset, Truth
from sleec_verify.encoding.equation import conjunction, disjunction
from sleec_verify.encoding.three_valued import is_true_in_empty_context
from sleec_verify.query.names import Name, names_in, names_of_constraint
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex


class AssumptionSlicing:
    """Assumptions that can be sliced for one question after the other.

    A trigger *may have to occur* with others if some assumption could be false without it, in a situation in which
    triggers occur only as necessary. Any other trigger can be removed from a possible situation: each assumption either
    holds whenever none of these triggers occurs, or does not require any of them. O(size of the assumptions) to create;
    a question costs O(size of its slice).
    """

    def __init__(self, assumed: Iterable[Formula], kept: Iterable[str], measures: Iterable[Measure] = ()) -> None:
        """No slice leaves out the triggers `kept`. The assumptions compare `measures`."""
        self._measures = tuple(measures)
        self.formulas = list(dict.fromkeys(conjuncts(assumed)))
        self._asked_for = [frozenset(_asked_for(formula, True)) for formula in self.formulas]
        self._naming: dict[Name, list[int]] = {}
        for at, formula in enumerate(self.formulas):
            for name in set(names_in(formula)):
                self._naming.setdefault(name, []).append(at)
        self.anywhere = self._grown(set(kept), list(range(len(self.formulas))))
        """The triggers that may have to occur in every question: those `kept`, and those that may have to occur
        without any other trigger."""

    def occurring_with(self, triggers: Iterable[str]) -> set[str]:
        """The triggers that may have to occur with these, including themselves and `anywhere`."""
        fresh = set(triggers) - self.anywhere
        return self._grown(self.anywhere | fresh, [at for name in fresh for at in self._naming_trigger(name)])

    def _grown(self, occurring: set[str], open_: list[int]) -> set[str]:
        while open_:
            at = open_.pop()
            fresh = self._asked_for[at] - occurring
            if fresh and without(self.formulas[at], occurring) != Truth(True):
                occurring |= fresh
                open_ += (other for name in fresh for other in self._naming_trigger(name))
        return occurring

    def _naming_trigger(self, name: str) -> list[int]:
        return self._naming.get(("trigger", name), [])

    def reached(
        self, triggers: Iterable[str], naming: Callable[[set[str]], Iterable[Name]]
    ) -> tuple[set[str], set[Name]]:
        """The triggers that may have to occur with `triggers`, and all names that the assumptions connect. `naming`
        gives the names in the rules of some triggers and in the constraints on these."""
        wanted = set(triggers) | self._always
        while True:
            may = self.occurring_with(wanted)
            wanted |= may - self.anywhere
            names: set[Name] = {("trigger", trigger) for trigger in wanted}
            names.update(naming(wanted))
            reached = {name for kind, name in names if kind == "trigger"}
            reached.update(
                name for formula in self.about(names, may) for kind, name in names_in(formula) if kind == "trigger"
            )
            if reached <= wanted:
                return wanted, names
            wanted |= reached

    @cached_property
    def _always(self) -> frozenset[str]:
        """Triggers of which at least one occurs in every situation."""
        cut = (Assume(without(formula, self.anywhere)) for formula in self.formulas)
        return _triggers_of_every_situation(RulesetIndex(Ruleset((*self._measures, *cut))))

    def about(self, names: Iterable[Name], occurring: set[str]) -> list[Formula]:
        """The assumptions that share names with `names`, directly or indirectly, if only these triggers occur."""
        found: dict[int, Formula] = {}
        open_ = list(names)
        seen = set(open_)
        while open_:
            name = open_.pop()
            for at in self._naming.get(name, ()):
                if at not in found:
                    cut = without(self.formulas[at], occurring)
                    own = set(names_in(cut))
                    if name in own:
                        found[at] = cut
                        open_ += own - seen
                        seen |= own
        return [found[at] for at in sorted(found)]

    def kept_by(self, names: Iterable[Name], occurring: set[str]) -> list[Formula]:
        """The same, with the assumptions that are false in the empty context: a situation that is shown must name
        something for these."""
        demanding = (name for formula in self._demanding for name in names_in(without(formula, occurring)))
        return self.about({*names, *demanding}, occurring)

    @cached_property
    def _demanding(self) -> list[Formula]:
        return [formula for formula in self.formulas if not is_true_in_empty_context(formula)]


def slicing_of(index: RulesetIndex) -> AssumptionSlicing:
    """The assumptions of a ruleset. No slice leaves out the triggers that constraints mention."""
    return index.once(_slicing)


def _slicing(index: RulesetIndex) -> AssumptionSlicing:
    forbidden = {name for c in index.constraints for kind, name in names_of_constraint(c) if kind == "trigger"}
    return AssumptionSlicing((one.formula for one in index.assumptions), forbidden, index.ruleset.measures.values())


def _triggers_of_every_situation(index: RulesetIndex) -> frozenset[str]:
    """The triggers of assumptions that are false if none of their triggers occurs: at least one of these occurs in
    every situation."""
    found: set[str] = set()
    seen: set[int] = set()
    for assumption in index.assumptions:
        if id(assumption) in seen:
            continue
        related = index.assumptions_about(names_in(assumption.formula)) or [assumption]
        seen.update(map(id, related))
        triggers = {name for a in related for kind, name in names_in(a.formula) if kind == "trigger"}
        if not triggers:
            continue
        with Question(index, assuming=False) as question:
            for other in related:
                question.require_formula(other.formula)
            for trigger in triggers:
                question.require(-question.encoder.variable(("trigger", trigger)))
            if not question.ask():
                found |= triggers
    return frozenset(found)


def conjuncts(formulas: Iterable[Formula]) -> Iterator[Formula]:
    """The conjuncts of formulas, so that each connects only its own names."""
    for formula in formulas:
        if isinstance(formula, And):
            yield from conjuncts(formula.operands)
        elif isinstance(formula, Not) and isinstance(formula.operand, Or):
            yield from conjuncts(Not(operand) for operand in formula.operand.operands)
        elif isinstance(formula, Not) and isinstance(formula.operand, Not):
            yield from conjuncts([formula.operand.operand])
        else:
            yield formula


def _asked_for(formula: Formula, positive: bool) -> Iterator[str]:
    """The triggers whose occurrence may make a formula true: those under an even number of negations."""
    if isinstance(formula, Atom):
        if positive and formula.kind == "trigger":
            yield formula.name
    elif isinstance(formula, Not):
        yield from _asked_for(formula.operand, not positive)
    elif isinstance(formula, (And, Or)):
        for operand in formula.operands:
            yield from _asked_for(operand, positive)


def without(formula: Formula, occurring: set[str]) -> Formula:
    """The formula if only these triggers occur, simplified."""
    if isinstance(formula, Atom):
        return Truth(False) if formula.kind == "trigger" and formula.name not in occurring else formula
    if isinstance(formula, Not):
        operand = without(formula.operand, occurring)
        return Truth(not operand.value) if isinstance(operand, Truth) else Not(operand)
    if isinstance(formula, (And, Or)):
        deciding = Truth(isinstance(formula, Or))
        operands = []
        for part in formula.operands:
            operand = without(part, occurring)
            if operand == deciding:
                return deciding
            if not isinstance(operand, Truth):
                operands.append(operand)
        if not operands:
            return Truth(not deciding.value)
        return disjunction(operands) if deciding.value else conjunction(operands)
    return formula
