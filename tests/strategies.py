"""Hypothesis strategies for rulesets, formulas and contexts: small values of every shape that the language has.

`rulesets()` gives values such as the parser gives: names resolved, comparisons fitted, inferred measures listed. Turn
features off, or make it smaller, where a property is slow to check.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from hypothesis import strategies as st

from sleec_runtime.model import (
    READINGS,
    And,
    Assume,
    Atom,
    Clause,
    Comments,
    Comparison,
    Constant,
    Context,
    Declaration,
    Exclusive,
    Formula,
    Kind,
    Measure,
    MeasureRef,
    Never,
    Not,
    Number,
    Obligation,
    Operator,
    Or,
    Reading,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Truth,
    formulas_of,
    leaves,
    measures_of,
)

TRIGGERS = ("Call", "Alarm", "the user falls", "Meal", "Knock", "Dusk", "room 12 rings", "Visit")
CONDITIONS = ("Asleep", "Undressed", "the room is too warm", "Alone", "Ill", "Busy", "not well", "Deaf")
OBLIGATIONS = ("Help", "Wait", "open the curtains", "Warn", "Leave", "Log", "tell the nurse", "Close")
BOTH = ("Nurse", "ring the bell")
"""Names that are triggers and obligations: what one rule obliges sets off another."""

EXOTIC = (
    "Größe",
    "x-ray",
    "O'Brien",
    "patients'",
    "_hidden",
    "Ñandú",
    "λ",
    "C3",
    "名前",
    "être au lit",
    "the 2nd floor",
)
"""Names at the edge of what a name may be; used as conditions where `exotic` is set."""

NUMBERS = ("Age", "Temperature", "the noise level")
INTEGERS = ("Attempts", "Visitors")
SCALES = ("Risk", "Pain", "Trust")
SCALE_VALUES = (("low", "middle", "high"), ("never", "sometimes"), ("low", "high", "very high", "worst"))
DOMAINS = ("hospital", "household", "the day ward")
_OPERATORS: tuple[Operator, ...] = ("<", "<=", "=", "!=", ">=", ">")
_VALUES: tuple[int | Fraction, ...] = (0, 1, 2, 18, -3, Fraction(73, 2), Fraction(-1, 4), Fraction(1, 1000), 10**20)


class _Vocabulary:
    """The names that one ruleset draws from, and what is known of them."""

    def __init__(self, size: int, overlap: bool, exotic: bool) -> None:
        both = BOTH[: (size + 2) // 3] if overlap else ()
        self.triggers = TRIGGERS[:size] + both
        self.obligations = OBLIGATIONS[:size] + both
        self.conditions = CONDITIONS[:size] + (EXOTIC if exotic else ())
        self.measures: dict[str, Measure] = {}
        self.constants: dict[str, Constant] = {}


@st.composite
def rulesets(
    draw: st.DrawFn,
    min_rules: int = 1,
    max_rules: int = 4,
    max_hedges: int = 3,
    max_depth: int = 2,
    names: int = 3,
    nested: bool = True,
    guards: bool = True,
    negations: bool = True,
    measures: bool = True,
    constraints: bool = True,
    domains: bool = True,
    declarations: bool = True,
    overlap: bool = True,
    labels: bool = True,
    exotic: bool = False,
    comments: bool = False,
    readings: Sequence[Reading] = READINGS,
) -> Ruleset:
    """Valid rulesets of `min_rules` to `max_rules` rules with up to `max_hedges` hedges in each chain.

    Formulas are up to `max_depth` operators deep, over `names` names of each kind. `nested` allows chains in
    parentheses, `negations` prohibitions, `overlap` names that are both trigger and obligation, `labels` rules with
    labels of their own, `exotic` names in other scripts, `comments` comments everywhere.
    """
    known = _Vocabulary(names, overlap, exotic)
    statements: list[Statement] = []
    if measures:
        statements += draw(_measures_and_constants(known))
    leaf = _leaves(known)
    rules = [
        draw(_rules(known, leaf, max_hedges, max_depth, nested, guards, negations, domains, labels, number))
        for number in range(1, draw(st.integers(min_rules, max_rules)) + 1)
    ]
    others: list[Statement] = []
    if constraints and draw(st.booleans()):
        others += draw(_constraints(rules, known, leaf, max_depth, domains))
    if declarations:
        statements += draw(_declarations([*rules, *others]))
    statements = _merged(draw, draw(st.permutations([*statements, *others])), rules)
    if comments:
        statements = [draw(_commented(statement)) for statement in statements]
    return Ruleset(
        statements=tuple(statements),
        reading=draw(st.sampled_from(readings)),
        inferred=_inferred(statements, known),
        closing_comments=draw(_comment_lines()) if comments else (),
    )


def _merged(draw: st.DrawFn, others: list[Statement], rules: list[Rule]) -> list[Statement]:
    """The rules in their order, the other statements anywhere between them."""
    places = [draw(st.integers(0, len(rules))) for _ in others]
    merged: list[Statement] = []
    for index in range(len(rules) + 1):
        merged += [other for other, place in zip(others, places) if place == index]
        merged += rules[index : index + 1]
    return merged


# Formulas -------------------------------------------------------------------------------------------------


def formulas(leaf: st.SearchStrategy[Formula], max_depth: int = 2) -> st.SearchStrategy[Formula]:
    """Formulas over `leaf`, up to `max_depth` operators deep."""
    if max_depth == 0:
        return leaf
    smaller = formulas(leaf, max_depth - 1)
    several = st.lists(smaller, min_size=2, max_size=3).map(tuple)
    return st.one_of(leaf, leaf, st.builds(Not, smaller), st.builds(And, several), st.builds(Or, several))


def _leaves(known: _Vocabulary) -> st.SearchStrategy[Formula]:
    atoms = st.builds(Atom, st.just("condition"), st.sampled_from(known.conditions))
    if not known.measures:
        return atoms
    return st.one_of(atoms, atoms, _comparisons(known), st.builds(Truth, st.booleans()))


@st.composite
def _comparisons(draw: st.DrawFn, known: _Vocabulary) -> Comparison:
    measure = known.measures[draw(st.sampled_from(sorted(known.measures)))]
    left = MeasureRef(measure.name)
    twins = [other.name for other in known.measures.values() if other.values == measure.values]
    right: MeasureRef | ScaleValue | Number
    if draw(st.integers(0, 4)) == 0:
        right = MeasureRef(draw(st.sampled_from(twins)))
    elif measure.kind == "scale":
        rank = draw(st.integers(0, len(measure.values) - 1))
        right = ScaleValue(measure.values[rank], rank)
    else:
        constants = [Number(constant.value, constant.name) for constant in known.constants.values()]
        right = draw(st.sampled_from([*map(Number, _VALUES), *constants, *constants]))
    sides = (right, left) if draw(st.booleans()) else (left, right)
    return Comparison(sides[0], draw(st.sampled_from(_OPERATORS)), sides[1])


# Rules ----------------------------------------------------------------------------------------------------


@st.composite
def _rules(
    draw: st.DrawFn,
    known: _Vocabulary,
    leaf: st.SearchStrategy[Formula],
    max_hedges: int,
    max_depth: int,
    nested: bool,
    guards: bool,
    negations: bool,
    domains: bool,
    labels: bool,
    number: int,
) -> Rule:
    condition = formulas(leaf, max_depth)
    labelled = labels and draw(st.booleans())
    default, *hedges = draw(_chains(known, condition, max_hedges, nested, negations, depth=0))
    return Rule(
        label=draw(st.sampled_from((f"r{number}", f"ward.r{number}", f"r-{number}"))) if labelled else f"rule_{number}",
        trigger=draw(st.sampled_from(known.triggers)),
        guard=draw(condition) if guards and draw(st.integers(0, 3)) == 0 else None,
        default=default,
        hedges=tuple(hedges),
        domains=draw(_domains()) if domains else None,
        labelled=labelled,
    )


@st.composite
def _chains(
    draw: st.DrawFn,
    known: _Vocabulary,
    condition: st.SearchStrategy[Formula],
    max_hedges: int,
    nested: bool,
    negations: bool,
    depth: int,
) -> list[Clause]:
    """A default and its hedges, each maybe with a chain of its own."""
    obligation = st.builds(
        Obligation, st.sampled_from(known.obligations), st.booleans() if negations else st.just(False)
    )
    clauses: list[Clause] = []
    for index in range(draw(st.integers(0, max_hedges)) + 1):
        inner: list[Clause] = []
        if nested and depth < 2 and draw(st.integers(0, 5)) == 0:
            inner = draw(_chains(known, condition, 2, nested, negations, depth + 1))[1:]
        clauses.append(
            Clause(
                condition=draw(condition) if index else None,
                obligations=tuple(draw(st.lists(obligation, min_size=0 if index else 1, max_size=3))),
                hedges=tuple(inner),
            )
        )
    return clauses


def _domains() -> st.SearchStrategy[tuple[str, ...] | None]:
    some = st.lists(st.sampled_from(DOMAINS), min_size=1, max_size=2, unique=True).map(tuple)
    return st.one_of(st.none(), some)


# Other statements -----------------------------------------------------------------------------------------


@st.composite
def _measures_and_constants(draw: st.DrawFn, known: _Vocabulary) -> list[Statement]:
    statements: list[Statement] = []
    for name in draw(st.lists(st.sampled_from(NUMBERS + INTEGERS + SCALES), max_size=4, unique=True)):
        if name in SCALES:
            measure = Measure(name, "scale", draw(st.sampled_from(SCALE_VALUES)))
        elif name in INTEGERS:
            measure = Measure(name, "integer")
        else:
            # Only a number may be left undeclared.
            measure = Measure(name, "number", declared=draw(st.booleans()))
        known.measures[name] = measure
        if measure.declared:
            statements.append(measure)
    if draw(st.booleans()):
        adult = Constant("Adult", draw(st.sampled_from(_VALUES)))
        legal = Constant("LegalAge", adult.value, alias="Adult")
        for constant in (legal, adult)[draw(st.integers(0, 1)) :]:
            known.constants[constant.name] = constant
            statements.append(constant)
    return statements


@st.composite
def _constraints(
    draw: st.DrawFn,
    rules: list[Rule],
    known: _Vocabulary,
    leaf: st.SearchStrategy[Formula],
    max_depth: int,
    domains: bool,
) -> list[Statement]:
    """Constraints over names whose kind the rules settle."""
    where = _domains() if domains else st.none()
    found: list[Statement] = []
    obligations = sorted({o.name for rule in rules for clause in rule.clauses() for o in clause.obligations})
    triggers = sorted({rule.trigger for rule in rules})
    used = {atom.name for rule in rules for f in formulas_of(rule) for atom in leaves(f) if isinstance(atom, Atom)}
    if draw(st.booleans()):
        names = draw(st.lists(st.sampled_from(known.obligations), min_size=2, max_size=3, unique=True))
        found.append(Exclusive(tuple(names), draw(where)))
        obligations = sorted({*obligations, *names})
    obligation = st.builds(Atom, st.just("obligation"), st.sampled_from(obligations))
    trigger = st.builds(Atom, st.just("trigger"), st.sampled_from(triggers))
    only_triggers = [name for name in triggers if name not in obligations]
    conditions = [st.builds(Atom, st.just("condition"), st.sampled_from(sorted(used)))] if used else []
    situations = [st.builds(Atom, st.just("trigger"), st.sampled_from(only_triggers))] if only_triggers else []
    for _ in range(draw(st.integers(0, 2))):
        rest = draw(formulas(st.one_of(obligation, *conditions, *situations), max_depth))
        found.append(Never(And((draw(obligation), rest)), draw(where)))
    if draw(st.booleans()):
        found.append(Assume(draw(formulas(st.one_of(trigger, leaf), max_depth)), draw(where)))
    return found


@st.composite
def _declarations(draw: st.DrawFn, statements: list[Statement]) -> list[Statement]:
    """Declarations of whole kinds: of every name that is used, and maybe of one that is not."""
    ruleset = Ruleset(tuple(statements))
    found: list[Statement] = []
    every: tuple[tuple[Kind, frozenset[str], str], ...] = (
        ("trigger", ruleset.triggers, "SpareTrigger"),
        ("condition", ruleset.conditions, "SpareCondition"),
        ("obligation", ruleset.obligations, "SpareObligation"),
    )
    for kind, names, spare in every:
        chosen = sorted(names) + ([spare] if draw(st.booleans()) else [])
        if chosen and draw(st.integers(0, 2)) == 0:
            cut = draw(st.integers(0, len(chosen)))
            parts = (tuple(chosen[:cut]), tuple(chosen[cut:]))
            found += [Declaration(kind, part) for part in parts if part]
    return found


def _inferred(statements: Sequence[Statement], known: _Vocabulary) -> tuple[Measure, ...]:
    compared: set[str] = set()
    for statement in statements:
        own = list(formulas_of(statement)) if isinstance(statement, Rule) else []
        if isinstance(statement, (Never, Assume)):
            own = [statement.formula]
        for formula in own:
            for leaf in leaves(formula):
                if isinstance(leaf, Comparison):
                    compared.update(measures_of(leaf))
    return tuple(known.measures[name] for name in sorted(compared) if not known.measures[name].declared)


# Comments -------------------------------------------------------------------------------------------------


def _comment_lines() -> st.SearchStrategy[tuple[str, ...]]:
    return st.lists(st.sampled_from(("", "why", "WHEN x", "// twice", "# ...", "äh, THEN")), max_size=3).map(tuple)


def _comments() -> st.SearchStrategy[Comments]:
    behind = st.sampled_from((None, None, "", "because", "UNLESS // not"))
    return st.builds(Comments, _comment_lines(), behind)


@st.composite
def _commented(draw: st.DrawFn, statement: Statement) -> Statement:
    statement = replace(statement, comments=draw(_comments()))
    if not isinstance(statement, Rule):
        return statement
    return replace(
        statement,
        default=draw(_commented_clause(statement.default)),
        hedges=tuple(draw(_commented_clause(hedge)) for hedge in statement.hedges),
    )


@st.composite
def _commented_clause(draw: st.DrawFn, clause: Clause) -> Clause:
    return replace(
        clause,
        comments=draw(_comments()),
        hedges=tuple(draw(_commented_clause(hedge)) for hedge in clause.hedges),
    )


# Contexts -------------------------------------------------------------------------------------------------


@st.composite
def contexts(draw: st.DrawFn, ruleset: Ruleset) -> Context:
    """Situations for `ruleset`: any triggers, conditions true or false, and for measures values near those that the
    rules compare them with; some conditions and measures are left out."""
    conditions: dict[str, bool | int | Fraction | str] = {}
    for name in sorted(ruleset.conditions):
        if draw(st.booleans()):
            conditions[name] = draw(st.booleans())
    for name, measure in sorted(ruleset.measures.items()):
        if draw(st.integers(0, 5)) == 0:
            continue
        if measure.kind == "scale":
            conditions[name] = draw(st.sampled_from(measure.values))
        else:
            value = draw(st.sampled_from(_VALUES)) + draw(st.integers(-1, 1))
            conditions[name] = int(value) if measure.kind == "integer" else value
    triggers = draw(st.sets(st.sampled_from(sorted(ruleset.triggers))))
    return Context(frozenset(triggers), conditions)
