"""Whether a situation of which not all is given can be."""

from __future__ import annotations

from itertools import combinations, product

import pytest

from sleec_runtime.evaluation.due import broken_assumptions
from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_verify.encoding.relations import relations_on_situations
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.situation_text import parse_situation
from sleec_verify.report.entailment import caveats
from sleec_verify.report.palette import PLAIN

TEXT = """MEASURE level: low < middle < high
MEASURE n: integer
RELATION ALWAYS p IMPLIES level = high
RELATION ALWAYS q EQUALS n > 7
RELATION ALWAYS r IMPLIES s
RELATION A INCLUDES n < 9
RELATION B FORBIDS s
ASSUME NOT (t AND level = low)
ASSUME n >= 0
RULE r1 WHEN A AND level > low THEN C
RULE r2 WHEN B AND q THEN C
RULE r3 WHEN A AND r THEN C UNLESS s AND t
"""
RULESET = parse(TEXT)
LEVELS, NUMBERS = ("low", "middle", "high"), range(-1, 11)


def cannot_be(triggers, conditions):
    """Whether the evaluator finds a situation of which all is given ruled out."""
    context = Context(frozenset(triggers), conditions)
    related = (holds(formula, context, RULESET.measures) for _, formula in relations_on_situations(RULESET))
    return bool(broken_assumptions(RULESET, context)) or not all(related)


@pytest.mark.slow
@pytest.mark.parametrize("triggers", ["", "A", "AB"])
@pytest.mark.parametrize("measures", [{}, {"level": "low"}, {"n": 8}, {"n": 9}, {"level": "high", "n": 3}])
def test_all_situations(triggers, measures):
    """A situation cannot be if it cannot with any values of the measures that are not given, and what is told to be
    given instead is enough, with no condition more than is needed."""
    for given in product([None, True, False], repeat=5):
        conditions = {name: value for name, value in zip("pqrst", given) if value is not None}
        answer = entail(RULESET, Context(frozenset(triggers), {**conditions, **measures}))

        total = {**dict.fromkeys("pqrst", False), **conditions, **measures}

        def never(true=(), triggers=triggers, total=total, measures=measures):
            # The conditions that are not given are false.
            free = ({"level": level, "n": n} for level, n in product(LEVELS, NUMBERS))
            return all(cannot_be(triggers, {**total, **dict.fromkeys(true, True), **each, **measures}) for each in free)

        assert bool(answer.broken_assumptions) == never()
        # The evaluator, too, takes comparisons with what has no value for false.
        assert bool(answer.unsettled) == (not never() and cannot_be(triggers, total))
        possible = dict(answer.possible)
        if possible:
            again = entail(RULESET, Context(frozenset(triggers), {**conditions, **measures, **possible}))
            assert not again.broken_assumptions
            true = [name for name, value in possible.items() if value is True]
            assert all(never([other for other in true if other != name]) for name in true)
        elif answer.broken_assumptions and given.count(None) < 3:
            open_ones = [name for name in "pqrst" if name not in conditions]
            assert all(never(some) for size in range(3) for some in combinations(open_ones, size))


def said(when, given):
    return list(caveats(RULESET, entail(RULESET, parse_situation(RULESET, when, given)), PLAIN))


def test_a_measure_that_a_relation_asks_for():
    warning, help_, note, *_ = said("A", "p, n=3")
    assert warning.startswith("warning: `level` is not given; if every comparison with it is false, this situation")
    assert "by RELATION (line 3)" in warning
    assert help_ == "help: give it, for example level=high"
    assert note == "note: `level` is not given, so every comparison with it counts as false"


def test_a_condition_that_is_not_given_and_has_to_be_true():
    warning, help_, *_ = said("A", "r, level=high, n=3")
    assert "this situation is excluded by RELATION (line 5)" in warning
    assert help_ == "help: names that are not given count as false; add s"
    assert not any(line.startswith("help") for line in said("A", "r, not s, level=high, n=3"))
