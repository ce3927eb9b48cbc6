"""The rules as values: what a text of rules says, with no opinion on what it means.

Everything here is frozen. Two values are equal when they say the same; where they stood in the text
(`span`) and the comments around them do not count. What the rules mean is decided twice, by
`sleec_runtime.evaluation.evaluation` and by `sleec_verify`, and this module is all that the two share.

The names are the paper's (Section 3): a rule has a trigger C0, a default response O0, and hedge clauses
``UNLESS Ci IN WHICH CASE Oi``. Clause 0 is the default, clauses 1..n are the hedges in the order of the text.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple, Union

from sleec_runtime.errors import WrongType
from sleec_runtime.model.calculation import Calculated as Calculated
from sleec_runtime.model.spans import NOWHERE as NOWHERE
from sleec_runtime.model.spans import Place as Place
from sleec_runtime.model.spans import Source as Source
from sleec_runtime.model.spans import Span as Span

if TYPE_CHECKING:
    from fractions import Fraction

    from sleec_runtime.model.time import Claim, Relation, Timing

Kind = Literal["trigger", "condition", "obligation"]
Reading = Literal["cascade", "priority"]
DeclaredKind = Literal["trigger", "condition", "obligation", "event"]
Syntax = Literal["english", "dsl"]
Dialect = Literal["sleec-tk", "legos"]
Agent = Literal["system", "environment"]
Operator = Literal["<", "<=", "=", "!=", ">=", ">"]
MeasureKind = Literal["number", "integer", "scale"]

READINGS: tuple[Reading, ...] = ("cascade", "priority")

Rational = Union[int, "Fraction"]
"""An exact number. Decimals of the text become fractions, so that 36.6 is 36.6."""

Value = Union[bool, int, "Fraction", str]
"""What a condition or measure may be worth: a truth value, an exact number, or a value of a scale."""


@dataclass(frozen=True, slots=True)
class Truth:
    """The constants ``true`` and ``false``."""

    value: bool
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Atom:
    """A name that is true or false. `kind` is already resolved, so one name may be a trigger here and an
    obligation there (semantics: "it happened" and "it is to be done" are two things)."""

    kind: Kind
    name: str
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class MeasureRef:
    """The current value of a measure, as one side of a comparison."""

    name: str


@dataclass(frozen=True, slots=True)
class Number:
    """An exact number as one side of a comparison; `constant` is the name it was written by, if any."""

    value: Rational
    constant: str | None = None


@dataclass(frozen=True, slots=True)
class ScaleValue:
    """A value of the scale of the measure on the other side; `rank` is its place in that scale, from 0.

    What is none of its values, and read all the same (a `Defect`), may have a place that the scale does not have.
    """

    value: str
    rank: int


Term = Union[MeasureRef, Number, ScaleValue, Calculated]


@dataclass(frozen=True, slots=True)
class Comparison:
    """``left operator right``. At least one side is a `MeasureRef`, or the left one is `Calculated`; the sides fit
    (resolved by the language)."""

    left: Term
    operator: Operator
    right: Term
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Not:
    operand: Formula
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class And:
    """A conjunction of two or more."""

    operands: tuple[Formula, ...]
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Or:
    """A disjunction of two or more."""

    operands: tuple[Formula, ...]
    span: Span = field(default=NOWHERE, compare=False, repr=False)


Formula = Union[Truth, Atom, Comparison, Not, And, Or]


def leaves(formula: Formula) -> Iterator[Atom | Comparison]:
    """The atoms and comparisons of a formula, in the order of the text, repeats included."""
    if isinstance(formula, (Atom, Comparison)):
        yield formula
    elif isinstance(formula, Not):
        yield from leaves(formula.operand)
    elif isinstance(formula, (And, Or)):
        for operand in formula.operands:
            yield from leaves(operand)


def measures_of(comparison: Comparison) -> tuple[str, ...]:
    """The measures that a comparison speaks of: one or two, or those that it calculates with."""
    if isinstance(comparison.left, Calculated):
        return comparison.left.measures
    return tuple(side.name for side in (comparison.left, comparison.right) if isinstance(side, MeasureRef))


def names_of(formula: Formula) -> Iterator[str]:
    """The names of atoms and measures in a formula, in the order of the text, repeats included."""
    for leaf in leaves(formula):
        if isinstance(leaf, Atom):
            yield leaf.name
        else:
            yield from measures_of(leaf)


@dataclass(frozen=True, slots=True)
class Comments:
    """Comments of one line of rules, each without its marker: those on lines of their own above it, and the one
    behind it."""

    above: tuple[str, ...] = ()
    behind: str | None = None


NO_COMMENTS = Comments()


@dataclass(frozen=True, slots=True)
class Obligation:
    """One literal of a response: a name, or ``NOT`` and a name (a prohibition). `timing` says when it is due, if that
    is said."""

    name: str
    negated: bool = False
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    timing: Timing | None = None

    def __str__(self) -> str:
        return f"NOT {self.name}" if self.negated else self.name


@dataclass(frozen=True, slots=True)
class Clause:
    """A default (`condition` is None) or a hedge. No obligations: ``UNLESS c`` alone, which obliges nothing.

    `hedges` is a chain nested in this clause's parentheses; it speaks only where this clause is the one that
    decides in its own chain.
    """

    condition: Formula | None
    obligations: tuple[Obligation, ...]
    hedges: tuple[Clause, ...] = ()
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Rule:
    """``WHEN trigger [AND guard] THEN default UNLESS hedges…`` (paper, Section 3.2).

    `domains` is None for a rule that applies everywhere. `labelled` is False where the text gives no label and
    `label` is the rule's number in the file (``rule_3``).
    """

    label: str
    trigger: str
    guard: Formula | None
    default: Clause
    hedges: tuple[Clause, ...]
    domains: tuple[str, ...] | None = None
    labelled: bool = True
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    label_span: Span = field(default=NOWHERE, compare=False, repr=False)
    trigger_span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)

    def clauses(self) -> Iterator[Clause]:
        """Every clause in the order of the text, nested ones after the clause that holds them. The place in this
        order is the clause's number: 0 for the default, i for the layer ``label.hci``."""
        yield from in_text_order(self.default)
        for hedge in self.hedges:
            yield from in_text_order(hedge)

    def layer(self, number: int) -> str | None:
        """The name of the layer of clause `number`; None for the default, which has the rule's own ε."""
        return f"{self.label}.hc{number}" if number else None

    def applies_in(self, domain: str | None) -> bool:
        """Whether the rule counts in `domain`. None asks for no domain in particular: every rule counts."""
        return domain is None or self.domains is None or domain in self.domains


def in_text_order(clause: Clause) -> Iterator[Clause]:
    """A clause and those nested in it, in the order of the text."""
    yield clause
    for hedge in clause.hedges:
        yield from in_text_order(hedge)


@dataclass(frozen=True, slots=True)
class Declaration:
    """``TRIGGER a, b``, ``CONDITION c``, ``OBLIGATION d`` or ``EVENT e BY system``: `kind` is that of the names. An
    event may be a trigger and an obligation; `agent` says whose it is, if that is said."""

    kind: DeclaredKind
    names: tuple[str, ...]
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    name_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)
    agent: Agent | None = None


@dataclass(frozen=True, slots=True)
class Measure:
    """``MEASURE name: number`` or an ordered scale ``low < high``; `values` is the scale, lowest first.

    A number is any rational, an integer a whole one. `declared` is False where it was inferred from its use.
    """

    name: str
    kind: MeasureKind
    values: tuple[str, ...] = ()
    declared: bool = True
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Constant:
    """``CONSTANT name = value``; `alias` is the constant it was defined by, if it was not by a number."""

    name: str
    value: Rational
    alias: str | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Exclusive:
    """``EXCLUSIVE a, b, …``: never two of these obligations due together."""

    names: tuple[str, ...]
    domains: tuple[str, ...] | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    name_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Never:
    """``NEVER formula``: a formula over obligations and situations that must not come true."""

    formula: Formula
    domains: tuple[str, ...] | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Assume:
    """``ASSUME formula``: what is always true of situations, over triggers and conditions. Contexts that break it
    do not count anywhere."""

    formula: Formula
    domains: tuple[str, ...] | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


Constraint = Union[Exclusive, Never, Assume]
Statement = Union[Declaration, Measure, Constant, Exclusive, Never, Assume, Rule, "Claim", "Relation"]

DefectKind = Literal["repeated-label", "foreign-value", "number-as-value", "repeated-definition"]


class Defect(NamedTuple):
    """What is wrong with a text that tools of others read all the same, so that it is read here too: it is a finding
    of `check`."""

    kind: DefectKind
    message: str
    span: Span
    help: str


@dataclass(frozen=True)
class Ruleset:
    """A whole text of rules, resolved: every name has its kind, every comparison fits.

    `statements` holds everything in the order of the text. `inferred` are the measures that the rules compare but
    the text does not declare. `reading` is how chains of hedges are read; `reading_stated` says whether the text
    says so itself. `dialect` is that of a text in the DSL, `defects` what of it is read only because others read it,
    and `calculated_with` are the constants of what is worked out when it is read, and does not name them any more.
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
        """Every measure by its name, the inferred ones included."""
        declared = (s for s in self.statements if isinstance(s, Measure))
        return {measure.name: measure for measure in (*declared, *self.inferred)}

    @cached_property
    def constants(self) -> Mapping[str, Constant]:
        return {s.name: s for s in self.statements if isinstance(s, Constant)}

    @cached_property
    def declared(self) -> Mapping[DeclaredKind, frozenset[str]]:
        """The declared names of each kind; an empty set for a kind that the text does not declare."""
        return {
            kind: frozenset(
                name for s in self.statements if isinstance(s, Declaration) and s.kind == kind for name in s.names
            )
            for kind in ("trigger", "condition", "obligation", "event")
        }

    @cached_property
    def domains(self) -> tuple[str, ...]:
        """The domains that rules or constraints name, in the order of the text."""
        seen: dict[str, None] = {}
        for statement in (*self.rules, *self.constraints):
            for domain in statement.domains or ():
                seen.setdefault(domain)
        return tuple(seen)

    @cached_property
    def triggers(self) -> frozenset[str]:
        """T: the triggers that are declared, as events too, that rules have, or that hedges or constraints speak of."""
        declared = self.declared["trigger"] | self.declared["event"]
        of_rules = {rule.trigger for rule in self.rules} | self._named_in_rules("trigger")
        return declared | of_rules | self._named_in_constraints("trigger")

    @cached_property
    def conditions(self) -> frozenset[str]:
        """The Boolean part of C; the measures are in `measures`."""
        used = self._named_in_rules("condition") | self._named_in_constraints("condition")
        return self.declared["condition"] | used

    @cached_property
    def obligations(self) -> frozenset[str]:
        """O: the obligations that are declared, that rules oblige or forbid, or that constraints speak of."""
        used = {o.name for rule in self.rules for clause in rule.clauses() for o in literals(clause)}
        exclusive = {name for c in self.constraints if isinstance(c, Exclusive) for name in c.names}
        return self.declared["obligation"] | used | exclusive | self._named_in_constraints("obligation")

    def _named_in_rules(self, kind: Kind) -> frozenset[str]:
        return frozenset(
            leaf.name
            for rule in self.rules
            for formula in formulas_of(rule)
            for leaf in leaves(formula)
            if isinstance(leaf, Atom) and leaf.kind == kind
        )

    def _named_in_constraints(self, kind: Kind) -> frozenset[str]:
        return frozenset(
            leaf.name
            for constraint in self.constraints
            if isinstance(constraint, (Never, Assume))
            for leaf in leaves(constraint.formula)
            if isinstance(leaf, Atom) and leaf.kind == kind
        )

    def read_as(self, reading: Reading) -> Ruleset:
        """The same rules under a reading of the caller's. Raises WrongType for what is none."""
        if reading not in READINGS:
            raise WrongType("the reading", reading, " or ".join(READINGS), "give one of these names")
        return replace(self, reading=reading)

    def in_domain(self, domain: str) -> Ruleset:
        """The statements that count in `domain`: its own, and those that apply everywhere."""
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
        """Whether any of it needs `sleec_runtime.model.time`: times, concerns, purposes or relations."""
        return any(
            any(o.timing is not None for clause in s.clauses() for o in clause.obligations)
            if isinstance(s, Rule)
            else not isinstance(s, (Declaration, Measure, Constant, Exclusive, Never, Assume))
            for s in self.statements
        )


def formulas_of(rule: Rule) -> Iterator[Formula]:
    """The guard and the conditions of a rule, in the order of the text."""
    if rule.guard is not None:
        yield rule.guard
    for clause in rule.clauses():
        yield from conditions_in(clause)


def conditions_in(clause: Clause) -> Iterator[Formula]:
    """The condition of a clause, and those of the hedges of what is due in place of its response."""
    if clause.condition is not None:
        yield clause.condition
    for obligation in clause.obligations:
        if obligation.timing is not None:
            for alternative in obligation.timing.alternatives():
                for inner in in_text_order(alternative):
                    yield from conditions_in(inner)


def literals(clause: Clause) -> Iterator[Obligation]:
    """What a clause obliges, and what is due in place of it."""
    for obligation in clause.obligations:
        yield obligation
        if obligation.timing is not None:
            for alternative in obligation.timing.alternatives():
                for inner in in_text_order(alternative):
                    yield from literals(inner)


@dataclass(frozen=True)
class Context:
    """A situation χ ⊆ T ∪ C (paper, Section 3.2).

    What is not in `triggers`, or not in `conditions`, is false, as Definition 1 has it; a comparison with a measure
    that has no value is false too.
    """

    triggers: frozenset[str] = frozenset()
    conditions: Mapping[str, Value] = field(default_factory=dict)
