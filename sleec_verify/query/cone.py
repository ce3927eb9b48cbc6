"""The cone of influence: which rules and constraints can matter to a question.

A rule whose trigger does not occur obliges nothing, and whether a trigger occurs is free unless an `ASSUME` speaks of
it. So a question about a situation concerns the rules of its triggers, the assumptions that share names with them, and
the rules of the triggers that these rules name or these assumptions may force. Everything else can be left out without
changing the answer, and questions about ten rules stay questions about ten rules in a ruleset of 100,000.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.evaluation.evaluation import holds
from sleec_runtime.model import (
    Assume,
    Atom,
    Clause,
    Context,
    Exclusive,
    Formula,
    Never,
    Obligation,
    Rule,
    Ruleset,
    formulas_of,
    leaves,
    measures_of,
)
from sleec_verify.encoding.budget import Undecided

if TYPE_CHECKING:
    from sleec_verify.encoding.solver import Recorder
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.query.assumption_slicing import Cutting
    from sleec_verify.query.inconsistent_sets import Clashes
    from sleec_verify.query.partition import Parts
    from sleec_verify.query.rule_shape import Shape
    from sleec_verify.traces.index import Index

Name = tuple[str, str]
"""A trigger (``("trigger", name)``), or a condition or measure (``("condition", name)``)."""


class Place(NamedTuple):
    """Clause `number` of the rule at `rule` in `Ruleset.rules`."""

    rule: int
    number: int


def names_in(formula: Formula) -> Iterator[Name]:
    """The triggers, conditions and measures that a formula speaks of; obligations are left out."""
    for leaf in leaves(formula):
        if isinstance(leaf, Atom):
            if leaf.kind != "obligation":
                yield leaf.kind, leaf.name
        else:
            for measure in measures_of(leaf):
                yield "condition", measure


def obligations_in(constraint: Exclusive | Never) -> Iterator[str]:
    """The obligations that a constraint speaks of, repeats included."""
    if isinstance(constraint, Exclusive):
        yield from constraint.names
    else:
        for leaf in leaves(constraint.formula):
            if isinstance(leaf, Atom) and leaf.kind == "obligation":
                yield leaf.name


def _situations_in(constraint: Exclusive | Never) -> Iterator[Name]:
    """The triggers, conditions and measures that a constraint speaks of."""
    if isinstance(constraint, Never):
        yield from names_in(constraint.formula)


def names_of_rule(rule: Rule) -> Iterator[Name]:
    """The trigger, conditions and measures that decide a rule."""
    yield "trigger", rule.trigger
    for formula in formulas_of(rule):
        yield from names_in(formula)


class Cones:
    """The indices of one ruleset, each made once, in time linear in the ruleset, when it is first asked for."""

    def __init__(
        self, ruleset: Ruleset, recorder: Recorder | None = None, untimed: Untimed = "at", chains: bool = True
    ) -> None:
        """`recorder` is told of every question about the ruleset. `untimed` is what a response without a window means
        in rules with time; with `chains`, doing an obligation triggers the rules of that name."""
        self.ruleset = ruleset
        self.rules = ruleset.rules
        self.recorder = recorder
        self._shapes: dict[int, Shape | None] = {}
        self._rivals: dict[int, list[int]] = {}
        self.untimed = untimed
        self.chains = chains

    @cached_property
    def index(self) -> Index:
        """The rules for questions about traces."""
        from sleec_verify.traces.index import Index

        return Index(self.ruleset, self.untimed, self.recorder)

    @cached_property
    def parts(self) -> Parts:
        """What is asked about situations, and what is asked about traces."""
        from sleec_verify.query.partition import parts

        return parts(self)

    @cached_property
    def clauses(self) -> list[tuple[Clause, ...]]:
        """The clauses of each rule, by the rule's position."""
        return [tuple(rule.clauses()) for rule in self.rules]

    def labelled(self) -> Iterator[tuple[str, int]]:
        """The label of each rule, with its position."""
        return ((rule.label, position) for position, rule in enumerate(self.rules))

    def shape(self, position: int) -> Shape | None:
        """The shape of the rule at `position`, if what is asked about it alone has the same answer for all rules of its
        shape. None where assumptions may tell them apart, and where every question is recorded."""
        if self.assumptions or self.recorder is not None:
            return None
        if position not in self._shapes:
            from sleec_verify.query.rule_shape import shape_of_rule

            self._shapes[position] = shape_of_rule(self.rules[position], self.ruleset.measures)
        return self._shapes[position]

    @cached_property
    def by_trigger(self) -> dict[str, list[int]]:
        """The positions of the rules of each trigger."""
        index: dict[str, list[int]] = {}
        for position, rule in enumerate(self.rules):
            index.setdefault(rule.trigger, []).append(position)
        return index

    @cached_property
    def by_obligation(self) -> dict[Obligation, list[Place]]:
        """The clauses that oblige each literal."""
        index: dict[Obligation, list[Place]] = {}
        for position, clauses in enumerate(self.clauses):
            for number, clause in enumerate(clauses):
                for obligation in clause.obligations:
                    index.setdefault(obligation, []).append(Place(position, number))
        return index

    @cached_property
    def assumptions(self) -> list[Assume]:
        return [c for c in self.ruleset.constraints if isinstance(c, Assume)]

    @property
    def possible(self) -> bool:
        """Whether the assumptions leave any situation possible. If they do, those that share no name with a question
        can be left out of it; if they do not, every question has the answer no.

        It is asked once. Raises Undecided each time if it was not decided then.
        """
        if isinstance(self._possible, Undecided):
            raise Undecided(self._possible.message, self._possible.hint)
        return self._possible

    @cached_property
    def _possible(self) -> bool | Undecided:
        from sleec_verify.query.question import Question

        with Question(self, assuming=False) as question:
            for assumption in self.assumptions:
                question.require_formula(assumption.formula)
            try:
                return question.ask()
            except Undecided as error:
                return error

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
        """The constraints that share obligations with these names, directly or through one another, in the order of
        the text."""
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
    def clashes(self) -> Clashes:
        """Every minimal set of literals that cannot be due together and that the rules can oblige."""
        from sleec_verify.query.inconsistent_sets import Clash, Clashes, clashes, opposite

        obliged = self.by_obligation
        direct = [
            Clash(frozenset((literal, opposite(literal))))
            for literal in obliged
            if not literal.negated and opposite(literal) in obliged
        ]
        declared = clashes(self.constraints, obliged)
        return Clashes([*direct, *declared.listed], declared.exclusions)

    @cached_property
    def _assumptions_by_name(self) -> dict[Name, list[int]]:
        index: dict[Name, list[int]] = {}
        for position, assumption in enumerate(self.assumptions):
            for name in set(names_in(assumption.formula)):
                index.setdefault(name, []).append(position)
        return index

    def assumptions_about(self, names: Iterable[Name]) -> list[Assume]:
        """The assumptions that share names with `names`, directly or through one another, in the order of the text."""
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
        """The assumptions that do not hold of nothing: where no trigger occurs and no condition is true."""
        nothing = Context()
        return [a for a in self.assumptions if not holds(a.formula, nothing, self.ruleset.measures)]

    def assumptions_that_may_break(self, context: Context) -> list[Assume]:
        """All assumptions that `context` can break: one that speaks of none of its names has the value that it has of
        nothing."""
        names = [
            *(("trigger", name) for name in context.triggers),
            *(("condition", name) for name in context.conditions),
        ]
        positions = {position for name in names for position in self._assumptions_by_name.get(name, ())}
        return [*self.demanding, *(self.assumptions[position] for position in sorted(positions))]

    @cached_property
    def _triggers_tied(self) -> bool:
        """Whether an assumption, a guard or a hedge speaks of a trigger."""
        conditions = (formula for rule in self.rules for formula in formulas_of(rule))
        return any(kind == "trigger" for kind, _ in self._assumptions_by_name) or any(
            isinstance(leaf, Atom) and leaf.kind == "trigger" for formula in conditions for leaf in leaves(formula)
        )

    @cached_property
    def _triggers_constrained(self) -> bool:
        return any(kind == "trigger" for constraint in self.constraints for kind, _ in _situations_in(constraint))

    @cached_property
    def constraints_on_situations(self) -> list[Exclusive | Never]:
        """The constraints that rule out a situation whatever is due, each alone or several together. Raises
        `Undecided` where the constraints are too entangled."""
        return list(
            dict.fromkeys(origin for clash in self.clashes.listed if not clash.literals for origin in clash.origins)
        )

    @cached_property
    def always(self) -> frozenset[str]:
        """The triggers of assumptions that do not hold where none of their triggers occurs: some of these occur in
        every situation."""
        from sleec_verify.query.question import Question

        always: set[str] = set()
        seen: set[int] = set()
        for assumption in self.assumptions:
            if id(assumption) in seen:
                continue
            related = self.assumptions_about(names_in(assumption.formula)) or [assumption]
            seen.update(map(id, related))
            triggers = {name for a in related for kind, name in names_in(a.formula) if kind == "trigger"}
            if not triggers:
                continue
            with Question(self, assuming=False) as question:
                for other in related:
                    question.require_formula(other.formula)
                for trigger in triggers:
                    question.require(-question.encoder.variable(("trigger", trigger)))
                if not question.ask():
                    always |= triggers
        return frozenset(always)

    def together_with(self, trigger: str, keeping: bool = False) -> list[int]:
        """The rules that may be forced to be active when `trigger` occurs: its own, and those of the triggers that such
        rules name, that assumptions tie to it or to the conditions of such rules, or force in any case. In the order of
        the text.

        With `keeping`, forced also by keeping the constraints about what these rules oblige.
        """
        if not (self._triggers_tied or (keeping and self._triggers_constrained)):
            return self.by_trigger.get(trigger, [])

        def named(triggers: set[str]) -> Iterator[Name]:
            rules = {position for t in triggers for position in self.by_trigger.get(t, ())}
            for position in rules:
                yield from names_of_rule(self.rules[position])
            if keeping:
                yield from self._names_of_constraints(rules)

        triggers, _ = self.cutting.reached([trigger], named)
        return sorted(position for t in triggers for position in self.by_trigger.get(t, ()))

    @cached_property
    def cutting(self) -> Cutting:
        """The assumptions, to be cut to what may have to occur. What constraints speak of is never left out."""
        from sleec_verify.query.assumption_slicing import Cutting

        forbidden = {name for c in self.constraints for kind, name in _situations_in(c) if kind == "trigger"}
        return Cutting((one.formula for one in self.assumptions), forbidden, self.ruleset.measures.values())

    def _names_of_constraints(self, rules: Iterable[int]) -> Iterator[Name]:
        """What the constraints that may conflict with the obligations of some rules say of situations."""
        due = {o.name for position in rules for clause in self.clauses[position] for o in clause.obligations}
        for constraint in (*self.constraints_about(due), *self.constraints_on_situations):
            yield from _situations_in(constraint)

    def rivals(self, position: int) -> list[int]:
        """The other rules that may oblige what the rule at `position` obliges, in situations that trigger it. In the
        order of the text."""
        found = self._rivals.get(position)
        if found is None:
            found = self._rivals[position] = self._rivals_of(position)
        return found

    def _rivals_of(self, position: int) -> list[int]:
        rule = self.rules[position]
        literals = {literal for clause in self.clauses[position] for literal in clause.obligations}
        found = {place.rule for literal in literals for place in self.by_obligation[literal]} - {position}
        if not self._triggers_tied:
            return sorted(other for other in found if self.rules[other].trigger == rule.trigger)
        return sorted(found.intersection(self.together_with(rule.trigger)))
