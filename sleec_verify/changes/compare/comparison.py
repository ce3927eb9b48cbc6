"""Two rulesets in one domain, as formulas over the situations that both allow.

A question about a rule concerns the rules whose triggers are in the cone of its trigger. No other trigger needs to
occur. If a trigger does not occur, its rules oblige nothing and conflict with nothing. So every difference appears in a
situation without other triggers, and the search covers only these situations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from typing import Literal, NamedTuple

from sleec_runtime.model import (
    Assume,
    Context,
    Exclusive,
    Formula,
    Measure,
    Never,
    Not,
    Obligation,
    Rule,
    Ruleset,
    Truth,
)
from sleec_verify.changes.compare.alternatives import plain_responses
from sleec_verify.changes.compare.measured_windows import implied_where
from sleec_verify.changes.compare.rule_alignment import RulePair, align, depends_on_reading
from sleec_verify.changes.compare.sides import RulesetSide, common, compares_any, side
from sleec_verify.encoding.equation import Implication, conjunction, disjunction, implications
from sleec_verify.encoding.measure_ranges import MeasureRanges
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.encoding.window_lengths import measures_of_lengths
from sleec_verify.query.assumption_slicing import AssumptionSlicing
from sleec_verify.query.inconsistent_sets import InconsistentSet, opposite
from sleec_verify.query.names import Name, names_in, names_of_rule
from sleec_verify.query.prime_implicates import constraints_on_situations, inconsistent_sets
from sleec_verify.query.ruleset_index import RulesetIndex

SideName = Literal["old", "new"]
SIDES: tuple[SideName, SideName] = ("old", "new")


def other(which: SideName) -> SideName:
    return "new" if which == "old" else "old"


class AlignedRule(NamedTuple):
    """A rule on one side, or one that is equal on both."""

    old: Rule | None
    new: Rule | None

    def on(self, which: SideName) -> Rule | None:
        return self.old if which == "old" else self.new


class TriggerCone(NamedTuple):
    """The rows that may have to be active if some triggers occur, and the relevant assumptions, restricted to
    situations without the triggers of other rows."""

    rows: list[int]
    assumed: RulesetIndex

    def in_force(self, formula: Formula) -> list[Formula]:
        """The assumptions that share names with a formula, directly or indirectly."""
        return [assumption.formula for assumption in self.assumed.assumptions_about(names_in(formula))]


class Comparison:
    """The aligned rules of both sides, with the formulas for due, contradictory and possible."""

    def __init__(self, old: Ruleset, new: Ruleset, untimed: Untimed) -> None:
        self.untimed = untimed
        self.vocabulary = common(old, new)
        self.sides: dict[SideName, RulesetSide] = {"old": side(old, self.vocabulary), "new": side(new, self.vocabulary)}
        same_reading, scales = old.reading == new.reading, self.vocabulary.scales

        def cancels(rule: Rule) -> bool:
            if not same_reading and depends_on_reading(rule):
                return False
            return not (scales and compares_any(rule, scales))

        self.aligned = align(old.rules, new.rules, cancels)
        self.rows = [AlignedRule(one, other) for one, other in self.aligned.same]
        self.changed: list[tuple[RulePair, dict[SideName, int]]] = []
        for pair in self.aligned.changed:
            places: dict[SideName, int] = {}
            for which, rule in (("old", pair.old), ("new", pair.new)):
                if rule is not None:
                    places["old" if which == "old" else "new"] = len(self.rows)
                    self.rows.append(AlignedRule(rule, None) if which == "old" else AlignedRule(None, rule))
            self.changed.append((pair, places))
        self._guards: dict[tuple[int, SideName], list[Implication]] = {}
        self._said: dict[tuple[int, SideName], list[tuple[Formula, Obligation]]] = {}
        self._cone_of: dict[frozenset[str], TriggerCone] = {}
        self._conflicts: dict[tuple[SideName, tuple[int, ...]], Formula] = {}
        given = [one.formula for which in SIDES for one in self.sides[which].given]
        self.index = self._index([self._plain(row) for row in self.rows], given)

    def _plain(self, row: AlignedRule) -> Rule:
        which: SideName = "new" if row.new is not None else "old"
        rule = row.on(which)
        assert rule is not None
        return self.sides[which].plain(rule)

    def _index(self, rules: Iterable[Rule], given: Iterable[Formula]) -> RulesetIndex:
        assumed = [Assume(formula) for formula in dict.fromkeys(given)]
        return RulesetIndex(Ruleset((*self.vocabulary.measures.values(), *assumed, *rules)))

    @property
    def measures(self) -> dict[str, Measure]:
        return self.vocabulary.measures

    def situations_of(self, which: SideName) -> RulesetIndex:
        """The assumptions of one side."""
        return self._situations[which]

    @cached_property
    def _situations(self) -> dict[SideName, RulesetIndex]:
        return {which: self._index((), [one.formula for one in self.sides[which].given]) for which in SIDES}

    @cached_property
    def _slicing_of(self) -> dict[SideName, AssumptionSlicing]:
        return {which: AssumptionSlicing([one.formula for one in self.sides[which].given], ()) for which in SIDES}

    def situations_about(self, which: SideName, formula: Formula) -> RulesetIndex:
        """The assumptions of one side that can affect the formula, if no unnecessary trigger occurs."""
        slicing, named = self._slicing_of[which], set(names_in(formula))
        return self._index(
            (), slicing.kept_by(named, slicing.occurring_with(name for kind, name in named if kind == "trigger"))
        )

    @cached_property
    def _constraints(self) -> dict[SideName, RulesetIndex]:
        return {which: RulesetIndex(Ruleset(tuple(self.sides[which].constraints))) for which in SIDES}

    def constraints_about(self, which: SideName, names: Iterable[str]) -> list[Exclusive | Never]:
        """The constraints that may conflict with these obligations, and those that exclude a situation by
        themselves. Raises `Undecided` if the constraints are too entangled."""
        index = self._constraints[which]
        return list(dict.fromkeys((*index.constraints_about(names), *constraints_on_situations(index))))

    # The cone ----------------------------------------------------------------------------------------------

    def cone(self, triggers: Iterable[str]) -> TriggerCone:
        """The cone of these triggers: through assumptions, or through constraints on obligations that name another
        trigger."""
        given = frozenset(triggers)
        found = self._cone_of.get(given)
        if found is None:
            found = self._cone_of[given] = self._cone(given)
        return found

    def _cone(self, given: frozenset[str]) -> TriggerCone:
        wanted, names = self._slicing.reached(given, self._named_at)
        # The shown situation also satisfies the other assumptions, which need no other trigger.
        return TriggerCone(self.rows_of(wanted), self._index((), self._slicing.kept_by(names, wanted)))

    def _named_at(self, triggers: set[str]) -> Iterator[Name]:
        """The names in the rules of these triggers, and in the constraints on them."""
        rows = self.rows_of(triggers)
        for row in rows:
            rule = self._plain(self.rows[row])
            yield from names_of_rule(rule)
            yield from (("condition", name) for clause in rule.clauses() for name in measures_of_lengths(clause))
        for constraint in self._constraints_on(rows):
            yield from names_in(constraint.formula)

    def rows_of(self, triggers: Iterable[str]) -> list[int]:
        """The rows of these triggers, in the order of the text."""
        return sorted(row for trigger in triggers for row in self.index.by_trigger.get(trigger, ()))

    @cached_property
    def _slicing(self) -> AssumptionSlicing:
        assumed = (one.formula for one in self.index.assumptions)
        return AssumptionSlicing(assumed, self._triggers_forbidden, self.vocabulary.measures.values())

    @cached_property
    def _triggers_forbidden(self) -> set[str]:
        """The triggers in constraints. Without one of these, a conflict may appear."""
        return {
            name
            for which in SIDES
            for constraint in self.sides[which].constraints
            if isinstance(constraint, Never)
            for kind, name in names_in(constraint.formula)
            if kind == "trigger"
        }

    def _constraints_on(self, rows: Iterable[int]) -> list[Never]:
        """The constraints that also name situations, and may forbid obligations of these rows."""
        return [
            constraint
            for which in SIDES
            for constraint in self.constraints_about(which, {o.name for row in rows for o in self.literals(row, which)})
            if isinstance(constraint, Never)
        ]

    # Formulas ----------------------------------------------------------------------------------------------

    def guards(self, row: int, which: SideName) -> list[Implication]:
        """Equation 1 of a rule on one side; nothing if the side does not have it."""
        key = row, which
        found = self._guards.get(key)
        if found is None:
            rule, of = self.rows[row].on(which), self.sides[which]
            found = [] if rule is None else list(implications(of.plain(rule), of.stated.reading))
            self._guards[key] = found
        return found

    def said(self, row: int, which: SideName) -> list[tuple[Formula, Obligation]]:
        """The obligations of a rule on one side with their situations, in the order of the text."""
        key = row, which
        found = self._said.get(key)
        if found is None:
            of = self.sides[which]
            found = self._said[key] = [
                (conjunction([guard, of.formula(where)]), plain)
                for _, guard, clause in self.guards(row, which)
                for obligation in clause.obligations
                for where, plain in plain_responses(obligation, of.stated.reading, self.untimed)
            ]
        return found

    def literals(self, row: int, which: SideName) -> list[Obligation]:
        """All obligations of a rule on one side, each once, in the order of the text."""
        return list(dict.fromkeys(literal for _, literal in self.said(row, which)))

    def obliges(self, row: int, which: SideName, wanted: Callable[[Obligation], object]) -> Formula:
        """The situations in which the rule obliges a literal that is `wanted`."""
        return disjunction(list(dict.fromkeys(where for where, literal in self.said(row, which) if wanted(literal))))

    def due(self, rows: Iterable[int], which: SideName, literal: Obligation) -> Formula:
        """The situations in which one of these rules obliges the literal, or one that requires at least as much."""

        found: list[Formula] = []
        for row in rows:
            for where, one in self.said(row, which):
                enough = self.implied_where(one, literal)
                if enough is not None and enough != Truth(False):
                    found.append(conjunction([where, enough]))
        return disjunction(list(dict.fromkeys(found)))

    def implied_where(self, one: Obligation, literal: Obligation) -> Formula | None:
        """The situations in which meeting `one` meets the other literal; None if that is unknown."""
        return implied_where(one, literal, self.untimed, self._ranges)

    @cached_property
    def _ranges(self) -> MeasureRanges:
        given = [Assume(one.formula) for which in SIDES for one in self.sides[which].given]
        return MeasureRanges(given, self.measures)

    def conflict(self, rows: Sequence[int], which: SideName) -> Formula:
        """The situations in which the immediate obligations of these rules conflict. Raises `Undecided` if
        constraints are too entangled."""
        key = which, tuple(rows)
        found = self._conflicts.get(key)
        if found is None:
            found = self._conflicts[key] = self._conflicting(rows, which)
        return found

    def _conflicting(self, rows: Sequence[int], which: SideName) -> Formula:
        at_once = {o for row in rows for o in self.literals(row, which) if o.timing is None}
        parts = []
        for clash in self.inconsistent_sets(which, at_once):
            due = [self._due_exactly(rows, which, literal) for literal in sorted(clash.literals, key=str)]
            parts.append(conjunction([*due, *sorted(clash.labels, key=repr)]))
        return disjunction(parts)

    def inconsistent_sets(self, which: SideName, literals: set[Obligation]) -> list[InconsistentSet]:
        """The minimal sets of these literals that cannot all be due on one side."""
        direct = [
            InconsistentSet(frozenset((one, opposite(one))))
            for one in sorted(literals, key=str)
            if opposite(one) in literals
        ]
        declared = self.constraints_about(which, {literal.name for literal in literals})
        return list(dict.fromkeys(direct)) + (list(inconsistent_sets(declared, literals)) if declared else [])

    def _due_exactly(self, rows: Iterable[int], which: SideName, literal: Obligation) -> Formula:
        return disjunction([self.obliges(row, which, literal.__eq__) for row in rows])

    def label(self, row: int, which: SideName) -> str:
        rule = self.rows[row].on(which)
        assert rule is not None, "asked of a rule that this side has"
        return rule.label


def none_of(conflicts: Iterable[Formula]) -> list[Formula]:
    """The negations of these formulas, without those that are never true."""
    return [Not(formula) for formula in conflicts if formula != Truth(False)]


def triggered_rules(comparison: Comparison, which: SideName, context: Context) -> Iterator[Rule]:
    """The rules of one side, as they stand in its text, whose trigger occurs."""
    for row in comparison.rows_of(context.triggers):
        rule = comparison.rows[row].on(which)
        if rule is not None:
            yield rule
