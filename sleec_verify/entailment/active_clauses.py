"""The clauses that decide in one context, and what Definition 1 entails of them.

With the context total and every response a conjunction of literals, unit propagation alone decides it: one
propagation over Equation 1 gives every entailed obligation. In an inconsistent context, Definition 1
entails everything; this is reported as a conflict with its rules.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from sleec_runtime.model import Clause, Context, Exclusive, Formula, Obligation, Relation, Rule, Ruleset, Span
from sleec_verify.checks.conflict import conflict_in
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.response_windows import ResponseWindows
from sleec_verify.encoding.solver import MiniSat
from sleec_verify.entailment.alternatives import has_alternative, ways_of, ways_text, when_text
from sleec_verify.entailment.answer import (
    ActiveClause,
    Alternative,
    ConditionValue,
    Consequence,
    DueLiteral,
    Entailment,
)
from sleec_verify.entailment.definition1 import Definition1
from sleec_verify.entailment.situation_feasibility import SituationLaw, check_feasibility
from sleec_verify.query.names import names_in, names_of_rule, obligations_in
from sleec_verify.query.prime_implicates import inconsistent_sets
from sleec_verify.query.ruleset_index import ClausePosition, RulesetIndex
from sleec_verify.results.finding import Witness


def active_clauses(ruleset: Ruleset, context: Context) -> Entailment:
    """The clauses that decide in `context`, and what Definition 1 entails of their obligations without a window or
    alternatives.

    Only the rules of the triggers that occur are encoded. Events that do not occur in `context` count as false in
    conditions. Raises `Undecided` if the solver cannot decide within its budget whether the constraints allow what is
    due.
    """
    whole = ruleset
    stated = {rule.label: rule for rule in ruleset.rules if rule.trigger in context.triggers}
    related: list[tuple[Relation, Formula]] = []
    if ruleset.is_timed:
        from sleec_verify.encoding.relations import relations_on_situations
        from sleec_verify.encoding.without_time import without_time

        related = list(relations_on_situations(ruleset))
        ruleset = without_time(ruleset)
    rules = [rule for rule in ruleset.rules if rule.trigger in context.triggers]
    index = RulesetIndex(ruleset)
    ruled_out = inconsistent_sets(
        index.constraints, {o for rule in rules for c in rule.clauses() for o in c.obligations}
    )
    labels = list(dict.fromkeys(label for clash in ruled_out.listed for label in clash.labels))
    conditions = [formula for rule in rules for formula, _, _ in _conditions(rule)]
    assumed = [assumption.formula for assumption in index.assumptions]
    named = [name for rule in rules for name in names_of_rule(rule)]
    named += [name for formula in assumed for name in names_in(formula)]
    missing = {n for _, n in named if n in ruleset.measures and n not in context.conditions}

    formulas = [*conditions, *labels, *assumed, *(formula for _, formula in related)]
    definition = Definition1(ruleset, rules, formulas, frozenset(ruleset.measures) - set(context.conditions))
    true = definition.facts(context)
    truth = {id(formula): true(literal) for formula, literal in zip(formulas, definition.formulas)}
    # Equal labels of several constraints were asked about once.
    come_true = {label for label in labels if truth[id(label)]}

    laws = [*((one, one.formula) for one in index.assumptions), *related]
    situation = check_feasibility(
        [SituationLaw(law, formula, truth[id(formula)]) for law, formula in laws], context, ruleset.measures
    )

    position = {rule.label: p for p, rule in enumerate(index.rules)}
    active = [
        ClausePosition(position[rule.label], number)
        for rule, guards in definition.guards
        for number, guard in enumerate(guards)
        if true(guard)
    ]
    due = definition.entailed(context)
    obliged = {o for place in active for o in index.clauses[place.rule][place.number].obligations}
    witness = Witness(tuple(sorted(context.triggers)), dict(context.conditions))
    conflicts = tuple(conflict_in(index, active, ruled_out, come_true, witness))
    consistent = due is not None and not conflicts
    later = [
        o
        for place in active
        for o in _clause(stated[index.rules[place.rule].label], place.number)
        if o.timing and not has_alternative(o)
    ]
    due = frozenset((due or frozenset()) | set(later))
    windows = ResponseWindows(whole, context, "at")
    because = [
        _because(windows, stated[index.rules[place.rule].label], place.number, ruleset.reading, truth)
        for place in active
    ]
    return Entailment(
        consistent=consistent,
        obligations=tuple(sorted({o.name for o in due if not o.negated})) if consistent else (),
        prohibitions=tuple(sorted({o.name for o in due if o.negated})) if consistent else (),
        because=tuple(one for one, _ in because),
        consequences=tuple(_consequences(index, obliged, context)) if consistent else (),
        conflicts=conflicts,
        broken_assumptions=situation.broken,
        unsettled=situation.unsettled,
        possible=situation.possible,
        missing=tuple(sorted(missing)),
        timed=tuple(later),
        alternatives=tuple(alternative for _, alternatives in because for alternative in alternatives),
    )


def _conditions(rule: Rule) -> Iterator[tuple[Formula, int | None, Span]]:
    if rule.guard is not None:
        yield rule.guard, None, rule.guard.span
    for number, clause in enumerate(rule.clauses()):
        if clause.condition is not None:
            yield clause.condition, number, clause.condition.span


def _clause(rule: Rule, number: int) -> tuple[Obligation, ...]:
    return list(rule.clauses())[number].obligations


def _because(
    windows: ResponseWindows, rule: Rule, number: int, reading: str, truth: dict[int, bool]
) -> tuple[ActiveClause, list[Alternative]]:
    """An active clause, and its obligations with alternatives."""
    clause = list(rule.clauses())[number]
    decided = []
    if rule.guard is not None:
        decided.append(ConditionValue(rule.guard, True, None, rule.guard.span))
    for hedge, at in _looked_at(rule, reading, truth):
        assert hedge.condition is not None, "only hedges are looked at"
        decided.append(ConditionValue(hedge.condition, truth[id(hedge.condition)], at, hedge.condition.span))
    obligations = tuple(str(o) for o in clause.obligations)
    times = tuple(str(o.timing) if o.timing is not None else "" for o in clause.obligations)
    ways = ways_of(windows, clause) if any(map(has_alternative, clause.obligations)) else []
    choices = tuple(ways_text(one) if len(one) > 1 else "" for one in ways) or ("",) * len(obligations)
    because = ActiveClause(
        rule.label, number, rule.layer(number), obligations, tuple(decided), clause.span, times, choices
    )
    return because, [
        Alternative(
            rule.label,
            number,
            ways_text(one),
            tuple(
                tuple(
                    DueLiteral(part.obligation.name, part.obligation.negated, when_text(part), part.overdue)
                    for part in way
                )
                for way in one
            ),
        )
        for one in ways
        if len(one) > 1
    ]


def _looked_at(rule: Rule, reading: str, truth: dict[int, bool]) -> list[tuple[Clause, int]]:
    """The hedges whose conditions decide which clause is active, in the order of the text."""
    looked: list[tuple[Clause, int]] = []
    numbers = {id(clause): number for number, clause in enumerate(rule.clauses())}

    def chain(default: Clause, hedges: Sequence[Clause], top: bool) -> None:
        deciding = default
        walk = hedges if reading == "cascade" else hedges[::-1]
        for hedge in walk:
            looked.append((hedge, numbers[id(hedge)]))
            held = truth[id(hedge.condition)]
            if held:
                deciding = hedge
            if held != (reading == "cascade"):
                break
        if deciding.hedges and (top or deciding is not default):
            chain(deciding, deciding.hedges, top=False)

    chain(rule.default, rule.hedges, top=True)
    return sorted(looked, key=lambda pair: pair[1])


def _consequences(index: RulesetIndex, due: set[Obligation], context: Context) -> Iterator[Consequence]:
    """The literals that follow from what is due and the constraints, but that no rule requires. Needs two questions
    for each obligation that shares a constraint with what is due."""
    names = {literal.name for literal in due}
    constraints = index.constraints_about(names)
    tied = sorted({name for constraint in constraints for name in obligations_in(constraint)} - names)
    if not tied:
        return
    measures = index.ruleset.measures
    encoder = Encoder(measures, frozenset(measures) - set(context.conditions))
    kept = {}
    for constraint in constraints:
        in_force = encoder.fresh()
        kept[in_force] = constraint
        if isinstance(constraint, Exclusive):
            for a, b in combinations(sorted(set(constraint.names)), 2):
                encoder.clauses.append(
                    [-in_force, -encoder.obligation(Obligation(a)), -encoder.obligation(Obligation(b))]
                )
        else:
            encoder.clauses.append([-in_force, -encoder.literal(constraint.formula)])
    encoder.close()
    given = [encoder.obligation(literal) for literal in sorted(due, key=str)] + encoder.assumptions(context)
    with MiniSat(encoder.clauses) as solver:
        for name in tied:
            for negated in (False, True):
                refuted = -encoder.obligation(Obligation(name, negated))
                if solver.solve([refuted, *given, *kept]) is False:
                    core = set(solver.core())
                    origins = tuple(constraint for literal, constraint in kept.items() if literal in core)
                    yield Consequence(Obligation(name, negated), origins)
