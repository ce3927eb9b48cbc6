"""Definition 1 of the paper: the literals that Equation 1 entails in one context.

With a total context, and each response a conjunction of literals, unit propagation alone decides it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from sleec_runtime.model import Context, Formula, Obligation, Rule, Ruleset
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.solver import MiniSat


class Definition1:
    """Equation 1 of some rules, encoded once for any number of contexts.

    Each of `formulas` gets a literal, whose truth can be asked, too. `missing` are measures without a value:
    comparisons with them are false.
    """

    def __init__(
        self,
        ruleset: Ruleset,
        rules: Sequence[Rule] | None = None,
        formulas: Sequence[Formula] = (),
        missing: frozenset[str] = frozenset(),
    ) -> None:
        encoder = self._encoder = Encoder(ruleset.measures, missing)
        self._in_force = encoder.fresh()
        encoded = ruleset.rules if rules is None else rules
        self.guards = [(rule, encoder.guards(rule, ruleset.reading)) for rule in encoded]
        for rule, guards in self.guards:
            for clause, guard in zip(rule.clauses(), guards):
                for obligation in clause.obligations:
                    encoder.clauses.append([-self._in_force, -guard, encoder.obligation(obligation)])
        self.formulas = [encoder.literal(formula) for formula in formulas]
        encoder.close()
        self._solver = MiniSat(encoder.clauses)
        self._obligations = {v: key[1] for key, v in encoder.variables.items() if key[0] == "obligation"}

    def entailed(self, context: Context) -> frozenset[Obligation] | None:
        """Every literal over O that Definition 1 entails in `context`, or None if the rules are inconsistent there.
        Needs one unit propagation."""
        consistent, literals = self._solver.propagate([self._in_force, *self._encoder.assumptions(context)])
        if not consistent:
            return None
        named = self._obligations
        return frozenset(Obligation(named[abs(v)], v < 0) for v in literals if abs(v) in named)

    def entails(self, context: Context, obligation: Obligation) -> bool | None:
        """Whether Definition 1 entails one literal in `context`: no model of the rules and the context makes it
        false. This is literal: if the rules are inconsistent there, everything is entailed. None if undecided."""
        variable = self._encoder.variables.get(("obligation", obligation.name))
        refuted = [] if variable is None else [variable if obligation.negated else -variable]
        answer = self._solver.solve([self._in_force, *self._encoder.assumptions(context), *refuted])
        return None if answer is None else not answer

    def facts(self, context: Context) -> Callable[[int], bool]:
        """The truth, in `context`, of the literals in `guards` and `formulas`, until the next question."""
        found = self._solver.solve([-self._in_force, *self._encoder.assumptions(context)])
        assert found, "without the rules in force, every context is a model"
        return self._solver.holds
