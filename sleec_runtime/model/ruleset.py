"""Rulesets: a whole text of rules as a value.

Everything in the model is frozen. Two values are equal if they say the same; spans and comments do not count. The
meaning of rules is defined twice, by `sleec_runtime.evaluation` and by the encoding of `sleec_verify`, which share only
the model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, NamedTuple, Union

from sleec_runtime.errors import WrongType
from sleec_runtime.model.claim import Claim, ClaimKind
from sleec_runtime.model.constraint import Assume, Constraint, Exclusive, Never
from sleec_runtime.model.declaration import Constant, Declaration, DeclaredKind, Measure
from sleec_runtime.model.formula import Atom, Kind, leaves
from sleec_runtime.model.relation import RELATIONS, Relation
from sleec_runtime.model.response import literals
from sleec_runtime.model.rule import Rule, formulas_of
from sleec_runtime.support.spans import Source, Span

Reading = Literal["cascade", "priority"]
Syntax = Literal["english", "dsl"]
Dialect = Literal["sleec-tk", "legos"]

READINGS: tuple[Reading, ...] = ("cascade", "priority")

Statement = Union[Declaration, Measure, Constant, Exclusive, Never, Assume, Rule, Claim, Relation]
DefectKind = Literal["repeated-label", "foreign-value", "number-as-value", "repeated-definition"]


class Defect(NamedTuple):
    """An error in a text that other tools accept. It is accepted here too, and `check` reports it."""

    kind: DefectKind
    message: str
    span: Span
    help: str


@dataclass(frozen=True)
class Ruleset:
    """A whole text of rules, resolved: every name has its kind, and the sides of every comparison have one type.

    `statements` are in text order. `inferred` are the measures that the rules compare and the text does not declare.
    `reading` is the reading of chains of hedges; `reading_stated` tells whether the text states it. `dialect` is the
    dialect of a text in the DSL, and `defects` are its errors that other tools accept. `calculated_with` are the
    constants in expressions that the parser has evaluated.
    """

    statements: tuple[Statement, ...]
    reading: Reading = "cascade"
    syntax: Syntax = "english"
    inferred: tuple[Measure, ...] = ()
    dialect: Dialect | None = None
    defects: tuple[Defect, ...] = field(default=(), compare=False)
    calculated_with: frozenset[str] = field(default=frozenset(), compare=False)
    reading_stated: bool = field(default=False, compare=False)
    source: Source = field(default=Source("<memory>", ""), compare=False, repr=False)
    closing_comments: tuple[str, ...] = field(default=(), compare=False, repr=False)

    @cached_property
    def rules(self) -> tuple[Rule, ...]:
        return tuple(s for s in self.statements if isinstance(s, Rule))

    @cached_property
    def by_label(self) -> Mapping[str, Rule]:
        return {rule.label: rule for rule in self.rules}

    @cached_property
    def constraints(self) -> tuple[Constraint, ...]:
        return tuple(s for s in self.statements if isinstance(s, (Exclusive, Never, Assume)))

    @cached_property
    def measures(self) -> Mapping[str, Measure]:
        """Every measure by name, including the inferred ones."""
        declared = (s for s in self.statements if isinstance(s, Measure))
        return {measure.name: measure for measure in (*declared, *self.inferred)}

    @cached_property
    def constants(self) -> Mapping[str, Constant]:
        return {s.name: s for s in self.statements if isinstance(s, Constant)}

    @cached_property
    def declared(self) -> Mapping[DeclaredKind, frozenset[str]]:
        """The declared names of each kind; an empty set if the text declares none."""
        return {
            kind: frozenset(
                name for s in self.statements if isinstance(s, Declaration) and s.kind == kind for name in s.names
            )
            for kind in ("trigger", "condition", "obligation", "event")
        }

    @cached_property
    def domains(self) -> tuple[str, ...]:
        """The domains that rules or constraints name, in text order."""
        seen: dict[str, None] = {}
        for statement in (*self.rules, *self.constraints):
            for domain in statement.domains or ():
                seen.setdefault(domain)
        return tuple(seen)

    @cached_property
    def triggers(self) -> frozenset[str]:
        """T (paper, Section 3.2): the declared triggers and events, and the triggers in rules and constraints."""
        declared = self.declared["trigger"] | self.declared["event"]
        of_rules = {rule.trigger for rule in self.rules} | self._named_in_rules["trigger"]
        return declared | of_rules | self._named_in_constraints("trigger")

    @cached_property
    def conditions(self) -> frozenset[str]:
        """The Boolean part of C (paper, Section 3.2); the measures are in `measures`."""
        used = self._named_in_rules["condition"] | self._named_in_constraints("condition")
        return self.declared["condition"] | used

    @cached_property
    def obligations(self) -> frozenset[str]:
        """O (paper, Section 3.2): the obligations that are declared, and those in rules and constraints."""
        used = {o.name for rule in self.rules for clause in rule.clauses() for o in literals(clause)}
        exclusive = {name for c in self.constraints if isinstance(c, Exclusive) for name in c.names}
        return self.declared["obligation"] | used | exclusive | self._named_in_constraints("obligation")

    @cached_property
    def _named_in_rules(self) -> Mapping[Kind, set[str]]:
        """The names of the atoms in guards and conditions, by kind."""
        found: dict[Kind, set[str]] = {"trigger": set(), "condition": set(), "obligation": set()}
        for rule in self.rules:
            for formula in formulas_of(rule):
                for leaf in leaves(formula):
                    if isinstance(leaf, Atom):
                        found[leaf.kind].add(leaf.name)
        return found

    def _named_in_constraints(self, kind: Kind) -> frozenset[str]:
        return frozenset(
            leaf.name
            for constraint in self.constraints
            if isinstance(constraint, (Never, Assume))
            for leaf in leaves(constraint.formula)
            if isinstance(leaf, Atom) and leaf.kind == kind
        )

    def read_as(self, reading: Reading) -> Ruleset:
        """The same rules under another reading. Raises WrongType if `reading` is not the name of one."""
        if reading not in READINGS:
            raise WrongType("the reading", reading, " or ".join(READINGS), "give one of these names")
        return replace(self, reading=reading)

    def in_domain(self, domain: str) -> Ruleset:
        """The ruleset with the statements that apply in `domain`: its own, and those without a domain."""
        return replace(
            self,
            statements=tuple(
                s
                for s in self.statements
                if not isinstance(s, (Rule, Exclusive, Never, Assume)) or s.domains is None or domain in s.domains
            ),
        )

    @cached_property
    def is_timed(self) -> bool:
        """Whether the ruleset has times, concerns, purposes or relations."""
        return any(
            any(o.timing is not None for clause in s.clauses() for o in clause.obligations)
            if isinstance(s, Rule)
            else isinstance(s, (Claim, *RELATIONS))
            for s in self.statements
        )


def claims(ruleset: Ruleset, kind: ClaimKind) -> tuple[Claim, ...]:
    """The concerns, or the purposes, of a ruleset."""
    return tuple(s for s in ruleset.statements if isinstance(s, Claim) and s.kind == kind)
