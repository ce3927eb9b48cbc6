"""All situations that the assumptions allow and that do not conflict, as one question to the solver."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from sleec_runtime.model import Assume, Context, Formula, Never, formulas_of, names_of
from sleec_verify.query.inconsistent_sets import opposite
from sleec_verify.query.prime_implicates import inconsistent_sets
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex


class Goal(NamedTuple):
    """Something that a situation can cover: it does if `literal` is true. It needs `trigger` to occur."""

    name: str
    trigger: str
    literal: int


class AllowedSituations:
    """The question, with the rules of one domain. With `single`, no two triggers occur at once. With `peaceful`
    False, situations in which the rules conflict are allowed, too."""

    def __init__(self, index: RulesetIndex, single: bool = False, peaceful: bool = True) -> None:
        self.index = index
        self.question = Question(index)
        self.encoder = self.question.encoder
        self._guards = [self.question.guards(position) for position in range(len(index.rules))]
        # Including those that share no name with a rule: a situation must satisfy every one.
        for assumption in index.assumptions:
            self.question.require_formula(assumption.formula)
        if peaceful:
            self._forbid_conflicts()
        if single:
            self._at_most_one([self.trigger(name) for name in sorted(index.ruleset.triggers)])

    def guards(self, position: int) -> list[int]:
        """The literals of the guards of one rule's clauses."""
        return self._guards[position]

    def trigger(self, name: str) -> int:
        return self.encoder.variable(("trigger", name))

    def literal(self, formula: Formula) -> int:
        return self.encoder.literal(formula)

    def reaches(self, *literals: int) -> bool:
        """Whether some situation makes all of these true. Raises `Undecided`."""
        return self.question.ask(*literals)

    def _forbid_conflicts(self) -> None:
        due = self.encoder.due(
            pair for clauses, guards in zip(self.index.clauses, self._guards) for pair in zip(clauses, guards)
        )
        for obligation, literal in due.items():
            if not obligation.negated and opposite(obligation) in due:
                self.question.require(-literal, -due[opposite(obligation)])
        declared = inconsistent_sets(self.index.constraints, due)
        for exclusion in declared.exclusions:
            self._at_most_one([due[obligation] for obligation in exclusion.literals])
        for clash in declared.listed:
            if all(obligation in due for obligation in clash.literals):
                labels = [-self.literal(label) for label in clash.labels]
                self.question.require(*(-due[obligation] for obligation in clash.literals), *labels)

    def _at_most_one(self, literals: Sequence[int]) -> None:
        """By a ladder encoding: one variable for "one of those so far", which excludes the next."""
        before: int | None = None
        for literal in literals:
            so_far = self.encoder.fresh()
            self.question.require(-literal, so_far)
            if before is not None:
                self.question.require(-before, so_far)
                self.question.require(-before, -literal)
            before = so_far

    def smallest(self, literals: Sequence[int]) -> Context:
        """A situation that makes `literals` true, with a minimal set of triggers and true conditions. It values all
        names in the rules of its triggers, and in the constraints."""
        kept = list(literals)
        assert self.reaches(*kept), "asked for what was found to be reachable"
        found = self.question.situation()
        for kind, names in (("trigger", found.triggers), ("condition", found.conditions)):
            for name in sorted(names):
                variable = self.encoder.variables.get((kind, name))
                if variable is None or not self.question.true(variable):
                    continue
                if self.reaches(*kept, -variable):
                    kept.append(-variable)
                else:
                    kept.append(variable)
                    self.reaches(*kept)
        self.reaches(*kept)
        return self._trimmed(self.question.situation())

    def _trimmed(self, found: Context) -> Context:
        positions = [p for name in found.triggers for p in self.index.by_trigger.get(name, ())]
        looked_at = {n for p in positions for formula in formulas_of(self.index.rules[p]) for n in names_of(formula)}
        formulas = (c.formula for c in self.index.ruleset.constraints if isinstance(c, (Assume, Never)))
        constrained = {name for formula in formulas for name in names_of(formula)}
        return Context(
            found.triggers,
            {
                n: v
                for n, v in sorted(found.conditions.items())
                if n in looked_at or (n in constrained and v is not False)
            },
        )
