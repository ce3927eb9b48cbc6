"""The indices of a ruleset for queries over all contexts, each created once, in time linear in the ruleset."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import NamedTuple, NewType

from sleec_runtime.model import (
    RELATIONS,
    Assume,
    Atom,
    Clause,
    Context,
    DeclaredKind,
    Exclusive,
    Never,
    Obligation,
    Ruleset,
    formulas_of,
    leaves,
)
from sleec_verify.encoding.name_uses import names_used
from sleec_verify.encoding.solver import Recorder
from sleec_verify.encoding.three_valued import is_true_in_empty_context
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.query.memo import Memo
from sleec_verify.query.names import Name, names_in, names_of_constraint, obligations_in


class ClausePosition(NamedTuple):
    """Clause `number` of the rule at `rule` in `Ruleset.rules`."""

    rule: int
    number: int


class RulesetIndex(Memo):
    """The indices of one ruleset, and the answers of queries about it as a whole."""

    def __init__(
        self, ruleset: Ruleset, recorder: Recorder | None = None, untimed: Untimed = "at", chains: bool = True
    ) -> None:
        """`recorder` gets every question about the ruleset. `untimed` is the meaning of a response without a window
        in rules with time. With `chains`, an obligation triggers the rules of that name."""
        super().__init__()
        self.ruleset = ruleset
        self.rules = ruleset.rules
        self.recorder = recorder
        self.untimed = untimed
        self.chains = chains

    @cached_property
    def clauses(self) -> list[tuple[Clause, ...]]:
        """The clauses of each rule, by the rule's position."""
        return [tuple(rule.clauses()) for rule in self.rules]

    def labelled(self) -> Iterator[tuple[str, int]]:
        """The label of each rule, with its position."""
        return ((rule.label, position) for position, rule in enumerate(self.rules))

    @cached_property
    def names_used(self) -> Mapping[DeclaredKind, set[str]]:
        """The names that rules and constraints use, by kind."""
        return names_used(self.ruleset)

    @cached_property
    def by_trigger(self) -> dict[str, list[int]]:
        """The positions of the rules of each trigger."""
        index: dict[str, list[int]] = {}
        for position, rule in enumerate(self.rules):
            index.setdefault(rule.trigger, []).append(position)
        return index

    @cached_property
    def by_obligation(self) -> dict[Obligation, list[ClausePosition]]:
        """The clauses that oblige each literal."""
        index: dict[Obligation, list[ClausePosition]] = {}
        for position, clauses in enumerate(self.clauses):
            for number, clause in enumerate(clauses):
                for obligation in clause.obligations:
                    index.setdefault(obligation, []).append(ClausePosition(position, number))
        return index

    @cached_property
    def assumptions(self) -> list[Assume]:
        return [c for c in self.ruleset.constraints if isinstance(c, Assume)]

    @cached_property
    def constraints(self) -> list[Exclusive | Never]:
        return [c for c in self.ruleset.constraints if not isinstance(c, Assume)]

    @cached_property
    def _constraints_by_obligation(self) -> dict[str, list[int]]:
        index: dict[str, list[int]] = {}
        for position, constraint in enumerate(self.constraints):
            for name in set(obligations_in(constraint)):
                index.setdefault(name, []).append(position)
        return index

    def constraints_about(self, obligations: Iterable[str]) -> list[Exclusive | Never]:
        """The constraints that share obligations with these names, directly or indirectly, in the order of the text."""
        found: set[int] = set()
        seen = set(obligations)
        open_names = list(seen)
        while open_names:
            for position in self._constraints_by_obligation.get(open_names.pop(), ()):
                if position not in found:
                    found.add(position)
                    fresh = set(obligations_in(self.constraints[position])) - seen
                    seen |= fresh
                    open_names += fresh
        return [self.constraints[position] for position in sorted(found)]

    @cached_property
    def _assumptions_by_name(self) -> dict[Name, list[int]]:
        index: dict[Name, list[int]] = {}
        for position, assumption in enumerate(self.assumptions):
            for name in set(names_in(assumption.formula)):
                index.setdefault(name, []).append(position)
        return index

    def assumptions_about(self, names: Iterable[Name]) -> list[Assume]:
        """The assumptions that share names with `names`, directly or indirectly, in the order of the text."""
        if not self.assumptions:
            return []
        found: set[int] = set()
        open_names = set(names)
        seen = set(open_names)
        while open_names:
            for position in self._assumptions_by_name.get(open_names.pop(), ()):
                if position not in found:
                    found.add(position)
                    for name in names_in(self.assumptions[position].formula):
                        if name not in seen:
                            seen.add(name)
                            open_names.add(name)
        return [self.assumptions[position] for position in sorted(found)]

    @cached_property
    def demanding(self) -> list[Assume]:
        """The assumptions that are false in the empty context."""
        return [a for a in self.assumptions if not is_true_in_empty_context(a.formula)]

    def assumptions_that_may_break(self, context: Context) -> list[Assume]:
        """All assumptions that `context` can violate. Any other assumption has the same value as in the empty
        context, because it names nothing in `context`."""
        names = [
            *(("trigger", name) for name in context.triggers),
            *(("condition", name) for name in context.conditions),
        ]
        positions = {position for name in names for position in self._assumptions_by_name.get(name, ())}
        return [*self.demanding, *(self.assumptions[position] for position in sorted(positions))]

    @cached_property
    def names_triggers(self) -> bool:
        """Whether an assumption, a guard or a hedge names a trigger."""
        conditions = (formula for rule in self.rules for formula in formulas_of(rule))
        return any(kind == "trigger" for kind, _ in self._assumptions_by_name) or any(
            isinstance(leaf, Atom) and leaf.kind == "trigger" for formula in conditions for leaf in leaves(formula)
        )

    @cached_property
    def constrains_triggers(self) -> bool:
        return any(kind == "trigger" for constraint in self.constraints for kind, _ in names_of_constraint(constraint))


InstantIndex = NewType("InstantIndex", RulesetIndex)
"""The index of a ruleset that is about single instants: all responses are due at their trigger, without a window or an
alternative, and no relation connects instants. Only such rulesets have the conflicts of Definition 1."""


def instant_index(index: RulesetIndex) -> InstantIndex:
    """The same index, once it is shown that its ruleset is about single instants. Linear in the ruleset.

    Raises:
        ValueError: the ruleset is about more than single instants.
    """
    timed = (o for clauses in index.clauses for clause in clauses for o in clause.obligations if o.timing is not None)
    for obligation in timed:
        raise ValueError(f"the response {obligation} has a window or an alternative")
    for statement in index.ruleset.statements:
        if isinstance(statement, RELATIONS):
            raise ValueError("a relation connects instants")
    return InstantIndex(index)
