"""Diagrams count what brute force counts, and equal formulas are one node."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.model import Comparison, Measure, MeasureRef, Never, Not, Number, Ruleset
from sleec_verify.changes.diagram import decision_diagram
from sleec_verify.changes.diagram.decision_diagram import FALSE, TRUE, TooLarge
from sleec_verify.changes.diagram.formulas import FormulaDiagram
from tests.support import brute_force as brute
from tests.support.small_rulesets import CONDITIONS, MEASURES, booleans, flipped, formulas, numeric, pairs, scales

LEAVES = st.one_of(booleans, numeric, flipped, scales, pairs)
FORMULAS = formulas(LEAVES, 4)
MEASURED = {measure.name: measure for measure in MEASURES}


def told_apart(made: FormulaDiagram, context):
    said = []
    for variable in made.variables:
        for _, name in variable.names:
            if not variable.cuts:
                said.append(context.conditions.get(name, False))
        for name, cuts in variable.cuts:
            value = context.conditions[name]
            said.append(sum(value > c.value or (value == c.value and not c.inclusive) for c in cuts))
        for x, y in variable.orders:
            a, b = context.conditions[x], context.conditions[y]
            said.append((a > b) - (a < b))
    return tuple(said)


@settings(max_examples=60)
@given(FORMULAS, FORMULAS)
def test_counts_and_equality(one, other) -> None:
    made = FormulaDiagram([one, other], MEASURED)
    every = list(brute.contexts(Ruleset((*MEASURES, Never(one), Never(other)))))
    nodes = [made.node(formula) for formula in (one, other)]
    over = set(range(len(made.variables)))
    true = [{told_apart(made, c) for c in every if brute.value(f, c, measures=MEASURED)} for f in (one, other)]
    for node, where in zip(nodes, true):
        assert made.count(node, over) == len(where)
    assert (nodes[0] == nodes[1]) == (true[0] == true[1])
    assert made.count(made.both(*nodes), over) == len(true[0] & true[1])
    assert made.count(TRUE, over) == len({told_apart(made, c) for c in every})


@settings(max_examples=60)
@given(FORMULAS)
def test_what_can_be_chosen(formula) -> None:
    made = FormulaDiagram([formula], MEASURED)
    kept = {at for at, variable in enumerate(made.variables) if variable.names[0][1] in CONDITIONS[:2]}
    projected = made.some(made.node(formula), kept)
    assert made.support(projected) <= kept
    names = [made.variables[at].names[0][1] for at in sorted(kept)]
    true = {
        tuple(context.conditions[name] for name in names)
        for context in brute.contexts(Ruleset((*MEASURES, Never(formula))))
        if brute.value(formula, context, measures=MEASURED)
    }
    assert made.count(projected, kept) == len(true)


def test_a_formula_and_its_negation() -> None:
    formula = Comparison(MeasureRef("x"), "<", Number(2))
    made = FormulaDiagram([formula], MEASURED)
    assert made.both(made.node(formula), made.node(Not(formula))) == FALSE


def test_bounds_are_stated(monkeypatch: pytest.MonkeyPatch) -> None:
    names = [Measure(f"n{i}", "number") for i in range(6)]
    pairs = [Comparison(MeasureRef(a.name), "<", MeasureRef(b.name)) for a in names for b in names if a.name < b.name]
    with pytest.raises(TooLarge, match="more than 2,000 orders"):
        FormulaDiagram(pairs, {measure.name: measure for measure in names})
    monkeypatch.setattr(decision_diagram, "MOST_NODES", 3)
    made = FormulaDiagram(pairs[:1], {measure.name: measure for measure in names})
    with pytest.raises(TooLarge, match="more than 3 nodes"):
        made.opposite(made.node(pairs[0]))
