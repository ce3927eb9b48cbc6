"""Equation 1 with windows says what the evaluator decides, on random rulesets and situations.

Each form is read by something that did not write it: clauses by a solver, SMT-LIB by z3, and formulas by sympy.
"""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import combinations
from random import Random
from typing import Any

import pytest
import sympy
import z3

from sleec_runtime.evaluation.formula_truth import Situation, truth
from sleec_runtime.evaluation.hedge_chain import Decision, decide, decide_chain
from sleec_runtime.evaluation.instant_formulas import instant_formula
from sleec_runtime.model import (
    RELATIONS,
    Context,
    EventRelation,
    Exclusive,
    Lasting,
    Never,
    Ruleset,
)
from sleec_verify.encoding.calculations import calculations
from sleec_verify.encoding.solver import MiniSat
from sleec_verify.exchange.compilation import compile_to
from sleec_verify.exchange.compilation.equation_one import EquationOne
from sleec_verify.exchange.compilation.formulas import lines
from tests.support.random_traces import EVENTS, SCALE, random_cases


class Expected:
    """What a ruleset says of one instant, by the evaluator. `occurs` tells whether an event occurs in a window, given
    as the first and the last second."""

    def __init__(self, ruleset: Ruleset, context: Context, untimed, occurs) -> None:
        self.ruleset, self.context, self.untimed, self.occurs = ruleset, context, untimed, occurs
        self.values = {n: Fraction(v) for n, v in context.conditions.items() if not isinstance(v, (bool, str))}

    def window(self, obligation, due):
        window = None if obligation.timing is None else obligation.timing.window
        if window is None:
            return due, due if self.untimed == "at" else None
        first = due if window.start is None else due + window.start.seconds_where(self.values)
        return first, None if window.end is None else due + window.end.seconds_where(self.values)

    def met(self, obligation, due=Fraction(0)) -> bool:
        first, last = self.window(obligation, due)
        timing = obligation.timing
        if self.occurs(obligation.name, first, last) != obligation.negated:
            return True
        if timing is None:
            return False
        late = due if timing.window is None or last is None else last
        ways = [(timing.otherwise, late), (timing.instead, due)]
        return any(all(self.met(o, since) for o in self.active(way)) for way, since in ways if way is not None)

    def active(self, clause):
        decision = decide_chain(clause, Situation(self.context, self.ruleset.measures), self.ruleset.reading)
        assert isinstance(decision, Decision)
        return decision.obligations

    def rules(self) -> bool:
        decisions = [decide(r, self.context, self.ruleset.reading, self.ruleset.measures) for r in self.ruleset.rules]
        return all(self.met(o) for d in decisions if d is not None for o in d.obligations)

    def constraints(self) -> bool:
        now = {e: self.occurs(e, Fraction(0), Fraction(0)) for e in EVENTS}
        for constraint in self.ruleset.constraints:
            if isinstance(constraint, Exclusive):
                if any(now[a] and now[b] for a, b in combinations(constraint.names, 2)):
                    return False
            elif self.truth(constraint.formula, self.context, now) == isinstance(constraint, Never):
                return False
        return True

    def relations(self, due_now) -> bool:
        events = {*self.context.triggers, *(e for e in due_now if self.occurs(e, Fraction(0), Fraction(0)))}
        context = Context(frozenset(events), self.context.conditions)
        return all(
            self.truth(instant_formula(s), context, {e: e in events for e in EVENTS})
            for s in self.ruleset.statements
            if isinstance(s, RELATIONS) and not isinstance(s, Lasting)
            if not (isinstance(s, EventRelation) and s.relation == "happenBefore")
        )

    def truth(self, formula, context, obliged) -> bool:
        return bool(truth(formula, Situation(context, self.ruleset.measures, obliged=obliged)))


def value(text: str | None, values) -> Fraction | None:
    return None if text is None else Fraction(eval(text, {}, values))


def situations():
    """Random rulesets, each with total situations and truth values of windows."""
    for number, case in enumerate(random_cases(21, 400, traces=1)):
        if calculations(case.ruleset):
            continue
        random = Random(number)
        for _ in range(6):
            conditions: dict[str, Any] = {
                "patience": random.randint(-1, 3),
                "age": random.randint(0, 2),
                "risk": random.choice(SCALE),
            }
            conditions |= {name: random.random() < 0.5 for name in ("p", "q")}
            context = Context(frozenset(e for e in EVENTS if random.random() < 0.5), conditions)
            chosen: dict[Any, bool] = {}

            def occurs(event, first, last, chosen=chosen, random=random):
                return chosen.setdefault((event, first, last), random.random() < 0.5)

            yield case, context, occurs


def test_the_situations_cover_every_feature():
    seen = set()
    for case, context, occurs in situations():
        equation = EquationOne(case.ruleset, case.untimed)
        expected = Expected(case.ruleset, context, case.untimed, occurs)
        outcome = expected.rules(), expected.constraints(), expected.relations(equation.due_now)
        seen |= {f"{name} {holds}" for name, holds in zip(("rules", "constraints", "relations"), outcome)}
        seen |= {"no upper bound" for atom in equation.windows.values() if atom.last is None}
        seen |= {"measured" for atom in equation.windows.values() if "patience" in f"{atom.last}"}
        seen |= {"later" for atom in equation.windows.values() if atom.first != "0"}
        seen |= {excluded.name.split()[0] for excluded in equation.excluded()}
        for rule in case.ruleset.rules:
            for clause in rule.clauses():
                for o in clause.obligations:
                    if o.timing is not None:
                        seen |= {"otherwise"} if o.timing.otherwise is not None else set()
                        seen |= {"else"} if o.timing.instead is not None else set()
                        seen |= {"prohibition"} if o.negated else set()
    parts = {f"{name} {holds}" for name in ("rules", "constraints", "relations") for holds in (True, False)}
    assert seen == parts | {
        *("no upper bound", "measured", "later", "otherwise", "else", "prohibition", "happenBefore", "when"),
    }


def test_clauses_have_the_models_that_the_evaluator_allows():
    for case, context, occurs in situations():
        document = json.loads(compile_to(case.ruleset, "json", untimed=case.untimed))
        expected = Expected(case.ruleset, context, case.untimed, occurs)
        assumptions = []
        for entry in document["variables"]:
            if entry["kind"] == "obligation":
                event, (first, last) = entry.get("event", entry["name"]), entry.get("window", ("0", "0"))
                holds = occurs(event, value(first, expected.values), value(last, expected.values))
            elif entry["kind"] == "trigger":
                holds = entry["name"] in context.triggers
            elif entry["kind"] == "condition":
                holds = context.conditions[entry["name"]]
            elif entry["kind"] == "measure":
                holds = _compares(entry["name"], context)
            else:
                continue
            assumptions.append(entry["variable"] if holds else -entry["variable"])
        due_now = EquationOne(case.ruleset, case.untimed).due_now
        wanted = expected.rules() and expected.constraints() and expected.relations(due_now)
        with MiniSat(document["clauses"]) as solver:
            assert solver.solve(assumptions) == wanted, (case.ruleset, context)


def _compares(name: str, context: Context) -> bool:
    left, operator, right = name.split()
    sides = [_side(side, context) for side in (left, right)]
    return sides[0] < sides[1] if operator == "<" else sides[0] <= sides[1]


def _side(text: str, context: Context) -> Fraction:
    given = context.conditions.get(text, text)
    return Fraction(SCALE.index(given) if given in SCALE else given)


@pytest.mark.slow
@pytest.mark.parametrize("form", ["smtlib", "sympy"])
def test_formulas_are_true_where_the_evaluator_allows(form):
    for number, (case, context, occurs) in enumerate(situations()):
        if number % 6 > 1:
            continue
        ruleset, equation = case.ruleset, EquationOne(case.ruleset, case.untimed)
        expected = Expected(ruleset, context, case.untimed, occurs)
        truths = {equation.symbol("trigger", e): e in context.triggers for e in EVENTS}
        truths |= {name: context.conditions[name] for name in ("p", "q")}
        for name, (event, first, last) in equation.windows.items():
            truths[name] = occurs(event, value(first, expected.values), value(last, expected.values))
        for event in EVENTS:
            truths[equation.symbol("obligation", event)] = occurs(event, Fraction(0), Fraction(0))
        numbers = {"age": context.conditions["age"], "patience": context.conditions["patience"]}
        numbers["risk"] = SCALE.index(context.conditions["risk"])
        wanted = expected.rules() and expected.constraints() and expected.relations(equation.due_now)
        if form == "smtlib":
            solver = z3.Solver()
            solver.from_string(compile_to(ruleset, "smtlib", untimed=case.untimed))
            solver.add(*(z3.Bool(name) == holds for name, holds in truths.items()))
            solver.add(*(z3.Int(name) == amount for name, amount in numbers.items()))
            assert (solver.check() == z3.sat) == wanted, (ruleset, context)
        else:
            names = {**truths, **numbers, **{name: rank for rank, name in enumerate(SCALE)}}
            where = {sympy.Symbol(name): sympy.sympify(given) for name, given in names.items()}
            found = [line.formula.subs(where).doit() for line in lines(equation)]
            assert set(found) <= {sympy.true, sympy.false}
            assert all(found) == wanted, (ruleset, context)
