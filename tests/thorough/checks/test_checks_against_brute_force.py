"""Each check says what brute force over all contexts says: nothing missed, nothing invented."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.checks.redundant import without_hedge
from sleec_verify.results.finding import Proved, Refuted
from tests.support import brute_force as brute
from tests.support.edits import forbidding, tied
from tests.support.small_rulesets import small_rulesets

BOOLEAN = small_rulesets()
MEASURED = small_rulesets(measures=True, rules=2)
TIED = tied(small_rulesets(rules=3, hedges=1, nested=False, assumptions=False))
FORBIDDING = forbidding(small_rulesets(rules=3, hedges=1, nested=False, constraints=False, assumptions=False))


def findings(ruleset, check):
    (result,) = run_checks(ruleset, [check])
    assert isinstance(result.verdict, (Proved, Refuted)), result
    return result.findings


def without_rule(ruleset: Ruleset, label: str) -> Ruleset:
    return replace(ruleset, statements=tuple(s for s in ruleset.statements if getattr(s, "label", None) != label))


def with_rule(ruleset: Ruleset, rule) -> Ruleset:
    return replace(
        ruleset,
        statements=tuple(rule if getattr(s, "label", None) == rule.label else s for s in ruleset.statements),
    )


def check_conflicts(ruleset):
    found = findings(ruleset, "conflict")
    assert {frozenset(f.clauses) for f in found} == brute.causes(ruleset)
    for finding in found:
        context = finding.witness.context()
        assert brute.conflicts(ruleset, context)


def check_vacuous(ruleset):
    expected = set()
    for rule in ruleset.rules:
        triggered = [c for c in brute.contexts(ruleset) if brute.active(rule, ruleset, c) is not None]
        if triggered and all(brute.conflicts(ruleset, c) for c in triggered):
            expected.add(rule.label)
    assert {f.rules[0] for f in findings(ruleset, "vacuous-conflict")} == expected


def nothing_is_possible(ruleset):
    """If the assumptions contradict each other, nothing but that is reported."""
    return not any(True for _ in brute.contexts(ruleset))


def check_dead(ruleset):
    if nothing_is_possible(ruleset):
        assert not findings(ruleset, "dead-rule") + findings(ruleset, "dead-hedge")
        return
    seen = {(rule.label, brute.active(rule, ruleset, c)) for c in brute.contexts(ruleset) for rule in ruleset.rules}
    dead = {r.label for r in ruleset.rules if not any((r.label, n) in seen for n, _ in enumerate(r.clauses()))}
    assert {f.rules[0] for f in findings(ruleset, "dead-rule")} == dead
    hedges = {(r.label, n) for r in ruleset.rules for n, _ in enumerate(r.clauses()) if n and (r.label, n) not in seen}
    assert {f.clauses[0] for f in findings(ruleset, "dead-hedge")} == hedges


def same_everywhere(ruleset, other):
    return all(brute.due(ruleset, c) == brute.due(other, c) for c in brute.contexts(ruleset))


def check_redundant(ruleset):
    if nothing_is_possible(ruleset):
        assert not findings(ruleset, "redundant-rule") + findings(ruleset, "redundant-hedge")
        return
    expected = {r.label for r in ruleset.rules if same_everywhere(ruleset, without_rule(ruleset, r.label))}
    found = findings(ruleset, "redundant-rule")
    assert {f.rules[0] for f in found} == expected
    for finding in found:
        kept = replace(
            ruleset,
            statements=tuple(s for s in ruleset.statements if getattr(s, "label", finding.rules[0]) in finding.rules),
        )
        alone = without_rule(kept, finding.rules[0])
        assert all(brute.due(kept, c) == brute.due(alone, c) for c in brute.contexts(ruleset))
    hedges = {
        (r.label, n)
        for r in ruleset.rules
        for n in range(1, len(list(r.clauses())))
        if same_everywhere(ruleset, with_rule(ruleset, without_hedge(r, n)))
    }
    assert {f.clauses[0] for f in findings(ruleset, "redundant-hedge")} == hedges


def check_reading(ruleset):
    expected = set()
    for rule in ruleset.rules:
        alone = replace(
            ruleset, statements=tuple(s for s in ruleset.statements if getattr(s, "label", rule.label) == rule.label)
        )
        if any(brute.due(alone, c, "cascade") != brute.due(alone, c, "priority") for c in brute.contexts(ruleset)):
            expected.add(rule.label)
    found = findings(ruleset, "reading")
    assert {f.rules[0] for f in found} == expected
    for finding in found:
        context = finding.witness.context()
        rule = ruleset.by_label[finding.rules[0]]
        deciding = {brute.active(rule, ruleset, context, reading) for reading in ("cascade", "priority")}
        assert {clause for _, clause in finding.clauses} == deciding


ALL = [check_conflicts, check_vacuous, check_dead, check_redundant, check_reading]


@pytest.mark.slow
@pytest.mark.parametrize("check", ALL)
def test_boolean_rulesets(check):
    @settings(max_examples=120, deadline=None)
    @given(BOOLEAN)
    def compare(ruleset):
        check(ruleset)

    compare()


@pytest.mark.slow
@pytest.mark.parametrize("check", ALL)
def test_rulesets_whose_triggers_are_tied_to_one_another(check):
    @settings(max_examples=60, deadline=None)
    @given(TIED)
    def compare(ruleset):
        check(ruleset)

    compare()


@pytest.mark.parametrize("check", [check_conflicts, check_vacuous])
def test_constraints_that_leave_nothing_to_do(check):
    @settings(max_examples=100, deadline=None)
    @given(FORBIDDING)
    def compare(ruleset):
        check(ruleset)

    compare()


def test_a_rule_that_meets_a_trigger_without_which_the_constraints_cannot_be_kept():
    constraints = "NEVER NOT night AND NOT open\nNEVER open\n"
    ruleset = parse(constraints + "RULE guest\nWHEN guest THEN tea\nRULE night\nWHEN night THEN NOT tea\n")
    check_vacuous(ruleset)
    assert [finding.rules for finding in findings(ruleset, "vacuous-conflict")] == [("guest", "night")]


@pytest.mark.slow
@pytest.mark.parametrize("check", ALL)
def test_rulesets_with_measures(check):
    @settings(max_examples=50, deadline=None)
    @given(MEASURED)
    def compare(ruleset):
        check(ruleset)

    compare()


@pytest.mark.slow
@pytest.mark.parametrize("check", [check_conflicts, check_vacuous])
def test_constraints_as_large_ones_are_asked_about(check):
    """An EXCLUSIVE whose pairs are not listed, and clashes asked about as a whole before their causes."""

    @settings(max_examples=120, deadline=None)
    @given(BOOLEAN)
    def compare(ruleset):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("sleec_verify.query.prime_implicates.MOST_LISTED", 1)
            patch.setattr("sleec_verify.checks.untimed_conflicts.MANY_WAYS", 1)
            check(ruleset)

    compare()


_OPERANDS = ("a", "b", "c", "d", "NOT a", "NOT b", "a AND b", "b OR c", "NOT (c AND d)", "a OR d", "b AND NOT c")


@settings(max_examples=150, deadline=None)
@given(
    st.lists(st.tuples(st.sampled_from(_OPERANDS), st.sampled_from(("o", "p", "NOT o", "o AND p"))), max_size=7),
    st.sampled_from(("", "ASSUME NOT (a AND b)\n", "ASSUME a OR b OR c\n")),
    st.sampled_from(("", "READING priority\n")),
    st.sampled_from((30, 3)),
)
def test_the_reading_of_long_chains(hedges, assumption, reading, long):
    """Clauses that oblige the same stand beside one another and apart; of the longest, the way is another."""
    chain = "".join(f"\nUNLESS {condition} IN WHICH CASE {response}" for condition, response in hedges)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sleec_verify.checks.reading.LONG", long)
        check_reading(parse(f"{reading}{assumption}RULE r\nWHEN t AND NOT d THEN o{chain}\n"))
