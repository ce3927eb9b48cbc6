"""Many questions as one formula, refuted: exactly if trying everything finds no model of any."""

from __future__ import annotations

import random

import pytest
from hypothesis import given, settings

from sleec_verify.certificates import lrat
from sleec_verify.certificates.recorder import NoModel, RecordedQuestion, Recorder
from sleec_verify.certificates.refutation import Disjunction, disjunctions
from sleec_verify.encoding.elaboration import Elaborator, InvalidLemma, LearntClause
from sleec_verify.encoding.refutation import learnt_clauses, refute
from sleec_verify.encoding.solver import MiniSat
from tests.support.formulas import asked, some_question_has_model


@given(asked())
@settings(max_examples=300)
def test_what_has_no_model_is_refuted_and_nothing_else(all_asked: list[RecordedQuestion]) -> None:
    formula = Disjunction(all_asked)
    if some_question_has_model(all_asked):
        with pytest.raises(InvalidLemma):
            formula.lrat()
        with MiniSat(formula.clauses) as solver:
            assert solver.solve()
    else:
        lrat.check(formula.dimacs("a test"), formula.lrat())


def threes(variables: int, ratio: float, seed: int) -> list[list[int]]:
    draw = random.Random(seed)
    chosen = (draw.sample(range(1, variables + 1), 3) for _ in range(int(ratio * variables)))
    return [[draw.choice((-1, 1)) * v for v in clause] for clause in chosen]


@pytest.mark.parametrize("seed", range(10))
def test_refutations_that_need_search(seed: int) -> None:
    """Questions that share clauses and lemmas."""
    clauses = threes(60, 4.4, seed)
    with MiniSat(clauses) as solver:
        literals = [(v,) for v in range(1, 61) if not solver.solve([v])]
        literals += [(-v,) for v in range(1, 61) if not solver.solve([-v])]
    formula = Disjunction(
        [RecordedQuestion(clauses, dict.fromkeys(literals, "")), RecordedQuestion(threes(30, 7, seed), {(): ""})]
    )
    lrat.check(formula.dimacs("a test"), formula.lrat())
    assert any(steps for steps, _ in [refute(clauses, literals), refute(threes(30, 7, seed), [()])])


def test_no_question_at_all_is_refuted_by_nothing() -> None:
    formula = Disjunction([])
    assert formula.clauses == [()]
    lrat.check(formula.dimacs("a test"), formula.lrat())


def test_large_ones_become_several(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.certificates.refutation.MOST_LITERALS", 5)
    parts = list(disjunctions([RecordedQuestion([[1], [-1, 2], [-2]], {(): ""}) for _ in range(3)]))
    assert [part.questions for part in parts] == [1, 1, 1]


def test_a_recorder_looks_at_models_only_if_it_is_to() -> None:
    Recorder().satisfied([[1]], [], lambda literal: literal < 0)
    Recorder(examining=True).satisfied([[1]], [1], lambda literal: literal > 0)
    for literals, clauses in (([-1], [[1]]), ([], [[-1]])):
        with pytest.raises(NoModel):
            Recorder(examining=True).satisfied(clauses, literals, lambda literal: literal > 0)


def test_a_recorder_keeps_a_formula_that_grows() -> None:
    recorder, clauses = Recorder(), [[1]]
    recorder.refuted(clauses, [-1, -1])
    clauses.append([2])
    recorder.refuted(clauses, [-2])
    (one,), models = recorder.take()
    assert (one.clauses, list(one.questions), models) == ([[1], [2]], [(-1,), (-2,)], 0)
    assert recorder.take() == ([], 0)


def test_what_the_solver_forgets_is_taken_back_where_it_is_needed() -> None:
    clauses = threes(190, 5, 2)
    lemmas = learnt_clauses(clauses, [()])
    assert sum(lemma.forgotten for lemma in lemmas) > 100
    formula = Disjunction([RecordedQuestion(clauses, {(): ""})])
    lrat.check(formula.dimacs("a test"), formula.lrat())


def test_lemmas_that_do_not_follow_are_refused() -> None:
    elaborator = Elaborator([[1, 2], [-1, 2], [1, -2], [-1, -2, 3]], [()])
    assert elaborator.open_questions() == [0]
    elaborator.learn([LearntClause((2, -2)), LearntClause((2,)), LearntClause((-3,))])
    with pytest.raises(InvalidLemma, match="lemma"):
        elaborator.elaborate()
    elaborator = Elaborator([[1, 2], [-1, 2]], [()])
    elaborator.learn([LearntClause((2,)), LearntClause((2,), forgotten=True), LearntClause((9,), forgotten=True)])
    with pytest.raises(InvalidLemma, match="question"):
        elaborator.elaborate()
