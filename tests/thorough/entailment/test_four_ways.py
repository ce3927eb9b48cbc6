"""What is due in a context, answered four ways: a truth table of Equation 1, sympy, the solver, direct evaluation."""

from __future__ import annotations

from itertools import islice, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.evaluation import due as evaluation
from sleec_runtime.model import Atom, Comparison, Obligation, Ruleset, leaves
from sleec_verify.encoding.equation import implications
from sleec_verify.encoding.solver import MiniSat
from sleec_verify.entailment.definition1 import Definition1
from sleec_verify.entailment.entailment import entail
from sleec_verify.exchange.compilation.clauses import encode_ruleset
from sleec_verify.exchange.compilation.equation_one import EquationOne
from sleec_verify.exchange.compilation.formulas import Translator, lines
from tests.support import brute_force as brute
from tests.support.small_rulesets import small_rulesets

SMALL = small_rulesets(constraints=False, assumptions=False, rules=2)


def truth_table(ruleset: Ruleset, context) -> frozenset[Obligation] | None:
    """Definition 1 to the letter: the literals that every model of Equation 1 and χ makes true; None without models."""
    names = sorted(ruleset.obligations)
    models = []
    for chosen in product((False, True), repeat=len(names)):
        done = {name for name, yes in zip(names, chosen) if yes}
        if all(
            not brute.value(guard, context, measures=ruleset.measures)
            or all((o.name in done) != o.negated for o in clause.obligations)
            for rule in ruleset.rules
            for _, guard, clause in implications(rule, ruleset.reading)
        ):
            models.append(done)
    if not models:
        return None
    return frozenset(
        Obligation(name, negated)
        for name in names
        for negated in (False, True)
        if all((name in done) != negated for done in models)
    )


def by_sympy(ruleset: Ruleset, context) -> frozenset[Obligation] | None:
    """Definition 1 by sympy: which literals the compiled formulas entail once the context is put in."""
    import sympy
    from sympy.logic.inference import satisfiable

    equation = EquationOne(ruleset)
    atoms = [Atom("trigger", name) for name in ruleset.triggers]
    atoms += [Atom("condition", name) for name in ruleset.conditions]
    values = {
        sympy.Symbol(equation.symbol(atom.kind, atom.name)): sympy.true if brute.value(atom, context) else sympy.false
        for atom in atoms
    }
    formula = sympy.And(*(line.formula.subs(values) for line in lines(equation)))
    if not satisfiable(formula):
        return None
    found = set()
    for name in ruleset.obligations:
        variable = sympy.Symbol(equation.symbol("obligation", name))
        for negated in (False, True):
            if not satisfiable(sympy.And(formula, variable if negated else sympy.Not(variable))):
                found.add(Obligation(name, negated))
    return frozenset(found)


def directly(ruleset: Ruleset, context) -> frozenset[Obligation] | None:
    due = brute.due(ruleset, context)
    return None if any(Obligation(o.name, not o.negated) in due for o in due) else due


@settings(max_examples=60, deadline=None)
@given(SMALL, st.integers(0, 31))
def test_four_ways_agree(ruleset, skip):
    definition = Definition1(ruleset)
    for context in islice(brute.contexts(ruleset), skip % 7, None, 7):
        expected = directly(ruleset, context)
        assert truth_table(ruleset, context) == expected
        assert definition.entailed(context) == expected
        assert by_sympy(ruleset, context) == expected
        assert frozenset(evaluation.due(ruleset, context).literals) == brute.due(ruleset, context)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(small_rulesets(measures=True, rules=2))
def test_propagation_and_evaluation_agree_on_measures(ruleset):
    definition = Definition1(ruleset)
    for context in islice(brute.contexts(ruleset), 0, None, 37):
        assert definition.entailed(context) == directly(ruleset, context)
        assert frozenset(evaluation.due(ruleset, context).literals) == brute.due(ruleset, context)


@settings(max_examples=100, deadline=None)
@given(small_rulesets(measures=True, rules=3))
def test_entail_is_definition_1_and_the_constraints(ruleset):
    for context in islice(brute.contexts(ruleset), 0, None, 101):
        answer = entail(ruleset, context)
        due = brute.due(ruleset, context)
        assert answer.consistent == (not brute.conflicts(ruleset, context))
        assert not answer.broken_assumptions
        if answer.consistent:
            assert set(answer.obligations) == {o.name for o in due if not o.negated}
            assert set(answer.prohibitions) == {o.name for o in due if o.negated}
            for consequence in answer.consequences:
                literal = consequence.literal
                assert brute.clash(ruleset, context, due | {Obligation(literal.name, not literal.negated)})
        else:
            assert answer.conflicts
            assert answer.obligations == ()
        assert {(b.rule, b.clause) for b in answer.because} == {
            (label, number) for label, number, _ in brute.active_clauses(ruleset, context)
        }


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(small_rulesets(measures=True, rules=3))
def test_nothing_is_given_to_measures_without_a_value(ruleset):
    for context in islice(brute.contexts(ruleset), 0, None, 211):
        without = type(context)(context.triggers, {k: v for k, v in context.conditions.items() if isinstance(v, bool)})
        due = brute.due(ruleset, without)
        assert {(b.rule, b.clause) for b in entail(ruleset, without).because} == {
            (label, number) for label, number, _ in brute.active_clauses(ruleset, without)
        }
        assert frozenset(evaluation.due(ruleset, without).literals) == due


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(small_rulesets(rules=2, measures=True))
def test_the_linear_clauses_say_what_the_written_out_formulas_say(ruleset):
    """Over the original names, the clauses with prefix variables have the models of Equation 1 written out."""
    encoder = encode_ruleset(EquationOne(ruleset))
    names = sorted(ruleset.obligations)
    with MiniSat(encoder.clauses) as solver:
        for context in islice(brute.contexts(ruleset), 0, None, 97):
            fixed = encoder.assumptions(context)
            for chosen in product((False, True), repeat=len(names)):
                done = frozenset(name for name, yes in zip(names, chosen) if yes)
                literals = [
                    v if name in done else -v
                    for name in names
                    for v in [encoder.variables.get(("obligation", name))]
                    if v is not None
                ]
                written_out = all(
                    not brute.value(guard, context, measures=ruleset.measures)
                    or all((o.name in done) != o.negated for o in clause.obligations)
                    for rule in ruleset.rules
                    for _, guard, clause in implications(rule, ruleset.reading)
                ) and all(brute.is_satisfied(c, ruleset, context, done) for c in ruleset.constraints)
                assert solver.solve([*fixed, *literals]) == written_out


@pytest.mark.parametrize("reading", ["cascade", "priority"])
@pytest.mark.parametrize("hedges", [1, 10, 100])
def test_clauses_are_linear_in_the_hedges(reading, hedges):
    from sleec_runtime.language import parse

    text = "WHEN t THEN o" + "".join(f"\nUNLESS c{n} IN WHICH CASE p{n}" for n in range(hedges))
    encoder = encode_ruleset(EquationOne(parse(text).read_as(reading)))
    assert sum(map(len, encoder.clauses)) <= 40 * hedges


@pytest.mark.slow
@given(small_rulesets(measures=True))
def test_sympy_formulas_read_as_the_guards_do(ruleset):
    """The written-out formulas hold a symbol for every name that the guard does."""
    translate = Translator(EquationOne(ruleset))
    for rule in ruleset.rules:
        for _, guard, _ in implications(rule, ruleset.reading):
            for leaf in leaves(guard):
                assert isinstance(leaf, Comparison) or str(translate(leaf)) == leaf.name
