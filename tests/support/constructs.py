"""Which constructs a ruleset has, and in which positions: what random rulesets are counted by."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import (
    Assume,
    Atom,
    Calculation,
    Claim,
    Clause,
    Comparison,
    Constant,
    Declaration,
    Exclusive,
    Formula,
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
    Window,
    literals,
)
from sleec_runtime.model.relation import RELATIONS, relation_name

FEW, MANY = 3, 6


def constructs(ruleset: Ruleset) -> frozenset[str]:
    """The names of the constructs in `ruleset`. `few events` are up to 3, `many events` at least 6. Rules are contested
    if one names an act with NOT that another names without."""
    return frozenset(_of_ruleset(ruleset))


def _of_ruleset(ruleset: Ruleset) -> Iterator[str]:
    acts = {o.name for rule in ruleset.rules for clause in rule.clauses() for o in literals(clause)}
    yield f"{ruleset.reading} reading"
    events = len(ruleset.declared["event"])
    yield from ["few events"] * (events <= FEW) + ["many events"] * (events >= MANY)
    yield "contested" if _contested(ruleset) else "uncontested"
    if acts & {rule.trigger for rule in ruleset.rules}:
        yield "a response that triggers a rule"
    for statement in ruleset.statements:
        if isinstance(statement, Declaration) and statement.agent is not None:
            yield f"BY {statement.agent}"
            if statement.agent == "environment" and acts.intersection(statement.names):
                yield "a response of the environment"
        elif isinstance(statement, Constant):
            yield "CONSTANT"
        elif isinstance(statement, Rule):
            yield from _of_rule(statement, acts)
        elif isinstance(statement, Claim):
            yield from _of_claim(statement, acts)
        elif isinstance(statement, Never):
            yield "NEVER UNLESS" if statement.exceptions else "NEVER"
        elif isinstance(statement, (Exclusive, Assume)):
            yield type(statement).__name__.upper()
        elif isinstance(statement, RELATIONS):
            yield relation_name(statement)
        if getattr(statement, "domains", None) is not None:
            yield f"the domain of a {type(statement).__name__}"


def _contested(ruleset: Ruleset) -> bool:
    said = [{(o.name, o.negated) for clause in rule.clauses() for o in literals(clause)} for rule in ruleset.rules]
    return any((name, not negated) in other for one in said for name, negated in one for other in said if other != one)


def _of_rule(rule: Rule, acts: set[str]) -> Iterator[str]:
    if rule.always is not None:
        yield "ALWAYS"
    if rule.guard is not None:
        yield "a guard"
        yield from _of_formula(rule.guard, acts, "a guard")
    yield from _of_clause(rule.default, acts, "a rule")
    for hedge in rule.hedges:
        yield from _of_hedge(hedge, acts, "a rule")


def _of_claim(claim: Claim, acts: set[str]) -> Iterator[str]:
    yield f"a {claim.kind} with {claim.form}"
    if claim.condition is not None:
        yield from _of_formula(claim.condition, acts, "a claim")
    for response in claim.responses:
        yield from _of_clause(response, acts, "a claim")
    if claim.meanwhile is not None:
        yield "meanwhile"


def _of_clause(clause: Clause, acts: set[str], place: str) -> Iterator[str]:
    if len(clause.obligations) > 1:
        yield "several obligations"
    for obligation in clause.obligations:
        yield from _of_obligation(obligation, acts)
    for hedge in clause.hedges:
        yield from _of_hedge(hedge, acts, "a chain in parentheses" if place == "a rule" else place)


def _of_hedge(hedge: Clause, acts: set[str], place: str) -> Iterator[str]:
    yield f"a hedge of {place}" if hedge.obligations else f"a hedge without a response of {place}"
    assert hedge.condition is not None
    yield from _of_formula(hedge.condition, acts, f"a hedge of {place}")
    yield from _of_clause(hedge, acts, place)


def _of_obligation(obligation: Obligation, acts: set[str]) -> Iterator[str]:
    literal = "a prohibition" if obligation.negated else "an obligation"
    yield literal
    if obligation.timing is None:
        return
    if obligation.timing.window is not None:
        yield from (f"{part} of {literal}" for part in _of_window(obligation.timing.window))
    for word, alternative in (("OTHERWISE", obligation.timing.otherwise), ("ELSE", obligation.timing.instead)):
        if alternative is not None:
            yield f"{word} of {literal}"
            yield from _of_clause(alternative, acts, word)


def _of_window(window: Window) -> Iterator[str]:
    if window.end is None:
        yield "EVENTUALLY"
        return
    yield "WITHIN" if window.start is None else "WITHIN TO"
    if any(length is not None and length.measures for length in (window.start, window.end)):
        yield "a measured window"


def _of_formula(formula: Formula, acts: set[str], place: str) -> Iterator[str]:
    if isinstance(formula, Truth):
        yield "a constant of truth"
    elif isinstance(formula, Atom):
        if formula.kind == "trigger":
            yield f"{'an act' if formula.name in acts else 'an input'} in {place}"
    elif isinstance(formula, Comparison):
        yield from _of_comparison(formula)
    elif isinstance(formula, Not):
        yield "NOT"
        yield from _of_formula(formula.operand, acts, place)
    else:
        yield "OR" if isinstance(formula, Or) else "AND"
        for operand in formula.operands:
            yield from _of_formula(operand, acts, place)


def _of_comparison(comparison: Comparison) -> Iterator[str]:
    sides = (comparison.left, comparison.right)
    if any(isinstance(side, Calculation) for side in sides):
        yield "a calculation"
    elif any(isinstance(side, ScaleValue) for side in sides):
        yield "a scale"
    elif all(isinstance(side, MeasureRef) for side in sides):
        yield "two measures"
    else:
        yield "a number"
    if any(isinstance(side, Number) and side.constant for side in sides):
        yield "a named number"
