"""Small random rulesets that clash, repeat and contradict themselves often, for comparison with brute force."""

from __future__ import annotations

from hypothesis import strategies as st

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Exclusive,
    Measure,
    MeasureRef,
    Never,
    Not,
    Number,
    Obligation,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Truth,
)

TRIGGERS = ("t1", "t2")
CONDITIONS = ("c1", "c2", "c3")
OBLIGATIONS = ("o1", "o2", "o3")
SCALE = ("low", "middle", "high")
OPERATORS = ("<", "<=", "=", "!=", ">=", ">")


def formulas(leaves, depth=2):
    return st.recursive(
        leaves,
        lambda inner: st.one_of(
            inner.map(Not),
            st.lists(inner, min_size=2, max_size=3).map(lambda parts: And(tuple(parts))),
            st.lists(inner, min_size=2, max_size=3).map(lambda parts: Or(tuple(parts))),
        ),
        max_leaves=depth + 1,
    )


booleans = st.sampled_from(CONDITIONS).map(lambda name: Atom("condition", name))
_events = st.sampled_from(TRIGGERS).map(lambda name: Atom("trigger", name))
_operators = st.sampled_from(OPERATORS)
numeric = st.builds(Comparison, st.just(MeasureRef("x")), _operators, st.sampled_from((1, 2)).map(Number))
flipped = st.builds(Comparison, st.sampled_from((1, 2)).map(Number), _operators, st.just(MeasureRef("x")))
pairs = st.builds(Comparison, st.just(MeasureRef("x")), _operators, st.just(MeasureRef("y")))
scales = st.builds(
    Comparison,
    st.just(MeasureRef("s")),
    _operators,
    st.sampled_from(range(3)).map(lambda rank: ScaleValue(SCALE[rank], rank)),
)
_truths = st.booleans().map(Truth)

MEASURES = (Measure("x", "number"), Measure("y", "integer"), Measure("s", "scale", SCALE))


@st.composite
def small_rulesets(draw, measures=False, constraints=True, assumptions=True, rules=4, hedges=2, nested=True):
    leaves = st.one_of(booleans, booleans, _events, _truths)
    if measures:
        leaves = st.one_of(booleans, _events, numeric, flipped, scales, pairs)
    conditions = formulas(leaves, 1)
    literals = st.builds(Obligation, st.sampled_from(OBLIGATIONS), st.sampled_from((False, False, True)))
    responses = st.lists(literals, min_size=1, max_size=2, unique=True).map(tuple)

    def hedge(inner):
        return st.builds(Clause, conditions, st.one_of(responses, st.just(())), inner)

    plain = hedge(st.just(()))
    chain = st.lists(hedge(st.lists(plain, max_size=1).map(tuple)) if nested else plain, max_size=hedges).map(tuple)
    found = []
    for number in range(draw(st.integers(1, rules))):
        default = Clause(None, draw(responses), draw(st.lists(plain, max_size=1).map(tuple)) if nested else ())
        guard = draw(st.one_of(st.none(), st.none(), conditions))
        found.append(Rule(f"r{number}", draw(st.sampled_from(TRIGGERS)), guard, default, draw(chain)))
    statements: list[Statement] = list(MEASURES if measures else ())
    if constraints:
        tied = draw(st.sampled_from(OBLIGATIONS).map(lambda name: Atom("obligation", name)))
        obligations = st.sampled_from(OBLIGATIONS).map(lambda name: Atom("obligation", name))
        never = formulas(st.one_of(obligations, obligations, leaves), 2).map(lambda f: And((f, tied)))
        exclusive = st.lists(st.sampled_from(OBLIGATIONS), min_size=2, max_size=3, unique=True)
        statements += [Exclusive(tuple(names)) for names in draw(st.lists(exclusive, max_size=1))]
        statements += [Never(formula) for formula in draw(st.lists(never, max_size=2))]
    if assumptions:
        situations = st.one_of(leaves, _events)
        statements += [Assume(formula) for formula in draw(st.lists(formulas(situations, 1), max_size=2))]
    return Ruleset((*statements, *found), reading=draw(st.sampled_from(("cascade", "priority"))))
