"""Chosen situations meet their criterion, by brute force over all contexts, and few would do with fewer."""

from __future__ import annotations

import json
from itertools import combinations
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import load, parse
from sleec_runtime.model import Atom, leaves
from sleec_verify.cli import run
from sleec_verify.conformance.cases.goals import CRITERIA, clause_name, conditions_of
from sleec_verify.conformance.cases.reader import read_cases
from sleec_verify.conformance.cases.selection import choose_cases
from sleec_verify.conformance.cases.writer import json_text, toml
from tests.support import brute_force as brute
from tests.support.small_rulesets import small_rulesets
from tests.support.strategies import rulesets


def worth(rule, ruleset, context):
    return tuple(brute.value(c, context, measures=ruleset.measures) for c in conditions_of(rule))


def clauses_reached(ruleset, context):
    return {(label, number) for label, number, _ in brute.active_clauses(ruleset, context)}


def conditions_reached(ruleset, context):
    """Each condition with its value, where its rule is asked: a hedge's, where the guard is true."""
    found = clauses_reached(ruleset, context)
    for rule in ruleset.rules:
        in_guard = set() if rule.guard is None else set(leaves(rule.guard))
        active = brute.active(rule, ruleset, context)
        for condition, value in zip(conditions_of(rule), worth(rule, ruleset, context)):
            if active is not None or (condition in in_guard and rule.trigger in context.triggers):
                found.add((rule.label, condition, value))
    return found


def pairs_reached(ruleset, context):
    found = clauses_reached(ruleset, context)
    for rule in ruleset.rules:
        if rule.trigger in context.triggers and len(conditions_of(rule)) > 1:
            valued = list(zip(conditions_of(rule), worth(rule, ruleset, context)))
            found |= {(rule.label, *two) for two in combinations(valued, 2)}
    if any(len(conditions_of(rule)) == 1 for rule in ruleset.rules):
        single = {rule.label for rule in ruleset.rules if len(conditions_of(rule)) == 1}
        found |= {goal for goal in conditions_reached(ruleset, context) if goal[0] in single}
    return found


REACHED = {"clause": clauses_reached, "condition": conditions_reached, "pairwise": pairs_reached}


def decided(ruleset, contexts):
    """The conditions that two of the contexts show to decide by themselves."""
    found = set()
    for rule in ruleset.rules:
        seen = {
            worth(rule, ruleset, context): brute.active(rule, ruleset, context)
            for context in contexts
            if rule.trigger in context.triggers
        }
        for one, other in combinations(seen, 2):
            differing = [place for place, (a, b) in enumerate(zip(one, other)) if a != b]
            if len(differing) == 1 and seen[one] != seen[other]:
                found.add((rule.label, differing[0]))
    return found


def everything(ruleset):
    return [context for context in brute.contexts(ruleset) if not brute.conflicts(ruleset, context)]


small = small_rulesets(rules=3, measures=False)


@pytest.mark.parametrize("criterion", sorted(REACHED))
@given(ruleset=small)
@settings(max_examples=40)
def test_every_goal_that_some_situation_reaches_is_reached(criterion, ruleset) -> None:
    found = choose_cases(ruleset, criterion)
    reached = REACHED[criterion]
    possible = [frozenset(reached(ruleset, context)) for context in everything(ruleset)]
    goals = frozenset().union(*possible)
    assert frozenset().union(*(reached(ruleset, case.context()) for case in found.cases)) == goals
    assert len(found.cases) <= smallest_cover(goals, set(possible)) + 1


def smallest_cover(goals, sets) -> int:
    """The size of a smallest cover, by trying; from five on, that of a cover whose sets bring the most, one by one."""
    largest = sorted(
        (one for one in sets if not any(one < other for other in sets)), key=lambda one: sorted(map(str, one))
    )
    for size in range(min(len(largest), 4) + 1):
        if any(frozenset().union(*chosen) == goals for chosen in combinations(largest, size)):
            return size
    covered: frozenset[object] = frozenset()
    size = 0
    while covered != goals:
        covered |= max(largest, key=lambda one: len(one - covered))
        size += 1
    return size


@given(small_rulesets(rules=2, measures=True, constraints=False, assumptions=False))
@settings(max_examples=40)
def test_measures_are_valued_so_that_clauses_are_reached(ruleset) -> None:
    found = choose_cases(ruleset, "clause")
    goals = frozenset().union(*(clauses_reached(ruleset, context) for context in everything(ruleset)))
    assert frozenset().union(*(clauses_reached(ruleset, case.context()) for case in found.cases)) == goals


@given(small_rulesets(rules=2, constraints=False))
@settings(max_examples=40)
def test_every_condition_that_can_decide_is_shown_to(ruleset) -> None:
    found = choose_cases(ruleset, "mcdc")
    chosen = [case.context() for case in found.cases]
    assert decided(ruleset, chosen) == decided(ruleset, everything(ruleset))


@given(st.data())
@settings(max_examples=40)
def test_what_a_case_expects_is_what_is_due(data) -> None:
    ruleset = data.draw(rulesets(names=2, max_rules=3, domains=True))
    criterion = data.draw(st.sampled_from(sorted(CRITERIA)))
    single = data.draw(st.booleans())
    found = choose_cases(ruleset, criterion, single=single)
    for case in found.cases:
        part = ruleset if case.domain is None else ruleset.in_domain(case.domain)
        context = case.context()
        due = brute.due(part, context)
        assert set(case.obligations) == {o.name for o in due if not o.negated}
        assert set(case.prohibitions or ()) == {o.name for o in due if o.negated}
        assert not brute.conflicts(part, context)
        assert len(case.triggers) <= 1 or not single


def test_the_eight_rules_need_three_situations_in_each_domain() -> None:
    ruleset = load("rulesets/care-robot.sleec")
    found = choose_cases(ruleset, "clause")
    assert [case.domain for case in found.cases] == ["hospital"] * 3 + ["household"] * 3
    assert found.reached == 19
    assert found.unreached == ()
    assert len(choose_cases(ruleset, "clause", single=True).cases) == 19
    # Of a rule of n conditions, n + 1 situations are the least.
    single = choose_cases(ruleset, "mcdc", single=True)
    assert len(single.cases) == sum(len(conditions_of(rule)) + 1 for rule in ruleset.rules) == 21


@pytest.mark.parametrize(
    ("text", "single", "why"),
    [
        ("RULE r WHEN T THEN o UNLESS c AND NOT c IN WHICH CASE p", False, "in no situation"),
        (
            "RULE r WHEN T THEN o UNLESS c IN WHICH CASE p AND NOT p",
            False,
            "only if the rules contradict each other",
        ),
        (
            "RULE r WHEN T THEN o\nRULE s WHEN U THEN p\nASSUME T OR NOT U",
            True,
            "only if other triggers also occur",
        ),
    ],
)
def test_what_is_not_reached_is_listed_with_the_reason(text, single, why) -> None:
    (unreached,) = choose_cases(parse(text), "clause", single=single).unreached
    rule = parse(text).rules[-1]
    assert unreached.name == clause_name(rule, len(rule.hedges))
    assert unreached.why == why


@given(data=st.data())
@settings(max_examples=40)
def test_what_is_written_is_read(tmp_path_factory, data) -> None:
    ruleset = data.draw(rulesets(exotic=True, max_rules=3))
    found = choose_cases(ruleset, data.draw(st.sampled_from(sorted(CRITERIA))))
    if not found.cases:
        return
    path = tmp_path_factory.mktemp("cases") / "x.cases.toml"
    path.write_text(toml(ruleset, "clause", found, None), encoding="utf-8")
    for written, read in zip(found.cases, read_cases(path, ruleset).situations, strict=True):
        assert read.context() == written.context()
        assert read.obligations == written.obligations
        assert (read.prohibitions or ()) == written.prohibitions
        assert read.domain == written.domain
    assert len(json.loads(json_text(ruleset, "clause", found, None))["cases"]) == len(found.cases)


def test_a_single_trigger_is_alone_though_a_hedge_names_another_one() -> None:
    text = "DOMAIN a WHEN T THEN o UNLESS U IN WHICH CASE p\nDOMAIN b WHEN U THEN o"
    found = choose_cases(parse(text), "clause", single=True)
    assert {case.triggers for case in found.cases} == {("T",), ("U",)}
    assert [(u.name, u.why) for u in found.unreached] == [("rule_1.hc1", "only if other triggers also occur")]


def test_long_integers_are_written_and_read(tmp_path: Path) -> None:
    ruleset = parse(f"MEASURE n: integer\nRULE r WHEN T AND n > {10**20} THEN o UNLESS n < {2**63} IN WHICH CASE p")
    found = choose_cases(ruleset, "clause")
    (tmp_path / "x.cases.toml").write_text(toml(ruleset, "clause", found, None), encoding="utf-8")
    read = read_cases(tmp_path / "x.cases.toml", ruleset)
    assert [case.context() for case in read.situations] == [case.context() for case in found.cases]


def test_atoms_are_conditions_once_each() -> None:
    (rule,) = parse("RULE r WHEN T AND a THEN o UNLESS a OR b IN WHICH CASE p UNLESS b").rules
    assert conditions_of(rule) == [Atom("condition", "a"), Atom("condition", "b")]


def test_the_command_never_overwrites_unasked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "house.cases.toml"
    arguments = ["cases", "rulesets/household.sleec", "-o", str(output)]
    assert run(arguments) == 0
    assert "3 situations: 12 of 12 goals covered" in capsys.readouterr().err
    before = output.read_text(encoding="utf-8")
    assert run([*arguments, "--coverage", "mcdc"]) == 2
    assert "use --force to overwrite it" in capsys.readouterr().err
    assert output.read_text(encoding="utf-8") == before
    assert run([*arguments, "--coverage", "mcdc", "--force"]) == 0
    assert output.read_text(encoding="utf-8") != before
    assert len(read_cases(output).situations) == 3
    assert run([*arguments[:-1], str(tmp_path / "no" / "folder"), "--force"]) == 2
    assert "cannot be written" in capsys.readouterr().err


def test_the_command_prints_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["cases", "rulesets/as-evaluated.sleec", "--format", "json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["unreachable"] == [{"goal": "dressing_stop.hc1", "why": "in no situation"}]
    assert said["reached"] == 18
    assert said["ruleset"] == "as-evaluated.sleec"
