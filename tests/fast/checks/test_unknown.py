"""What is not decided is said to be unknown, and what is cut short is said to be cut short."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Context, Obligation
from sleec_verify.checks import run_checks
from sleec_verify.encoding import solver
from sleec_verify.encoding.solver import MiniSat, Undecided
from sleec_verify.entailment.entailment import entail
from sleec_verify.query.prime_implicates import inconsistent_sets
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay import situations as replay
from sleec_verify.results.finding import Proved, Refuted, Unknown
from sleec_verify.traces import unrolling
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.questions import find_trigger

# As many minimal inconsistent sets as there are ways to choose one of each pair: 2 to the 14th.
ENTANGLED = "\n".join(
    [f"NEVER NOT A{n} AND NOT B{n}" for n in range(14)]
    + ["NEVER " + " AND ".join(f"A{n}" for n in range(14))]
    + [f"WHEN t THEN A{n}\nWHEN t THEN NOT B{n}" for n in range(14)]
)


def pigeons(count: int) -> str:
    """An assumption that is impossible for a reason that takes a solver long: more pigeons than holes."""
    holes = range(count - 1)
    each = [" OR ".join(f"p{p}in{h}" for h in holes) for p in range(count)]
    two = [f"NOT (p{p}in{h} AND p{q}in{h})" for h in holes for p in range(count) for q in range(p)]
    return "WHEN t AND " + " AND ".join(f"({part})" for part in each + two) + " THEN o"


def test_constraints_too_entangled_to_list_are_unknown():
    results = {result.name: result for result in run_checks(parse(ENTANGLED))}
    for name in ("conflict", "vacuous-conflict"):
        verdict = results[name].verdict
        assert isinstance(verdict, Unknown)
        assert "too many combinations" in verdict.why
    assert isinstance(results["dead-rule"].verdict, Proved)


def test_entail_does_not_guess_about_entangled_constraints():
    with pytest.raises(Undecided):
        entail(parse(ENTANGLED), Context(frozenset({"t"})))


def test_a_long_chain_of_constraints_is_no_entanglement():
    chain = "\n".join(f"NEVER O{n} AND NOT O{n + 1}" for n in range(100))
    ruleset = parse(f"{chain}\nRULE a WHEN t THEN O0\nRULE b WHEN u THEN NOT O100")
    (result,) = run_checks(ruleset, ["conflict"])
    assert [finding.rules for finding in result.findings] == [("a", "b")]
    answer = entail(ruleset, Context(frozenset("t")))
    assert answer.consistent
    assert len(answer.consequences) == 100
    assert not entail(ruleset, Context(frozenset("tu"))).consistent


def test_a_never_of_too_many_cases_is_unknown():
    cases = " AND ".join(f"(A{n} OR B{n})" for n in range(13))
    with pytest.raises(Undecided):
        inconsistent_sets(RulesetIndex(parse(f"NEVER {cases}\nWHEN t THEN A0")).constraints, {Obligation("A0")})


def test_a_question_past_the_budget_is_unknown(monkeypatch):
    monkeypatch.setattr(solver, "CONFLICT_BUDGET", 1)
    (result,) = run_checks(parse(pigeons(8)), ["dead-rule"])
    assert isinstance(result.verdict, Unknown)
    assert "reached its limit of conflicts" in result.verdict.why


def test_the_same_question_is_answered_within_the_budget():
    (result,) = run_checks(parse(pigeons(5)), ["dead-rule"])
    assert isinstance(result.verdict, Refuted)


def test_a_solver_that_gives_up_says_neither_yes_nor_no(monkeypatch):
    monkeypatch.setattr(solver, "CONFLICT_BUDGET", 1)
    clauses = [[a, b, c] for a in (1, -1) for b in (2, -2) for c in (3, -3)]
    with MiniSat(clauses) as sat:
        assert sat.solve() is None


def test_a_witness_that_does_not_replay_is_never_shown(monkeypatch):
    monkeypatch.setitem(replay._CLAIMS, "conflict", lambda *_: False)
    (result,) = run_checks(parse("WHEN t THEN o\nWHEN t THEN NOT o"), ["conflict"])
    assert isinstance(result.verdict, Unknown)
    assert not result.findings
    assert "rejected a witness" in result.verdict.why


def test_a_long_list_of_conflicts_says_that_it_is_cut(monkeypatch):
    monkeypatch.setattr("sleec_verify.checks.untimed_conflicts.MOST", 2)
    monkeypatch.setattr("sleec_verify.checks.untimed_conflicts.MOST_PER_RULE", 0)
    (result,) = run_checks(parse("WHEN t THEN o\n" + "WHEN t THEN NOT o\n" * 5), ["conflict"])
    assert isinstance(result.verdict, Refuted)
    assert len(result.findings) == 2
    assert result.reason is not None
    assert "first 2" in result.reason


def test_contradictory_assumptions_are_reported_and_leave_no_situation():
    text = "ASSUME a\nASSUME b OR c\nASSUME NOT a\nWHEN t THEN o UNLESS d IN WHICH CASE p\nWHEN t THEN NOT o"
    results = {result.name: result for result in run_checks(parse(text))}
    (finding,) = results["assumptions"].findings
    assert "lines 1 and 3" in finding.message
    assert isinstance(results["conflict"].verdict, Proved)
    assert results["dead-rule"].findings == ()


def test_an_unknown_check_is_a_key_error():
    with pytest.raises(KeyError):
        run_checks(parse("WHEN t THEN o"), ["no-such-check"])


@pytest.mark.parametrize("limit", ["MOST", "MOST_CLAUSES", "MOST_COMPARED"])
def test_a_trace_that_takes_too_much_is_unknown_with_what_it_came_to(monkeypatch, limit):
    text = "RULE a WHEN A THEN B WITHIN 9 seconds\nRULE b WHEN B THEN C WITHIN [2, 5] seconds\nRULE c WHEN C THEN NOT B"
    index = TraceIndex(parse(text))
    assert find_trigger(index, index.rules[0]).trace is not None
    monkeypatch.setattr(unrolling, limit, 0)
    with pytest.raises(Undecided, match=r"no answer with [1-9] instant"):
        find_trigger(index, index.rules[0])
