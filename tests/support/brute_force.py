"""The meaning of rules by brute force: every context, one after the other, with nothing borrowed from the product
but its values. Slow, short, and written to be obviously right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, pairwise, product

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Context,
    Exclusive,
    MeasureRef,
    Never,
    Not,
    Number,
    Obligation,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Truth,
    Value,
    formulas_of,
    leaves,
)


def value(formula, context, done=frozenset(), measures=None):
    """The truth of a formula where `done` are the obligations that are done."""
    if isinstance(formula, Truth):
        return formula.value
    if isinstance(formula, Not):
        return not value(formula.operand, context, done, measures)
    if isinstance(formula, And):
        return all(value(o, context, done, measures) for o in formula.operands)
    if isinstance(formula, Or):
        return any(value(o, context, done, measures) for o in formula.operands)
    if isinstance(formula, Atom):
        if formula.kind == "trigger":
            return formula.name in context.triggers
        if formula.kind == "obligation":
            return formula.name in done
        return context.conditions.get(formula.name, False) is True
    assert isinstance(formula, Comparison)
    sides = [_side(side, context, measures) for side in (formula.left, formula.right)]
    if None in sides:
        return False
    a, b = sides
    return {"<": a < b, "<=": a <= b, "=": a == b, "!=": a != b, ">=": a >= b, ">": a > b}[formula.operator]


def _side(side, context, measures):
    if isinstance(side, Number):
        return side.value
    if isinstance(side, ScaleValue):
        return side.rank
    given = context.conditions.get(side.name)
    return measures[side.name].values.index(given) if isinstance(given, str) else given


def active(rule: Rule, ruleset: Ruleset, context: Context, reading=None) -> int | None:
    """The number of the clause that decides, or None where the rule is not triggered."""
    reading = reading or ruleset.reading
    if rule.trigger not in context.triggers:
        return None
    if rule.guard is not None and not value(rule.guard, context, measures=ruleset.measures):
        return None
    numbers = {id(clause): number for number, clause in enumerate(rule.clauses())}

    def chain(default: Clause, hedges) -> Clause:
        true = [value(h.condition, context, measures=ruleset.measures) for h in hedges]
        if reading == "cascade":
            length = 0
            while length < len(hedges) and true[length]:
                length += 1
            winner = length
        else:
            winner = max((n + 1 for n, t in enumerate(true) if t), default=0)
        return hedges[winner - 1] if winner else default

    clause = chain(rule.default, rule.hedges)
    while clause.hedges:
        inner = chain(clause, clause.hedges)
        if inner is clause:
            break
        clause = inner
    return numbers[id(clause)]


def active_clauses(ruleset: Ruleset, context: Context, reading=None) -> list[tuple[str, int, Clause]]:
    found = []
    for rule in ruleset.rules:
        number = active(rule, ruleset, context, reading)
        if number is not None:
            found.append((rule.label, number, list(rule.clauses())[number]))
    return found


def due(ruleset: Ruleset, context: Context, reading=None) -> frozenset[Obligation]:
    return frozenset(o for _, _, clause in active_clauses(ruleset, context, reading) for o in clause.obligations)


def clash(ruleset: Ruleset, context: Context, literals) -> bool:
    """Whether no choice of what is done keeps all literals and constraints."""
    names = sorted({o.name for o in literals} | ruleset.obligations)
    for chosen in product((False, True), repeat=len(names)):
        done = frozenset(name for name, yes in zip(names, chosen) if yes)
        if all((o.name in done) != o.negated for o in literals) and all(
            is_satisfied(constraint, ruleset, context, done) for constraint in ruleset.constraints
        ):
            return False
    return True


def is_satisfied(constraint, ruleset, context, done) -> bool:
    if isinstance(constraint, Exclusive):
        return sum(name in done for name in set(constraint.names)) <= 1
    if isinstance(constraint, Never):
        return not value(constraint.formula, context, done, ruleset.measures)
    return True


def conflicts(ruleset: Ruleset, context: Context) -> bool:
    return clash(ruleset, context, due(ruleset, context))


def causes(ruleset: Ruleset) -> set[frozenset[tuple[str, int]]]:
    """Every minimal set of clauses that clash in some context."""
    found = set()
    for context in contexts(ruleset):
        deciding = active_clauses(ruleset, context)
        minimal: list[frozenset[int]] = []
        for size in range(len(deciding) + 1):
            for chosen in combinations(range(len(deciding)), size):
                if any(smaller <= set(chosen) for smaller in minimal):
                    continue
                literals = {o for n in chosen for o in deciding[n][2].obligations}
                if clash(ruleset, context, literals):
                    minimal.append(frozenset(chosen))
        found |= {frozenset(deciding[n][:2] for n in chosen) for chosen in minimal}
    return found


def contexts(ruleset: Ruleset) -> Iterator[Context]:
    """Every context that the assumptions allow, with enough values of each measure to tell all regions apart."""
    triggers, conditions = sorted(ruleset.triggers), sorted(ruleset.conditions)
    measures = sorted(ruleset.measures)
    for occur in product((False, True), repeat=len(triggers)):
        for true in product((False, True), repeat=len(conditions)):
            for values in product(*(values_of(ruleset, name) for name in measures)):
                context = Context(
                    frozenset(name for name, yes in zip(triggers, occur) if yes),
                    {**dict(zip(conditions, true)), **dict(zip(measures, values))},
                )
                if all(
                    value(c.formula, context, measures=ruleset.measures)
                    for c in ruleset.constraints
                    if isinstance(c, Assume)
                ):
                    yield context


def values_of(ruleset: Ruleset, name: str) -> Sequence[Value]:
    measure = ruleset.measures[name]
    if measure.kind == "scale":
        return list(measure.values)
    constants = {
        side.value
        for formula in _formulas(ruleset)
        for leaf in leaves(formula)
        if isinstance(leaf, Comparison)
        for side in (leaf.left, leaf.right)
        if isinstance(side, Number)
    }
    compared = any(
        isinstance(leaf, Comparison) and isinstance(leaf.left, MeasureRef) and isinstance(leaf.right, MeasureRef)
        for formula in _formulas(ruleset)
        for leaf in leaves(formula)
    )
    points = sorted(constants) or [0]
    if measure.kind == "integer":
        return sorted({int(p // 1) + d for p in points for d in (-2, -1, 0, 1, 2)})
    between = [Fraction(a + b) / 2 for a, b in pairwise(points)]
    if compared:
        # Two or three numbers compared with one another need as many places between two constants.
        between = [a + Fraction((b - a) * k, 4) for a, b in pairwise(points) for k in (1, 2, 3)]
        return [points[0] - 2, points[0] - 1, *points, *between, points[-1] + 1, points[-1] + 2]
    return [points[0] - 1, *points, *between, points[-1] + 1]


def _formulas(ruleset: Ruleset):
    for rule in ruleset.rules:
        yield from formulas_of(rule)
    for constraint in ruleset.constraints:
        if isinstance(constraint, (Never, Assume)):
            yield constraint.formula
