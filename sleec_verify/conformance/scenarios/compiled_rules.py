"""The rules and constraints as clauses (Equation 1), decided in single contexts by unit propagation.

What a scenario requires is decided here, and not with the evaluator of the runtime, which the robot under test runs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal

from sleec_runtime.model import (
    Atom,
    Context,
    Exclusive,
    Formula,
    Never,
    Obligation,
    Rule,
    Ruleset,
    Value,
    formulas_of,
    leaves,
    measures_of,
)
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.relations import exclusions
from sleec_verify.encoding.solver import MiniSat, Undecided
from sleec_verify.wording.sentence import sentence


class _Circuits:
    """Equivalent literals of a guard or a formula, and a solver that holds their clauses."""

    def __init__(self, encoder: Encoder, literals: list[int]) -> None:
        encoder.close()
        self._encoder = encoder
        self._literals = literals
        self._solver = MiniSat(encoder.clauses)

    def truths(self, context: Context) -> list[bool]:
        """The truth of each literal in a context."""
        answer = self._solver.solve(self._encoder.assumptions(context))
        assert answer, "equivalences have a model in every context"
        return [self._solver.holds(literal) for literal in self._literals]

    def allows(self, context: Context, obligations: Iterable[Obligation]) -> bool:
        """Whether some choice of the other obligations makes all literals true. Raises `Undecided`."""
        chosen = [
            -variable if one.negated else variable
            for one in obligations
            if (variable := self._encoder.variables.get(("obligation", one.name))) is not None
        ]
        answer = self._solver.solve([*self._encoder.assumptions(context), *self._literals, *chosen])
        if answer is None:
            raise Undecided(sentence("the solver reached its limit of conflicts"))
        return answer


class CompiledRules:
    """The rules, formulas and constraints of `ruleset`, each compiled at its first use."""

    def __init__(self, ruleset: Ruleset) -> None:
        self._ruleset = ruleset
        self._guards: dict[tuple[str, frozenset[str]], _Circuits] = {}
        self._formulas: dict[tuple[Formula, frozenset[str]], _Circuits] = {}
        self._constraints: dict[frozenset[str], _Circuits] = {}
        self._measures_of_rules = {rule.label: _measures(formulas_of(rule)) for rule in ruleset.rules}
        self._forbidding = [one for one in ruleset.constraints if isinstance(one, (Exclusive, Never))]
        self._measures_of_constraints = _measures(one.formula for one in self._forbidding if isinstance(one, Never))

    def clause(self, rule: Rule, context: Context) -> int | None:
        """The number of the clause that decides; None if the trigger does not occur or the guard is false."""
        key = rule.label, _unknown(self._measures_of_rules[rule.label], context.conditions)
        circuits = self._guards.get(key)
        if circuits is None:
            encoder = Encoder(self._ruleset.measures, key[1])
            circuits = self._guards[key] = _Circuits(encoder, encoder.guards(rule, self._ruleset.reading))
        return next((number for number, decides in enumerate(circuits.truths(context)) if decides), None)

    def holds(self, formula: Formula, context: Context) -> bool:
        """Whether a formula holds. Its triggers and obligations are events, which `context` gives."""
        key = formula, _unknown(_measures([formula]), context.conditions)
        circuits = self._formulas.get(key)
        if circuits is None:
            encoder = Encoder(self._ruleset.measures, key[1])

            def atom(one: Atom) -> int:
                kind: Literal["condition", "trigger"] = "condition" if one.kind == "condition" else "trigger"
                return encoder.variable((kind, one.name))

            circuits = self._formulas[key] = _Circuits(encoder, [encoder.literal(formula, atom)])
        return circuits.truths(context)[0]

    def conflict(self, literals: Iterable[Obligation], context: Context) -> bool:
        """Whether these literals, which are due, contradict each other or the constraints. Raises `Undecided`."""
        due = frozenset(literals)
        if any(Obligation(one.name, negated=True) in due for one in due if not one.negated):
            return True
        missing = _unknown(self._measures_of_constraints, context.conditions)
        circuits = self._constraints.get(missing)
        if circuits is None:
            circuits = self._constraints[missing] = self._of_constraints(missing)
        return not circuits.allows(context, due)

    def _of_constraints(self, missing: frozenset[str]) -> _Circuits:
        encoder = Encoder(self._ruleset.measures, missing)
        kept = []
        for constraint in self._forbidding:
            if isinstance(constraint, Never):
                kept.append(-encoder.literal(constraint.formula))
                continue
            for pair in exclusions(constraint):
                one, other = (encoder.obligation(Obligation(name)) for name in pair)
                encoder.clauses.append([-one, -other])
        return _Circuits(encoder, kept)


def _measures(formulas: Iterable[Formula]) -> frozenset[str]:
    return frozenset(
        name
        for formula in formulas
        for leaf in leaves(formula)
        if not isinstance(leaf, Atom)
        for name in measures_of(leaf)
    )


def _unknown(measures: frozenset[str], values: Mapping[str, Value]) -> frozenset[str]:
    return frozenset(name for name in measures if values.get(name) is None)
