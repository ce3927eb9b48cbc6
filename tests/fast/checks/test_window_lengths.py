"""Windows whose lengths measures give: every value of the declared range counts."""

from __future__ import annotations

from itertools import pairwise

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.encoding.measure_ranges import MeasureRanges
from sleec_verify.results.finding import Proved, Unknown
from sleec_verify.traces.index import TraceIndex
from tests.support.timed_strategies import timed_ruleset

ENGLISH = "EVENT Smoke, Fall, Call\nMEASURE patience: integer\n"
DSL = "def_start event Smoke event Fall event Call measure patience: numeric def_end "


def verdict(name, text):
    (result,) = run_checks(parse(text), [name])
    return result


def conflict(rules, ranged="ASSUME patience >= 1 AND patience <= 30\n"):
    return verdict("conflict", ENGLISH + ranged + rules)


def in_conflict(rules, ranged="ASSUME patience >= 1 AND patience <= 30\n"):
    result = conflict(rules, ranged)
    assert not isinstance(result.verdict, Unknown), result.verdict.why
    return {frozenset(finding.rules) for finding in result.findings}


WAIT = "RULE R1 WHEN Smoke THEN Call WITHIN patience minutes\n"


def test_a_value_with_a_conflict_is_found_and_shown():
    (finding,) = conflict(WAIT + "RULE R2 WHEN Fall THEN NOT Call WITHIN 29 minutes\n").findings
    assert set(finding.rules) == {"R1", "R2"}
    (moment,) = finding.timeline.moments
    assert moment.conditions["patience"] <= 29
    assert "patience" in moment.telling
    required = next(due for due in moment.due if not due.negated)
    assert required.end == 60 * moment.conditions["patience"]


def test_later_triggers_read_the_measure_again():
    # The first value of `patience` is long, and the prohibition begins when its time is over.
    rules = WAIT + "RULE R2 WHEN Fall AND patience = 1 THEN NOT Call\n"
    (finding,) = conflict(rules).findings
    first, last = finding.timeline.moments
    assert last.conditions["patience"] == 1
    assert last.time == first.time + 60 * first.conditions["patience"]


def is_vacuous(rules, ranged="ASSUME patience >= 1 AND patience <= 30\n"):
    """Whether no trace triggers the rule R2."""
    result = verdict("vacuous-conflict", ENGLISH + ranged + rules)
    assert not isinstance(result.verdict, Unknown), result.verdict.why
    return "R2" in {finding.rules[0] for finding in result.findings}


def test_the_same_measure_in_a_guard_and_a_window_has_one_value():
    guarded = "RULE R2 WHEN Smoke AND patience <= {} THEN NOT Call WITHIN 10 minutes\n"
    assert is_vacuous(WAIT + guarded.format(10))
    assert not is_vacuous(WAIT + guarded.format(11))


def test_the_same_measure_in_two_windows_has_one_value():
    both = "RULE R1 WHEN Smoke THEN Call WITHIN patience TO patience minutes\n"
    assert is_vacuous(both + "RULE R2 WHEN Smoke THEN NOT Call WITHIN patience minutes\n")
    assert not is_vacuous(both + "RULE R2 WHEN Smoke AND patience > 1 THEN NOT Call WITHIN 1 minutes\n")
    after = "RULE R1 WHEN Smoke THEN NOT Call WITHIN patience minutes OTHERWISE Call WITHIN patience minutes\n"
    assert not is_vacuous(after + "RULE R2 WHEN Smoke THEN Call WITHIN patience minutes\n")


def test_a_range_of_one_value_is_a_constant():
    for value in (1, 10):
        for prohibited in (5, 10, 15):
            rules = WAIT + f"RULE R2 WHEN Smoke THEN NOT Call WITHIN {prohibited} minutes\n"
            exact = f"ASSUME patience = {value}\n"
            constant = rules.replace("patience minutes", f"{value} minutes")
            assert is_vacuous(rules, exact) == is_vacuous(constant) == (prohibited >= value)
            assert in_conflict(rules, exact) == in_conflict(constant)


def test_a_narrower_range_adds_no_conflict():
    rules = WAIT + "RULE R2 WHEN Smoke THEN NOT Call WITHIN 10 minutes\n"
    ranges = ((1, 20), (10, 20), (11, 20), (20, 20), (20, 40))
    found = [in_conflict(rules, f"ASSUME patience >= {least} AND patience <= {most}\n") for least, most in ranges]
    assert all(narrow <= wide for narrow, wide in pairwise(reversed(found)))


@pytest.mark.parametrize(
    ("relations", "bounds"),
    [
        ("ASSUME patience >= 1\nASSUME NOT (patience > 30)\n", (1, 30)),
        ("ASSUME patience > 0 AND (patience < 31 OR patience < 7)\n", (1, 30)),
        ("ASSUME patience > 0 AND (patience < 31 OR asleep)\n", (1, None)),
        ("ASSUME patience <= most AND most <= 30\n", (None, 30)),
        ("ASSUME patience >= most AND most > 2\nASSUME patience = 7 OR patience = 9\n", (7, 9)),
        ("ASSUME NOT Smoke OR patience <= 30\n", (None, None)),
        ("", (None, None)),
    ],
)
def test_ranges_follow_from_the_relations(relations, bounds):
    ruleset = parse(ENGLISH + "MEASURE most: integer\nCONDITION asleep\n" + relations + WAIT)
    assert MeasureRanges(TraceIndex(ruleset).relations, ruleset.measures).bounds("patience") == bounds


@pytest.mark.parametrize("ranged", ["", "ASSUME patience <= 30\n", "ASSUME patience >= 1\n"])
def test_an_unbounded_range_is_unknown_with_an_example(ranged):
    result = conflict(WAIT + "RULE R2 WHEN Fall THEN NOT Call WITHIN 29 minutes\n", ranged)
    assert "nothing bounds `patience`" in result.verdict.why
    assert result.verdict.why.endswith("for example: ASSUME patience >= 0 AND patience <= 60")


@pytest.mark.parametrize(
    ("most", "window", "why"),
    [
        (1_000, "patience minutes", "has 1,001 values, more than the limit of 1,000; use a larger unit"),
        (99, "patience TO most minutes", "have 10,000 combinations of values, more than the limit of 1,000"),
    ],
)
def test_a_range_with_too_many_values_is_unknown(most, window, why):
    ranged = f"MEASURE most: integer\nASSUME patience >= 0 AND patience <= {most} AND most >= 0 AND most <= {most}\n"
    rules = f"RULE R1 WHEN Smoke THEN Call WITHIN {window}\nRULE R2 WHEN Fall THEN NOT Call\n"
    assert conflict(rules, ranged).verdict.why.endswith(why)


def test_the_dsl_declares_ranges_by_relations():
    rules = "rule_start R1 when Smoke then Call within {patience} minutes R2 when Fall then not Call rule_end "
    result = verdict("conflict", DSL + rules)
    assert result.verdict.why.endswith("measure invariant ({patience} >= 0 and {patience} <= 60)")
    bounded = "relation_start measure invariant ({patience} >= 0 and {patience} <= 60) relation_end"
    assert [set(f.rules) for f in verdict("conflict", DSL + rules + bounded).findings] == [{"R1", "R2"}]


def test_a_negative_length_cannot_be_met():
    assert in_conflict(WAIT, "ASSUME patience >= 0 AND patience <= 2\n") == set()
    (finding,) = conflict(WAIT, "ASSUME patience >= -1 AND patience <= 2\n").findings
    assert finding.rules == ("R1",)
    assert finding.timeline.moments[0].conditions["patience"] == -1
    assert in_conflict(WAIT.replace("Call", "NOT Call"), "ASSUME patience >= -1 AND patience <= 2\n") == set()


def test_a_duration_of_a_relation():
    text = (
        DSL + "rule_start R1 when Fall then Call within 60 minutes rule_end "
        "relation_start measure invariant ({patience} >= 1 and {patience} <= 30) "
        "when Smoke then {quiet} for {patience} minutes forbid Call {quiet} relation_end "
        "purpose_start p1 exists Smoke and ({patience} > 9) while Call within BOUND minutes purpose_end"
    ).replace("def_end", "measure quiet: boolean def_end")
    assert verdict("purpose", text.replace("BOUND", "10")).verdict == Proved()
    assert verdict("purpose", text.replace("BOUND", "9")).findings


@pytest.mark.parametrize(("least", "wins"), [(10, True), (11, False)])
def test_the_environment_chooses_the_worst_value(least, wins):
    rules = WAIT + "RULE R2 WHEN Fall THEN NOT Call WITHIN 10 minutes\n"
    ranged = f"ASSUME patience >= {least} AND patience <= 12\n"
    (result,) = run_checks(parse(ENGLISH + ranged + rules), names=(), realizable=1)
    assert bool(result.findings) is wins
    (result,) = run_checks(parse(ENGLISH + "ASSUME patience >= -1 AND patience <= 1\n" + WAIT), names=(), realizable=1)
    (finding,) = result.findings
    assert finding.strategy is not None
    assert finding.strategy.act.conditions["patience"] == -1


def test_a_window_that_ends_before_it_begins_is_named():
    (finding,) = conflict(WAIT, "ASSUME patience >= -1 AND patience <= 2\n").findings
    assert "`Call` is required in a window that ends before it begins" in finding.message


@pytest.mark.parametrize("seed", range(6))
def test_the_unit_of_all_times_does_not_matter(seed):
    text = timed_ruleset(seed, rules=3, events=3, booleans=1, scale=False, longest=2, relations=0, lengths=True)
    scaled = parse(text.source.text.replace("seconds", "minutes"))
    (one,), (other,) = run_checks(text, ["conflict"]), run_checks(scaled, ["conflict"])
    assert {f.rules for f in one.findings} == {f.rules for f in other.findings}
    assert type(one.verdict) is type(other.verdict)


def test_thirty_values_in_three_rules_are_within_the_budget():
    rules = WAIT + "RULE R2 WHEN Fall THEN NOT Call WITHIN patience minutes\n"
    rules += "RULE R3 WHEN Night THEN Fall WITHIN patience minutes\n"
    assert in_conflict("EVENT Night\n" + rules) == {frozenset({"R1", "R2"})}
