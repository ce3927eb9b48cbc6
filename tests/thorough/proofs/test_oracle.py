"""Algorithm 1, Definition 1 and the conflicts of a context, in Python, say what is extracted from the theory says.

One comparison is one context of one ruleset: what is due there and by which clauses (`evaluation.due`), what
is entailed, all at once and a literal to the letter (`entailment.entailment.Definition1`), whether the context counts
and whether it conflicts (`evaluation.conflicts`). The oracle answers by a walk of the rules, by the guards of
Equation 1, and by a table over all interpretations, all proved to agree.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from sleec_runtime.model import Atom, Ruleset, formulas_of, leaves
from sleec_verify.certificates.theory.oracle import NoAnswer, answers
from sleec_verify.conformance.rulesets import rulesets
from tests.support import brute_force as brute
from tests.support.coq import require_coq
from tests.support.enumerated_rules import pairs, single_rules
from tests.support.theory_cases import compare, random_cases

# Whichever test comes first may have to compile the theory.
pytestmark = pytest.mark.timeout(600)

# How many contexts each makes says how many there are: a class that is lost would be seen.
PAIRS = {(0, 0): 60, (0, 1): 336, (1, 0): 336, (0, 2): 3_936, (2, 0): 3_936, (1, 1): 3_936, (1, 2): 58_560}
MORE_PAIRS = {(2, 1): 58_560, (2, 2): 981_120}
TWO_OBLIGATIONS = {(0, 0): 216, (0, 1): 3_456, (1, 0): 3_456}
MORE_OF_TWO = {(0, 2): 120_096, (2, 0): 120_096, (1, 1): 120_096}
ALL = [
    *(pytest.param(hedges, ("o",), count) for hedges, count in PAIRS.items()),
    *(pytest.param(hedges, ("o", "p"), count) for hedges, count in TWO_OBLIGATIONS.items()),
    *(pytest.param(hedges, ("o",), count, marks=pytest.mark.long) for hedges, count in MORE_PAIRS.items()),
    *(pytest.param(hedges, ("o", "p"), count, marks=pytest.mark.long) for hedges, count in MORE_OF_TWO.items()),
]


@pytest.mark.parametrize("seed", range(4))
def test_20_000_random_contexts(oracle: Path, seed: int) -> None:
    assert compare(oracle, random_cases(seed, 5_000)) == 5_000


def test_random_guards_and_hedges_name_triggers() -> None:
    formulas = [f for ruleset, _ in random_cases(0, 500) for rule in ruleset.rules for f in formulas_of(rule)]
    named = [leaf for formula in formulas for leaf in leaves(formula) if isinstance(leaf, Atom)]
    assert {"trigger", "condition"} == {atom.kind for atom in named}


@pytest.mark.long
@pytest.mark.timeout(7200)
@pytest.mark.parametrize("seed", range(100, 110))
def test_1_000_000_random_contexts(oracle: Path, seed: int) -> None:
    assert compare(oracle, random_cases(seed, 100_000)) == 100_000


def test_every_rule_of_up_to_two_hedges(oracle: Path) -> None:
    assert compare(oracle, single_rules()) == 30_798


@pytest.mark.slow
@pytest.mark.parametrize(("hedges", "names", "contexts"), ALL)
def test_every_two_rules(oracle: Path, hedges: tuple[int, int], names: tuple[str, ...], contexts: int) -> None:
    assert compare(oracle, pairs(hedges, names)) == contexts


@pytest.mark.slow
@given(ruleset=rulesets(domains=False), data=st.data())
@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
def test_measures_as_conditions(oracle: Path, ruleset: Ruleset, data: st.DataObject) -> None:
    """With comparisons made conditions, what is due is the same, and the order of the cuts is assumed of no more than
    what values do."""
    every = list(brute.contexts(ruleset))[:500]
    if not every:
        return
    contexts = [data.draw(st.sampled_from(every)) for _ in range(3)]
    assert compare(oracle, [(ruleset, contexts)]) == 3


def test_these_tests_are_skipped_without_coq_but_never_in_ci(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shutil.which", lambda name: None)
    monkeypatch.delenv("CI", raising=False)
    with pytest.raises(pytest.skip.Exception, match="apt-get install coq"):
        require_coq("the oracle")
    monkeypatch.setenv("CI", "true")
    with pytest.raises(pytest.fail.Exception, match="apt-get install coq"):
        require_coq("the oracle")


def test_what_is_no_question_is_not_answered(oracle: Path) -> None:
    line = "rules cascade 1 1 1 1 1 1 1 0 0"
    assert answers(oracle, [line, "at 1 t 1"])[1] == "possible 1; consistent 1; due 1; entailed 1; said e"
    for question in (
        "",
        "at",
        "at 1",
        "at 1 o 1",
        "at 1 t 0",
        "at 1 t 1 2",
        "at -1",
        "at 1 t 0x1",
        "why",
        "refuted a 1 0",
    ):
        with pytest.raises(NoAnswer, match="UNREADABLE"):
            answers(oracle, [line, question])
    for rules in ("rules", "rules both 0 0 0", f"{line} 0", "rules cascade 1 1 1 1 o 1 1 1 0 0", "at 1 t 1"):
        with pytest.raises(NoAnswer, match="UNREADABLE"):
            answers(oracle, [rules])
