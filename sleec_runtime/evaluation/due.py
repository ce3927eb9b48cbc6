"""What the rules oblige in a context, and which assumptions the context breaks."""

from __future__ import annotations

from dataclasses import dataclass

from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.evaluation.hedge_chain import Decision, decide
from sleec_runtime.model import Assume, Context, Obligation, Ruleset


@dataclass(frozen=True, slots=True)
class Due:
    """What the rules oblige in a context: a decision for each rule that applies, in rule order."""

    decisions: tuple[Decision, ...]

    @property
    def literals(self) -> tuple[Obligation, ...]:
        """Every literal that is due, once, in the order of rules and clauses."""
        return tuple(dict.fromkeys(literal for decision in self.decisions for literal in decision.obligations))

    @property
    def obligations(self) -> tuple[str, ...]:
        """The names of the obligations."""
        return tuple(literal.name for literal in self.literals if not literal.negated)

    @property
    def prohibitions(self) -> tuple[str, ...]:
        """The names of the prohibitions."""
        return tuple(literal.name for literal in self.literals if literal.negated)


def due(ruleset: Ruleset, context: Context) -> Due:
    """What the rules oblige in `context`, in the reading of the ruleset and the closed world (Definition 1).

    In a context that conflicts, Definition 1 entails everything; check with `evaluation.conflicts.conflict`. O(size of
    the rules).
    """
    decisions = (decide(rule, context, ruleset.reading, ruleset.measures) for rule in ruleset.rules)
    return Due(tuple(decision for decision in decisions if decision is not None))


def broken_assumptions(ruleset: Ruleset, context: Context) -> tuple[Assume, ...]:
    """The assumptions that `context` breaks. The rules exclude such a context."""
    return tuple(
        constraint
        for constraint in ruleset.constraints
        if isinstance(constraint, Assume) and not holds(constraint.formula, context, ruleset.measures)
    )
