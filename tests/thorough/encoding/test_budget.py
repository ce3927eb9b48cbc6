"""However hard a text is to decide, checking it ends: what is open then is unknown, and says why."""

from __future__ import annotations

from time import process_time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks import adversarial
from sleec_runtime.language import parse
from sleec_verify.checks import CHECKS, run_checks
from sleec_verify.encoding import budget
from sleec_verify.encoding.arithmetic import values_for
from sleec_verify.encoding.budget import OutOfBudget, limited
from sleec_verify.encoding.solver import MiniSat
from sleec_verify.query.prime_implicates import inconsistent_sets_of
from sleec_verify.query.question import is_possible
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Proved, Refuted, Unknown
from tests.support.small_rulesets import small_rulesets

QUICK = {name: text for name, text in adversarial.FAMILIES.items() if not name.endswith("-1000")}


def reasons(results):
    return {one.name: one.verdict.why for one in results if isinstance(one.verdict, Unknown)}


def pigeons(count):
    """More pigeons than holes, as clauses: contradictory, and hard to refute."""
    hole = {(p, h): p * (count - 1) + h + 1 for p in range(count) for h in range(count - 1)}
    somewhere = [[hole[p, h] for h in range(count - 1)] for p in range(count)]
    alone = [[-hole[p, h], -hole[q, h]] for h in range(count - 1) for p in range(count) for q in range(p)]
    return somewhere + alone


# Every family of hard texts ---------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_a_hard_text_ends_within_its_budget_of_steps_and_always_at_the_same_place(monkeypatch, name):
    monkeypatch.setattr(budget, "FILE", 150_000)
    monkeypatch.setattr(budget, "PER_CHARACTER", 0)
    ruleset = parse(QUICK[name]())
    started = process_time()
    results = run_checks(ruleset)
    assert process_time() - started < 5, "the steps are counted where the time goes"
    assert all("limit of steps for one file" in why or "too many" in why for why in reasons(results).values())
    again = run_checks(ruleset)
    assert [(one.name, one.verdict) for one in again] == [(one.name, one.verdict) for one in results]


@pytest.mark.speed
@pytest.mark.parametrize("name", QUICK)
def test_a_hard_text_ends_soon_after_a_timeout(name):
    ruleset = parse(QUICK[name]())
    started = process_time()
    with limited(seconds=0.5):
        results = run_checks(ruleset)
    assert process_time() - started < 3
    for why in reasons(results).values():
        assert "0.5 seconds" in why or "too many" in why or "z3 does not decide" in why


@pytest.mark.slow
@pytest.mark.parametrize("name", ["products", "pigeonhole", "all-call-all", "nevers"])
def test_what_took_minutes_is_unknown_by_default(name):
    ruleset = parse(adversarial.FAMILIES[name]())
    with budget.for_file(len(ruleset.source.text)):
        at_hand = budget.current()
        assert at_hand is not None
        given = at_hand.steps
        results = {one.name: one for one in run_checks(ruleset)}
        assert at_hand.steps > -0.05 * given, "little more is spent than there is"
    assert given < 10_000_000, "ten seconds, in steps of a microsecond"
    assert reasons(results.values())
    for check in ("unused-name", "empty-hedge", "duplicate-rule"):
        assert not isinstance(results[check].verdict, Unknown)


# EXCLUSIVE --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("names", [100, pytest.param(1_000, marks=pytest.mark.slow)])
def test_large_exclusives_are_decided(names):
    for text in (adversarial.exclusive(names), adversarial.exclusive_at_once(names)):
        results = {one.name: one for one in run_checks(parse(text))}
        assert not reasons(results.values())
        assert len(results["conflict"].findings) == 1_000 + 3 * names, "as many as are listed"
    assert len(results["vacuous-conflict"].findings) == names
    results = {one.name: one for one in run_checks(parse(adversarial.exclusive_in_turn(names)))}
    assert isinstance(results["conflict"].verdict, Proved)
    assert isinstance(results["vacuous-conflict"].verdict, Proved)


def test_the_two_rules_at_odds_among_many_are_found():
    text = adversarial.exclusive_in_turn(60) + "RULE odd\nWHEN T AND Level = 7 THEN O9\n"
    (result,) = run_checks(parse(text), ["conflict"])
    assert [(finding.rules, finding.obligations) for finding in result.findings] == [(("rule_8", "odd"), ("O7", "O9"))]


def test_an_exclusive_beside_constraints_that_share_its_names_gives_what_its_pairs_give(monkeypatch):
    names = ", ".join(f"O{n}" for n in range(25))
    rules = "".join(f"WHEN T THEN O{n}\n" for n in range(25))
    more = "NEVER O1\nNEVER O2 AND O3\nNEVER O4 AND NOT O5 AND c\nNEVER O6 AND O7 AND P\nNEVER P AND NOT Q\n"
    indices = [RulesetIndex(parse(f"EXCLUSIVE {names}\n{more}{rules}WHEN T THEN P AND NOT Q\n")) for _ in range(2)]
    few = {(clash.literals, clash.labels) for clash in inconsistent_sets_of(indices[0])}
    assert inconsistent_sets_of(indices[0]).exclusions
    monkeypatch.setattr("sleec_verify.query.prime_implicates.MOST_LISTED", 100)
    assert not inconsistent_sets_of(indices[1]).exclusions
    assert {(clash.literals, clash.labels) for clash in inconsistent_sets_of(indices[1])} == few


# Fair shares ------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_one_hard_question_does_not_hide_what_others_find(monkeypatch):
    monkeypatch.setattr(budget, "FILE", 100_000)
    hard = adversarial.pigeonhole(9, 0).strip().removeprefix("ASSUME ")
    text = f"RULE hard\nWHEN T AND {hard} THEN O\nWHEN T THEN NOT O\n"
    text += "RULE a\nWHEN A THEN B\nRULE b\nWHEN A THEN NOT B\nRULE dead\nWHEN A AND c AND NOT c THEN D\n"
    results = {one.name: one for one in run_checks(parse(text))}
    assert reasons(results.values())["conflict"].startswith("`hard` and `rule_2`: ")
    assert [finding.rules for finding in results["conflict"].findings] == [("a", "b")]
    assert reasons(results.values())["dead-rule"].startswith("`hard`: ")
    assert [finding.rules for finding in results["dead-rule"].findings] == [("dead",)]


def test_a_check_that_needs_more_than_its_first_share_is_made_again(monkeypatch):
    ruleset = parse(adversarial.random_clauses(120))
    with budget.for_file(10_000):
        at_hand = budget.current()
        assert at_hand is not None
        before = at_hand.steps
        run_checks(ruleset, ["conflict"])
        needed = before - at_hand.steps
    monkeypatch.setattr(budget, "FILE", 2 * needed)
    monkeypatch.setattr(budget, "PER_CHARACTER", 0)
    (result,) = run_checks(ruleset, ["conflict"])
    assert isinstance(result.verdict, (Proved, Refuted))


def test_assumptions_that_are_not_decided_leave_what_rests_on_none_of_them(monkeypatch):
    monkeypatch.setattr(budget, "FILE", 60_000)
    text = adversarial.pigeonhole(9, 0) + "RULE dead\nWHEN A AND c AND NOT c THEN D\nRULE alive\nWHEN A THEN B\n"
    (result,) = run_checks(parse(text), ["dead-rule"])
    assert [finding.rules for finding in result.findings] == [("dead",)], "no situation is one, whatever is assumed"
    assert isinstance(result.verdict, Unknown)
    assert "alive" in result.verdict.why


def test_assumptions_known_to_contradict_are_reported_though_not_as_few_as_can_be(monkeypatch):
    monkeypatch.setattr("sleec_verify.encoding.solver.CONFLICT_BUDGET", 2_000)
    lines = adversarial.pigeonhole(6, 1).splitlines()
    assumed = lines[0].removeprefix("ASSUME ").split(" AND (")
    text = "\n".join(["ASSUME " + ("(" if n else "") + part for n, part in enumerate(assumed)] + lines[1:])
    index = RulesetIndex(parse(text))
    assert not is_possible(index)
    monkeypatch.setattr("sleec_verify.encoding.solver.CONFLICT_BUDGET", 1)
    (finding,) = CHECKS["assumptions"].run(index)
    assert finding.note is not None
    assert "some of these assumptions may contradict each other without the rest" in finding.note


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(small_rulesets(measures=True), st.integers(0, 3_000))
def test_what_is_decided_with_little_is_what_is_decided_with_enough(ruleset, steps):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(budget, "FILE", steps)
        patch.setattr(budget, "LEAST", 10)
        little = run_checks(ruleset)
    for one, other in zip(little, run_checks(ruleset)):
        if isinstance(one.verdict, Unknown):
            assert {_said(finding) for finding in one.findings} <= {_said(finding) for finding in other.findings}
        elif one.name == "assumptions":
            # Which of them contradict one another may be told less exactly.
            assert type(one.verdict) is type(other.verdict)
        else:
            assert one.verdict == other.verdict


def _said(finding):
    """What a finding says, but for the clashes that a conflict lists and what may be left out of it."""
    return finding.code, finding.rules[:1], finding.clauses, finding.span


# Interruption -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("at_hand", "reason"),
    [
        (lambda: limited(seconds=0.2), "timeout of 0.2 seconds"),
        (lambda: budget.for_file(0), "limit of steps for one file"),
    ],
)
def test_a_solver_at_work_is_stopped(monkeypatch, at_hand, reason):
    monkeypatch.setattr(budget, "FILE", 300_000)
    started = process_time()
    with at_hand(), MiniSat(pigeons(13)) as solver, pytest.raises(OutOfBudget, match=reason):
        solver.solve()
    assert process_time() - started < 3


def test_z3_at_work_is_stopped_and_what_it_did_not_decide_is_not_kept():
    ruleset = parse(adversarial.products(12))
    with limited(seconds=0.1):
        results = run_checks(ruleset, ["dead-rule"])
    assert reasons(results)
    assert values_for({"x": True}, [], [], []) == {"x": 0}


def test_a_budget_does_not_change_what_is_decided_within_it():
    text = adversarial.compared_measures(8, 12)
    with limited(seconds=600):
        timed = run_checks(parse(text))
    assert [(one.name, one.verdict) for one in timed] == [(one.name, one.verdict) for one in run_checks(parse(text))]
