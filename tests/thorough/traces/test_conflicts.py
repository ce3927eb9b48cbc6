"""Conflicts of rules with time: worked examples, an explicit-state oracle, and metamorphic properties."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from pathlib import Path

import pytest

from sleec_runtime.language import load, parse
from sleec_verify.encoding.budget import for_file, share
from sleec_verify.encoding.solver import Undecided
from sleec_verify.traces.components import components
from sleec_verify.traces.conflicts import Conflict, ConflictSearch
from sleec_verify.traces.index import TraceIndex
from tests.support.explicit.conflicts import Explicit
from tests.support.paths import ROOT
from tests.support.realistic_rules import LONG, peoples_rules
from tests.support.studies import each_study

EXAMPLES = ROOT.parent / "shared" / "conflict-examples.json"


def conflicts_of(text: str) -> tuple[list[Conflict], str | None]:
    """The conflicts that the engine finds, and why there may be more."""
    found: list[Conflict] = []
    reason = None
    for component in components(TraceIndex(parse(text))):
        try:
            found.extend(ConflictSearch(component).find())
        except Undecided as error:
            reason = str(error)
    return found, reason


def rules_of(text: str) -> set[frozenset[str]]:
    found, reason = conflicts_of(text)
    assert reason is None
    return {frozenset(conflict.rules) for conflict in found}


def dsl(*rules: str, events: str = "ABCDFGLOPTXY", relations: tuple[str, ...] = ()) -> str:
    lines = ["def_start", *(f"  event {event}" for event in events), "  measure b0: boolean", "  measure b1: boolean"]
    lines += ["  measure r: scale(low, middle, high)", "def_end"]
    lines += ["rule_start", *(f"  R{number} when {rule}" for number, rule in enumerate(rules, 1)), "rule_end"]
    lines += ["relation_start", *(f"  {relation}" for relation in relations), "relation_end"] if relations else []
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("rules", "relations", "expected"),
    [
        # A deadline that a prohibition outlasts.
        (("A then X within 3 seconds", "B then not X within 2 seconds"), (), [{"R1", "R2"}]),
        # The alternative stays possible.
        (("A then X within 2 seconds otherwise Y within 1 seconds", "B then not X within 3 seconds"), (), []),
        # A smaller set of pairs hides a larger one.
        (("A then X", "X then not Y", "A then Y"), (), [{"R2", "R3"}]),
        # No rule requires what is forbidden, or excluded.
        (("P then T", "T then not D"), (), []),
        (("F then O",), ("mutualExclusive O L",), []),
        # Two rules that require the same do not hide each other.
        (("F then O", "F then O", "G then L"), ("mutualExclusive O L",), [{"R1", "R3"}, {"R2", "R3"}]),
        # A rule that forbids an input is no conflict; one that forbids its own trigger is.
        (("A then not B", "B then X"), (), []),
        (("A then not A",), (), [{"R1"}]),
        # Hedges decide by the measures of the trigger.
        (("A then X unless {b0}", "B then not X unless (not {b0})"), (), []),
        # T occurs as an input, too: the chain from A adds a rule to that conflict.
        (("A then T", "T then not D", "B then D"), (), [{"R2", "R3"}]),
        # One trigger yields to another.
        (("A then X unless B", "B then Y"), ("mutualExclusive X Y",), []),
        (("A then X unless C", "B then Y"), ("mutualExclusive X Y",), [{"R1", "R2"}]),
        # What a hedge names occurs, though it triggers no rule.
        (("A then X unless B then not X", "C then X"), (), [{"R1", "R2"}]),
        # A hedge was decided by what occurred then.
        (("A then X within 3 seconds unless (not B)", "B then Y", "C then not X within 5 seconds"), (), [{"R1", "R3"}]),
        (("A and B then X within 3 seconds", "C then not X within 5 seconds unless B"), (), [{"R1", "R2"}]),
    ],
)
def test_worked_examples(rules: tuple[str, ...], relations: tuple[str, ...], expected: list[set[str]]) -> None:
    assert rules_of(dsl(*rules, relations=relations)) >= {frozenset(e) for e in expected}
    assert (not expected) == (not rules_of(dsl(*rules, relations=relations)))


@pytest.mark.parametrize("seconds", [1, 2, 3, 5])
def test_a_conflict_does_not_hide_one_with_more_rules(seconds: int) -> None:
    """In {R2, R3}, F is an input. In the other conflict it is the response of R1, and R2 has no clause that decides."""
    rules = f"A then F within {seconds} seconds", "F then N within 1 seconds", "B then not N within 3 seconds"
    assert rules_of(dsl(*rules, events="ABFN")) == {frozenset({"R2", "R3"}), frozenset({"R1", "R2", "R3"})}


def test_a_conflict_has_a_lawful_history() -> None:
    (conflict,), reason = conflicts_of(dsl("A then X within 3 minutes", "B then not X within 2 minutes"))
    assert reason is None
    assert [sorted(moment.events) for moment in conflict.history] == [["A"]]
    assert sorted(conflict.now.events) == ["B"]
    assert 60 <= conflict.now.time - conflict.history[0].time <= 3 * 60


def test_without_need_of_one_there_is_no_history() -> None:
    (conflict,), reason = conflicts_of(dsl("A then X within 3 minutes", "B then not X within 5 minutes"))
    assert reason is None
    assert (conflict.history, sorted(conflict.now.events)) == ((), ["A", "B"])


def test_a_conflict_shows_events_and_no_states_that_stand_for_them() -> None:
    (conflict,), reason = conflicts_of(
        dsl("A then X within 3 minutes unless (not B)", "C then not X within 5 minutes unless F")
    )
    assert reason is None
    assert (conflict.history, sorted(conflict.now.events)) == ((), ["A", "B", "C"])
    assert (conflict.now.conditions, conflict.relations) == ({}, ())
    (conflict,), _ = conflicts_of(dsl("A then X within 3 minutes unless (not B)", "C then not X within 1 minutes"))
    assert [sorted(moment.events) for moment in conflict.history] == [["A", "B"]]
    assert all(not moment.conditions for moment in conflict.history)


@pytest.mark.parametrize("unit", ["seconds", "minutes", "days"])
@pytest.mark.parametrize("length", [1, 5])
def test_a_chain_of_responses_without_end_is_refuted_by_induction(length: int, unit: str) -> None:
    """Each A requires a later C and each C a later A: B, which would end it, is forbidden for long enough."""
    text = dsl(
        f"A then B within {2 * length} {unit} otherwise C within {length} {unit}",
        f"C then A within {2 * length} {unit} otherwise B within {length} {unit}",
        f"A then not B within {6 * length} {unit}",
    )
    assert rules_of(text) == {frozenset({"R2", "R3"}), frozenset({"R1", "R2", "R3"})}


@pytest.mark.parametrize("unit", ["seconds", "minutes", "hours", "days"])
def test_a_conflict_does_not_hide_behind_inputs_of_other_rules(unit: str) -> None:
    """Each second of a window gives situations of its own, with any inputs; all of them are excluded at once."""
    text = dsl(
        f"A then X within [3,11] {unit}",
        "B then Y unless (not {b0}) then X",
        f"B then not X within [7,9] {unit}",
        "C then not Y",
        f"D then X within 5 {unit}",
        f"F then not X within 8 {unit}",
    )
    assert rules_of(text) >= {frozenset({"R2", "R3"}), frozenset({"R5", "R6"})}


@pytest.mark.parametrize("unit", ["seconds", "minutes", "hours", "days"])
@pytest.mark.parametrize("tail", ["", " otherwise Y", " otherwise X"])
def test_any_number_of_pending_demands_of_one_response(unit: str, tail: str) -> None:
    """Each of any number of pending triggerings is met at a time of its own, however long the windows are."""
    text = dsl(
        f"A then X within [3,11] {unit}{tail}",
        f"B then not X within 2 {unit}",
        "C then X unless {b0} then not Y",
        f"D then Y within [4,9] {unit}",
    )
    found = rules_of(text)
    assert frozenset({"R2", "R3"}) in found
    assert frozenset({"R3", "R4"}) in found
    assert (frozenset({"R1", "R2"}) in found) == (tail != " otherwise Y")
    if not tail:
        assert found == {frozenset(pair) for pair in ({"R2", "R3"}, {"R3", "R4"}, {"R1", "R2"})}


@pytest.mark.parametrize("seed", range(0, 60, 3))
def test_rules_as_people_write_them_are_decided(seed: int) -> None:
    with for_file(1_000):
        found, reason = conflicts_of(peoples_rules(seed))
    assert reason is None
    pairs = [set(conflict.pairs) for conflict in found]
    assert not any(one < other for one in pairs for other in pairs)


def test_a_budget_ends_the_search_with_what_was_found() -> None:
    with for_file(0), share(0.05):
        found, reason = conflicts_of(peoples_rules(5, 12, LONG))
    assert found
    assert reason is not None
    assert "limit of steps" in reason


def assert_agrees(text: str, smallest: set[frozenset[str]], every: set[frozenset[str]]) -> bool:
    """The engine finds each smallest set and none that is not one; returns whether it decided everything."""
    found, reason = conflicts_of(text)
    sets = {frozenset(conflict.rules) for conflict in found}
    assert sets <= every
    assert reason is not None or smallest <= sets
    return reason is None


def examples(first: int, last: int) -> int:
    if not EXAMPLES.exists():
        pytest.skip("the examples of others are not part of the project")
    chosen = json.loads(EXAMPLES.read_text())[first:last]
    return sum(
        not assert_agrees(one["dsl"], {frozenset(s) for s in one["smallest"]}, {frozenset(s) for s in one["all"]})
        for one in chosen
    )


@pytest.mark.slow
def test_examples_of_an_exact_automaton() -> None:
    assert examples(0, 20) <= 1


@pytest.mark.long
def test_all_examples_of_an_exact_automaton() -> None:
    assert examples(0, 150) <= 8


RELATIONS = (
    "mutualExclusive A B",
    "happenBefore A B",
    "witness C D",
    "equal A C",
    "causation C {b0}",
    "includes B {b0}",
    "forbid D {b0}",
    "measure invariant {b0}",
    "measure imply {b0} ({r} > low)",
    "measure iff {b0} {b1}",
    "measure opposite {b0} {b1}",
    "when A then {b0} until B",
    "when A and {b1} then (not {b0}) until C and {b1}",
    "when C then {b0} for 2 seconds",
)


def random_rules(seed: int) -> str:
    """Three rules over few events, with windows of at most two seconds, and sometimes a relation."""
    chance = random.Random(seed)

    def response(depth: int = 0) -> str:
        text = f"{'not ' if chance.random() < 0.4 else ''}{chance.choice('ABCD')}"
        kind = chance.random()
        if kind < 0.5:
            start = chance.randint(0, 1)
            window = f"within [{start},{start + chance.randint(0, 1)}]" if chance.random() < 0.3 else "within 2"
            text += f" {window} seconds" if chance.random() < 0.85 else " eventually"
            if depth == 0 and chance.random() < 0.3:
                text += f" otherwise {response(1)}"
        return text

    rules = []
    for _ in range(3):
        rule = f"{chance.choice('ABCD')}{' and {b0}' if chance.random() < 0.3 else ''} then {response()}"
        if chance.random() < 0.3:
            condition = chance.choice(("{b0}", "({r} >= middle)"))
            rule += f" unless {condition}{' then ' + response() if chance.random() < 0.7 else ''}"
        rules.append(rule)
    chosen = (chance.choice(RELATIONS),) if chance.random() < 0.6 else ()
    return dsl(*rules, events="ABCD", relations=chosen)


def agreement(seeds: range, rules: Callable[[int], str] = random_rules) -> int:
    undecided = 0
    for seed in seeds:
        text = rules(seed)
        every = Explicit(parse(text)).conflicts()
        smallest = {rules for rules in every if not any(other < rules for other in every)}
        undecided += not assert_agrees(text, smallest, every)
    return undecided


@pytest.mark.slow
def test_agreement_with_explicit_states() -> None:
    assert agreement(range(60)) <= 1


@pytest.mark.long
def test_long_agreement_with_explicit_states() -> None:
    assert agreement(range(1000, 1600)) <= 6


def random_named(seed: int) -> str:
    """Three rules, with conditions that name events of the environment. One in ten names a response."""
    chance = random.Random(seed)

    def condition() -> str:
        event = chance.choice("ABF" if chance.random() < 0.9 else "CD")
        return chance.choice((event, f"(not {event})", f"({event} or {{b0}})"))

    def response() -> str:
        window = chance.choice(("", "", " within 1 seconds", " within 2 seconds", " within [1,2] seconds"))
        return f"{'not ' if chance.random() < 0.45 else ''}{chance.choice('CD')}{window}"

    rules = []
    for _ in range(3):
        rule = f"{chance.choice('AABBC')}{' and ' + condition() if chance.random() < 0.3 else ''} then {response()}"
        for _ in range(chance.randint(0, 2)):
            rule += f" unless {condition()}{' then ' + response() if chance.random() < 0.7 else ''}"
        rules.append(rule)
    relation = chance.choice(("mutualExclusive A B", "happenBefore A B", "witness A B", "includes B {b0}"))
    return dsl(*rules, events="ABCDF", relations=(relation,) if chance.random() < 0.3 else ())


def test_agreement_about_conditions_that_name_events() -> None:
    assert agreement(range(40), random_named) <= 12


@pytest.mark.long
def test_long_agreement_about_conditions_that_name_events() -> None:
    assert agreement(range(1000, 1400), random_named) <= 120


def random_declared(seed: int) -> str:
    """Three rules, and one event that is declared as the environment's."""
    event = random.Random(seed).choice("ABCD")
    return random_rules(seed).replace(f"  event {event}\n", f"  event {event} as environment\n")


@pytest.mark.slow
def test_agreement_about_declared_events() -> None:
    assert agreement(range(3000, 3040), random_declared) <= 1


@pytest.mark.parametrize("seed", range(12))
def test_rules_over_fresh_names_change_nothing(seed: int) -> None:
    text = random_rules(seed)
    more = text.replace("def_end", "  event Z\n  event W\ndef_end").replace(
        "rule_end", "  R7 when Z then W within 5 minutes\n  R8 when Z then not W within 2 minutes\nrule_end"
    )
    before, after = conflicts_of(text), conflicts_of(more)
    own = [conflict for conflict in after[0] if not {"R7", "R8"} & set(conflict.rules)]
    # The formulas of a refutation number their variables in the order of all rules.
    assert [c._replace(refutation=b.refutation) for c, b in zip(own, before[0])] == before[0]
    assert len(own) == len(before[0])
    assert after[1] == before[1]


def with_simple_windows() -> list[int]:
    return [seed for seed in range(100) if "[" not in random_rules(seed) and "otherwise" not in random_rules(seed)][:20]


@pytest.mark.parametrize("seed", with_simple_windows())
def test_scaling_all_windows_changes_no_rules(seed: int) -> None:
    text = random_rules(seed)
    found, reason = conflicts_of(text)
    scaled, other = conflicts_of(text.replace("seconds", "minutes"))
    assert (reason, other) == (None, None)
    assert {frozenset(c.rules) for c in found} == {frozenset(c.rules) for c in scaled}


@each_study
def test_studies_are_decided(path: Path) -> None:
    ruleset = load(path)
    for one in [ruleset.in_domain(domain) for domain in ruleset.domains] or [ruleset]:
        for component in components(TraceIndex(one)):
            list(ConflictSearch(component).find())
