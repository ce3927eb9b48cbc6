"""Equation 1 as clauses, linear in the size of the rules.

Equation 1 (paper, Section 3.2) repeats every prefix C0 ∧ … ∧ Ci. Here each prefix is one variable, equivalent to the
previous prefix and one more condition. So a rule with n hedges gives O(n) clauses. Every auxiliary variable is
*equivalent* to what it stands for. So if triggers and conditions have values, unit propagation gives values to all
variables (Definition 1 in a total context needs no search).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from sleec_runtime.model import (
    And,
    Atom,
    Clause,
    Comparison,
    Context,
    Formula,
    Measure,
    Not,
    Obligation,
    Or,
    Reading,
    Rule,
    Truth,
    measures_of,
)
from sleec_verify.encoding.measures import Measures

Key = tuple[str, ...]
"""The meaning of a variable: ``("trigger", name)``, ``("condition", name)``, ``("obligation", name)``, ``("below",
measure, cut)`` or ``("at-most", measure, measure)``."""


class Encoder:
    """Clauses for rules and formulas, with variables numbered from 1 in the order of their first use.

    Call `close` at the end: it adds the order of the measures' regions.
    """

    def __init__(
        self,
        measures: Mapping[str, Measure],
        missing: frozenset[str] = frozenset(),
        clauses: list[list[int]] | None = None,
    ) -> None:
        """`missing` are measures without a value: comparisons with them are false. `clauses` receives the clauses,
        so that several encoders can build one formula."""
        self._missing = missing
        self.described: dict[int, tuple[str, str]] = {}
        """The meaning of auxiliary literals: ``("prefix", "label.i")`` is C0 ∧ … ∧ Ci, ``("guard", "label.i")`` the
        guard of clause i (``label.i.j`` in a chain nested in clause i)."""
        self.clauses: list[list[int]] = [] if clauses is None else clauses
        self.variables: dict[Key, int] = {}
        self.top = 0
        self._true = 0
        self.measures = Measures(measures, self.true, self.variable, self.clauses.append, self.both)

    # Variables ---------------------------------------------------------------------------------------------

    def fresh(self) -> int:
        """A new auxiliary variable."""
        self.top += 1
        return self.top

    def variable(self, key: Key) -> int:
        variable = self.variables.get(key)
        if variable is None:
            variable = self.variables[key] = self.fresh()
        return variable

    def true(self) -> int:
        """The literal that is always true."""
        if not self._true:
            self._true = self.fresh()
            self.clauses.append([self._true])
        return self._true

    def obligation(self, literal: Obligation) -> int:
        """The literal of "it is done" (or, negated, of "it is not done")."""
        variable = self.variable(("obligation", literal.name))
        return -variable if literal.negated else variable

    # Formulas ----------------------------------------------------------------------------------------------

    def both(self, a: int, b: int) -> int:
        """A literal that is equivalent to ``a ∧ b``."""
        true = self._true
        if a == b or b == true:
            return a
        if a == true:
            return b
        if true and (a == -true or b == -true):
            return -true
        if a == -b:
            return -self.true()
        both = self.fresh()
        self.clauses += ([-both, a], [-both, b], [both, -a, -b])
        return both

    def all_of(self, literals: Sequence[int]) -> int:
        """A literal that is equivalent to the conjunction of any number of literals."""
        if not literals:
            return self.true()
        if len(literals) <= 2:
            return self.both(literals[0], literals[-1])
        every = self.fresh()
        self.clauses += ([-every, literal] for literal in literals)
        self.clauses.append([every, *(-literal for literal in literals)])
        return every

    def any_of(self, literals: Sequence[int]) -> int:
        """A literal that is equivalent to the disjunction of any number of literals."""
        return -self.all_of([-literal for literal in literals])

    def at_least_two(self, literals: Sequence[int]) -> int:
        """A literal that is equivalent to "two of these are true", with a variable for "one of those so far".
        Linear."""
        repeated = []
        so_far = -self.true()
        for literal in literals:
            repeated.append(self.both(so_far, literal))
            so_far = self.any_of([so_far, literal])
        return self.any_of(repeated)

    def literal(self, formula: Formula, atom: Callable[[Atom], int] | None = None) -> int:
        """A literal that is equivalent to the formula. `atom` gives the literals of atoms, by default their
        variables. O(size of the formula)."""
        if isinstance(formula, Atom):
            return self.variable((formula.kind, formula.name)) if atom is None else atom(formula)
        if isinstance(formula, Not):
            return -self.literal(formula.operand, atom)
        if isinstance(formula, And):
            return self.all_of([self.literal(operand, atom) for operand in formula.operands])
        if isinstance(formula, Or):
            return self.any_of([self.literal(operand, atom) for operand in formula.operands])
        if isinstance(formula, Comparison):
            if self._missing and not self._missing.isdisjoint(measures_of(formula)):
                return -self.true()
            return self.measures.literal(formula)
        assert isinstance(formula, Truth)
        return self.true() if formula.value else -self.true()

    # Rules -------------------------------------------------------------------------------------------------

    def triggered(self, rule: Rule) -> int:
        """A literal that is equivalent to "the rule's trigger occurs and its guard, if any, holds"."""
        trigger = self.variable(("trigger", rule.trigger))
        return trigger if rule.guard is None else self.both(trigger, self.literal(rule.guard))

    def guards(self, rule: Rule, reading: Reading, triggered: int | None = None) -> list[int]:
        """For each clause of the rule, in the order of `Rule.clauses`, a literal that is equivalent to its guard.
        `triggered` replaces the rule's trigger, if given."""
        if triggered is None:
            triggered = self.triggered(rule)
        elif rule.guard is not None:
            triggered = self.both(triggered, self.literal(rule.guard))
        guards: list[int] = []
        decides = self._split(triggered, rule.hedges, reading, rule.label)
        for number, (clause, literal) in enumerate(zip((rule.default, *rule.hedges), decides)):
            self._descend(literal, clause, reading, guards, f"{rule.label}.{number}" if clause.hedges else "")
        return guards

    def chain(self, clause: Clause, reading: Reading) -> list[int]:
        """For each clause of a separate chain (of an alternative response), in the order of `in_text_order`, a
        literal that is equivalent to "this clause decides"."""
        guards: list[int] = []
        self._descend(self.true(), clause, reading, guards, "")
        return guards

    def _descend(self, decides: int, clause: Clause, reading: Reading, guards: list[int], path: str) -> None:
        """Append the guards of a clause that decides in its own chain if `decides`, and of its nested chain."""
        if not clause.hedges:
            guards.append(decides)
            return
        first, *rest = self._split(decides, clause.hedges, reading, path)
        guards.append(first)
        for number, (nested, literal) in enumerate(zip(clause.hedges, rest), 1):
            self._descend(literal, nested, reading, guards, f"{path}.{number}")

    def _split(self, active: int, hedges: Sequence[Clause], reading: Reading, path: str) -> list[int]:
        """Which member of a chain decides if `active`: a literal for the default, then one for each hedge."""
        conditions = [self.literal(hedge.condition) for hedge in hedges if hedge.condition is not None]
        if reading == "priority":
            # The cascade of Ci ∨ C(i+1) ∨ … ∨ Cn is the priority chain of the Ci.
            for i in reversed(range(len(conditions) - 1)):
                conditions[i] = self.any_of([conditions[i], conditions[i + 1]])
        decides, prefix = [], active
        for number, condition in enumerate(conditions):
            guard = self.both(prefix, -condition)
            decides.append(guard)
            prefix = self.both(prefix, condition)
            self.described.setdefault(guard, ("guard", f"{path}.{number}"))
            self.described.setdefault(prefix, ("prefix", f"{path}.{number + 1}"))
        decides.append(prefix)
        return decides

    def due(self, clauses: Iterable[tuple[Clause, int]]) -> dict[Obligation, int]:
        """For each literal that some of these clauses oblige, a literal that is equivalent to "one of them is active".

        `clauses` are pairs of a clause and the literal of its guard.
        """
        by_literal: dict[Obligation, list[int]] = {}
        for clause, guard in clauses:
            for obligation in clause.obligations:
                by_literal.setdefault(obligation, []).append(guard)
        return {obligation: self.any_of(guards) for obligation, guards in by_literal.items()}

    def close(self) -> None:
        """Add the order of the measures' regions. The formula is complete after this."""
        self.measures.close()

    # Contexts ----------------------------------------------------------------------------------------------

    def assumptions(self, context: Context) -> list[int]:
        """The context as literals, total over the triggers and conditions in the formula (those that the context
        does not contain are false) and over the measures with a value in the context."""
        literals = []
        for (kind, *names), variable in self.variables.items():
            if kind == "trigger":
                literals.append(variable if names[0] in context.triggers else -variable)
            elif kind == "condition":
                literals.append(variable if context.conditions.get(names[0]) is True else -variable)
        values = {n: v for n, v in context.conditions.items() if not isinstance(v, bool)}
        literals += self.measures.assumptions(values)
        return literals
