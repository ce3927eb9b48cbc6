"""Demands of now that are met whatever else is the case: what need not be done is left out where it is forbidden, and
what nothing forbids any more is done then."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.timed.addition import Addition
from sleec_verify.timed.brought import Brought
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.program import Program
from tests.people_rules import peoples_rules
from tests.timed_agreement import SIZES, answered
from tests.timed_strategies import timed_ruleset

RULES = """RULE one WHEN Ring THEN Open WITHIN 1 minute
RULE two WHEN Open THEN Light WITHIN 2 minutes
RULE asked WHEN Knock THEN """


def is_free(asked, rules=RULES):
    program = Program(parse(rules + asked))
    (demand,) = program.demands(program.ruleset.by_label["asked"])
    return program.brought.is_free_now(demand)


@pytest.mark.parametrize(
    ("asked", "free"),
    [
        ("NOT Open WITHIN [61, 99] seconds", True),
        ("NOT Open WITHIN [60, 99] seconds", False),
        # Light may follow the last that is opened.
        ("NOT Light WITHIN [181, 200] seconds", True),
        ("NOT Light WITHIN [180, 200] seconds", False),
        ("NOT Ring WITHIN [1, 9] seconds", True),
        ("NOT Ring WITHIN [0, 9] seconds", False),
        ("NOT Light WITHIN 1 minute OTHERWISE NOT Open WITHIN 1 minute", False),
        ("NOT Light WITHIN 1 minute OTHERWISE NOT Light WITHIN [121, 180] seconds", True),
    ],
)
def test_what_nothing_needs_by_then_can_be_left_out(asked, free):
    assert is_free(asked) == free


@pytest.mark.parametrize(
    ("relation", "free"),
    [
        ("RELATION Ring PRECEDES Dim", False),
        ("RELATION Dim PRECEDES Ring", True),
        ("NEVER Dim AND Ring", False),
        ("EXCLUSIVE Dim, Ring", True),
    ],
)
def test_what_a_law_calls_for_may_be_needed(relation, free):
    rules = RULES.replace("RULE asked", f"{relation}\nRULE dim WHEN Open THEN Dim WITHIN 1 minute\nRULE asked")
    assert is_free("NOT Ring WITHIN [5, 9] seconds", rules) == free


DARK = """RULE dark WHEN Knock THEN NOT Light WITHIN [2, 4] seconds
RULE late WHEN Dim THEN NOT Light WITHIN 7 seconds
RULE two WHEN Open THEN Light WITHIN 2 minutes
RULE close WHEN Close THEN NOT Knock WITHIN 1 minute
RULE turn WHEN Turn THEN Open WITHIN 8 seconds OTHERWISE Close
RULE never WHEN Never THEN Close WITHIN 1 second OTHERWISE NOT Turn
RULE asked WHEN Hear THEN """


@pytest.mark.parametrize(
    ("asked", "free"),
    [
        ("Light WITHIN 8 seconds", True),
        ("Light WITHIN 7 seconds", False),
        ("Light WITHIN [3, 8] seconds", True),
        ("Light EVENTUALLY", True),
        # What is opened calls for light, which comes after all that forbids it.
        ("Open WITHIN 8 seconds", True),
        ("Open", True),
        # Nothing needs that one knocks.
        ("Close WITHIN 1 second", True),
        ("Close", False),
        ("Turn WITHIN 9 seconds", True),
        ("Turn EVENTUALLY", True),
    ],
)
def test_what_nothing_stands_in_the_way_of_any_more_can_be_done(asked, free):
    assert is_free(asked, DARK) == free


def test_what_can_come_after_all_else_stands_in_the_way_of_nothing_before():
    rules = """RULE alarm WHEN Fire THEN Alarm EVENTUALLY
RULE calm WHEN Alarm THEN NOT Land WITHIN 20 seconds
RULE asked WHEN Low THEN """
    assert is_free("Land WITHIN 1 minute", rules)
    assert is_free("NOT Alarm WITHIN [1, 60] seconds", rules)
    assert not is_free("Land WITHIN 1 minute", rules.replace("NOT Land WITHIN 20 seconds", "NOT Land EVENTUALLY"))
    assert is_free("Land WITHIN 1 minute", rules.replace("Alarm EVENTUALLY", "Alarm WITHIN 50 seconds"))
    assert not is_free("Land WITHIN 1 minute", rules.replace("Alarm EVENTUALLY", "Alarm WITHIN [45, 50] seconds"))


@pytest.mark.parametrize(
    ("relation", "free"),
    [
        # Dimming is called for up to a minute from now.
        ("RELATION Open EXCLUDES Dim", True),
        ("RELATION Light EXCLUDES Dim", True),
        ("RELATION Open EXCLUDES Open", False),
        ("RELATION Open WITNESSES Dim", True),
        ("RELATION Open WITNESSES Ring", False),
        ("RELATION Open PRECEDES Ring", True),
        ("RELATION Ring PRECEDES Open", False),
        # Nobody else minds whether it is dark then.
        ("RELATION Open FORBIDS dark", True),
        ("RELATION Open FORBIDS dark\nRELATION Open INCLUDES dark", False),
        ("RELATION Ring FORBIDS dark", True),
        ("RELATION Ring CAUSES dark", False),
        ("RELATION WHEN Ring THEN dark FOR 1 minute", False),
        ("NEVER Dim AND Ring", False),
    ],
)
def test_laws_may_stand_in_the_way(relation, free):
    rules = f"""{relation}
RULE one WHEN Open THEN Light WITHIN 2 minutes
RULE dim WHEN Knock THEN Dim WITHIN 1 minute
RULE ring WHEN Ring THEN NOT Open WITHIN 1 minute
RULE asked WHEN Hear THEN """
    assert is_free("Open WITHIN [5, 61] seconds", rules) == free


@pytest.mark.parametrize(
    ("dim", "asked", "free"),
    [
        ("Dim WITHIN 1 minute", "Open WITHIN 2 seconds", True),
        # Who dims at that second may as well do so a second later.
        ("Dim WITHIN [20, 60] seconds", "Open WITHIN 3 seconds", True),
        ("Dim WITHIN [20, 60] seconds", "Open WITHIN 2 seconds", False),
        ("Dim WITHIN [20, 20] seconds", "Open WITHIN 3 seconds", False),
        ("Dim WITHIN [20, 60] seconds\nRULE no WHEN No THEN NOT Dim WITHIN 1 day", "Open WITHIN 3 seconds", False),
        ("Dim WITHIN [20, 60] seconds\nRELATION Dim EXCLUDES Dusk", "Open WITHIN 3 seconds", False),
    ],
)
def test_what_may_not_come_with_it_can_make_way(dim, asked, free):
    rules = f"RELATION Open EXCLUDES Dim\nRULE dim WHEN Knock THEN {dim}\nRULE asked WHEN Hear THEN "
    assert is_free(asked, rules) == free


@pytest.mark.parametrize(
    ("more", "free"),
    [
        ("RULE more WHEN Knock AND dark THEN Light", True),
        # Then it may matter to another one whether it is dark.
        ("RULE more WHEN Ring AND dark THEN Light", False),
        ("ASSUME dark", False),
        ("RULE more WHEN Open THEN Ring WITHIN 1 second", False),
        ("RELATION Open INCLUDES dark", False),
    ],
)
def test_at_a_time_of_its_own_the_measures_may_ask_for_nothing(more, free):
    rules = f"""{more}
RULE open WHEN Open AND dark THEN NOT Ring WITHIN 5 seconds
RULE ring WHEN Knock THEN Ring WITHIN [20, 40] seconds
RULE asked WHEN Hear THEN """
    assert is_free("Open WITHIN 8 seconds", rules) == free


@pytest.mark.parametrize(("seed", "untimed"), [(34, "eventually"), (64, "eventually"), (158, "at"), (208, "at")])
def test_what_comes_back_to_itself_takes_few_steps(seed, untimed, monkeypatch):
    steps = []
    add = Addition._add

    def counted(*given):
        steps.append(given[1])
        return add(*given)

    monkeypatch.setattr(Addition, "_add", counted)
    program = Program(timed_ruleset(seed, **SIZES[seed % 3]), untimed)
    for rule in program.rules:
        for demand in program.demands(rule):
            program.brought.is_free_now(demand)
    assert 20 < len(steps) < 1000


def differing(text, monkeypatch):
    """How many rules have no conflict by this alone."""
    program = Program(parse(text))
    count = 0
    # What leads back to itself takes long.
    for rule in program.rules if program.is_acyclic else ():
        found = answered(lambda: (conflict(program, rule),))  # noqa: B023
        with monkeypatch.context() as patch:
            patch.setattr(Brought, "is_free_now", Brought.is_free)
            other = answered(lambda: (conflict(program, rule),))  # noqa: B023
        if found is None or other is None:
            continue
        assert (found[0] is None) == (other[0] is None), (rule.label, text)
        brought, demands = program.brought, program.demands(rule)
        count += all(map(brought.is_free_now, demands)) and not all(map(brought.is_free, demands))
    return count


def random_text(seed, minutes):
    text = timed_ruleset(seed, **SIZES[seed % 3]).source.text
    return text.replace(" seconds", " minutes") if minutes else text


def test_a_rule_of_which_all_is_free_has_no_conflict(monkeypatch):
    found = [differing(random_text(seed, seed % 2 == 1), monkeypatch) for seed in (*range(2800, 3000), 4079)]
    assert sum(found) > 5


def test_a_rule_of_people_of_which_all_is_free_has_no_conflict(monkeypatch):
    found = [differing(peoples_rules(seed), monkeypatch) for seed in range(60)]
    assert sum(found) > 30


@pytest.mark.long
@pytest.mark.parametrize("first", range(5000, 8000, 100))
def test_many_rules_of_which_all_is_free_have_no_conflict(first, monkeypatch):
    for seed in range(first, first + 100):
        differing(random_text(seed, seed % 2 == 1), monkeypatch)
        differing(peoples_rules(seed), monkeypatch)
