"""Demands of now that are met whatever else is the case: what need not be done is left out where it is forbidden, and
what nothing forbids any more is done then."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.timed.addition import Addition
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.free import Free
from sleec_verify.timed.program import Program
from tests.people_rules import peoples_rules
from tests.timed_agreement import SIZES, answered
from tests.timed_strategies import timed_ruleset

RULES = """RULE one WHEN Ring THEN Open WITHIN 1 minute
RULE two WHEN Open THEN Light WITHIN 2 minutes
RULE asked WHEN Knock THEN """


def is_free(asked, rules=RULES):
    program = Program(parse(rules + asked))
    rule = program.ruleset.by_label["asked"]
    (demand,) = program.demands(rule)
    return program.free.is_free_now(demand, rule, 0)


@pytest.mark.parametrize(
    ("asked", "free"),
    [
        ("NOT Open WITHIN [61, 99] seconds", True),
        ("NOT Open WITHIN [60, 99] seconds", False),
        # Light may follow the last that is opened.
        ("NOT Light WITHIN [181, 200] seconds", True),
        ("NOT Light WITHIN [180, 200] seconds", False),
        ("NOT Ring WITHIN [1, 9] seconds", True),
        # What is given with what forbids it is no conflict.
        ("NOT Ring WITHIN [0, 9] seconds", True),
        ("NOT Open WITHIN [0, 9] seconds", False),
        ("NOT Ring WITHIN [0, 9] seconds OTHERWISE NOT Light WITHIN 9 seconds", False),
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


@pytest.mark.parametrize(
    ("relation", "free"), [("RELATION Ring PRECEDES Knock", True), ("RELATION Knock WITNESSES Ring", False)]
)
def test_what_comes_with_what_is_given_is_needed_now(relation, free):
    rules = RULES.replace("RULE asked", f"{relation}\nRULE asked")
    assert is_free("NOT Ring WITHIN 9 seconds", rules) == free
    assert is_free("NOT Ring WITHIN [5, 9] seconds", rules)


@pytest.mark.parametrize(
    ("answer", "asked", "free"),
    [
        # What is done instead leaves more room.
        ("Dim WITHIN 1 minute OTHERWISE Light WITHIN 1 minute", "NOT Dim WITHIN 1 minute", True),
        ("Dim WITHIN 1 minute OTHERWISE Stay WITHIN 1 minute", "NOT Dim WITHIN 1 minute", False),
        ("Stay WITHIN 1 minute OTHERWISE Dim WITHIN 1 minute", "NOT Dim WITHIN 1 minute", False),
        # It may be too late for the other one.
        ("Light WITHIN 1 minute OTHERWISE Dim WITHIN 1 minute", "NOT Dim WITHIN 1 minute", False),
        ("Dim WITHIN 1 minute OTHERWISE NOT Light WITHIN 1 minute", "NOT Dim WITHIN [1, 60] seconds", True),
        ("Dim WITHIN 1 minute OTHERWISE NOT Light WITHIN 1 minute", "NOT Dim WITHIN 1 minute", False),
        ("Dim WITHIN 1 minute OTHERWISE NOT Stay WITHIN 1 minute", "NOT Dim WITHIN [1, 60] seconds", False),
        # If it is never done, what comes in its place asks for nothing.
        ("Dim WITHIN 1 minute OTHERWISE NOT Dim WITHIN 1 minute", "NOT Dim WITHIN 1 minute", True),
        ("Dim WITHIN 1 minute OTHERWISE NOT Dim WITHIN 1 minute", "Dim WITHIN 1 minute", False),
    ],
)
def test_of_several_responses_each_may_be_the_one_that_is_done(answer, asked, free):
    rules = f"""RULE answer WHEN Ring THEN {answer}
RULE stay WHEN Call THEN Stay WITHIN 1 minute
RULE quiet WHEN Hush THEN NOT Stay WITHIN 10 minutes
RULE asked WHEN Knock THEN """
    assert is_free(asked, rules) == free


@pytest.mark.parametrize(
    ("bell", "asked", "free"),
    [
        ("Ring WITHIN 1 hour AND NOT Ring WITHIN 2 hours", "Light WITHIN 1 minute", True),
        ("Ring WITHIN 1 hour", "Light WITHIN 1 minute", False),
        ("Ring WITHIN 1 hour AND NOT Ring WITHIN 2 hours", "Bell WITHIN 1 minute", False),
        # Without the rule that is asked about, it may occur.
        ("Ring WITHIN 1 hour", "NOT Ring WITHIN 2 hours", False),
    ],
)
def test_what_occurs_in_no_trace_stands_in_the_way_of_nothing(bell, asked, free):
    program = Program(
        parse(f"""RULE bell WHEN Bell THEN {bell}
RULE dark WHEN Bell THEN NOT Light WITHIN 1 day
RULE asked WHEN {"Bell" if asked.startswith("NOT") else "Knock"} THEN {asked}""")
    )
    rule = program.ruleset.by_label["asked"]
    assert program.free.is_all_free_now(rule) == free


@pytest.mark.parametrize(
    ("rule", "free"),
    [
        ("RULE asked WHEN Knock THEN Open WITHIN 9 seconds", True),
        ("RULE asked WHEN Hear THEN Open WITHIN 9 seconds", False),
        # To knock first calls for it once more, which has come after it then.
        ("RULE asked WHEN Hear THEN Open WITHIN 9 seconds\nRULE two WHEN Knock THEN Open WITHIN 1 day", False),
    ],
)
def test_what_has_to_come_first_may_be_there(rule, free):
    rules = f"RELATION Knock PRECEDES Open\nRULE hush WHEN Ring THEN NOT Knock WITHIN 1 hour\n{rule}"
    program = Program(parse(rules))
    asked = program.ruleset.by_label["asked"]
    assert program.free.is_all_free_now(asked) == free
    calm = Program(parse(rules.replace("1 hour", "2 seconds")))
    assert calm.free.is_all_free_now(calm.ruleset.by_label["asked"])


@pytest.mark.parametrize(
    ("rules", "asked", "free"),
    [
        # Windows of a minute need it twice in a minute at most.
        ("RULE dim WHEN Call THEN Dim WITHIN 1 minute", "Open WITHIN [20, 22] seconds", True),
        ("RULE dim WHEN Call THEN Dim WITHIN 1 minute", "Open WITHIN [20, 21] seconds", False),
        ("RULE dim WHEN Call THEN Dim EVENTUALLY", "Open WITHIN 3 seconds", True),
        ("RULE dim WHEN Call THEN Dim WITHIN [59, 60] seconds", "Open WITHIN [20, 22] seconds", True),
        # One who calls each second may need it each second.
        ("RULE dim WHEN Call THEN Dim WITHIN [60, 60] seconds", "Open WITHIN [20, 40] seconds", False),
        ("RULE dim WHEN Sing THEN Dim", "Open WITHIN [20, 22] seconds", True),
        ("RULE dim WHEN Sing THEN Dim\nRELATION Dim WITNESSES Hum", "Open WITHIN [20, 22] seconds", True),
        ("RELATION Sing WITNESSES Dim", "Open WITHIN [20, 22] seconds", True),
        ("RELATION Dim PRECEDES Sing", "Open WITHIN [20, 21] seconds", True),
        (
            "RULE dim WHEN Sing THEN Dim\nRULE two WHEN Call THEN Dim WITHIN 1 minute",
            "Open WITHIN [20, 22] seconds",
            False,
        ),
        (
            "RULE dim WHEN Sing THEN Dim\nRULE two WHEN Call THEN Dim WITHIN 1 minute",
            "Open WITHIN [20, 24] seconds",
            True,
        ),
        ("RELATION Open EXCLUDES Sing", "Open WITHIN [20, 22] seconds", True),
        ("RELATION Sing CAUSES dark\nRELATION Dim CAUSES dark", "Open WITHIN [20, 29] seconds", False),
        # The measures may be the same at all times; or else it is a second of its own.
        ("RELATION Open FORBIDS dark\nRULE sad WHEN Sing AND dark THEN Light", "Open WITHIN [20, 21] seconds", True),
        ("RELATION Open FORBIDS dark\nRELATION Sing INCLUDES dark", "Open WITHIN [20, 22] seconds", True),
        ("RELATION Open FORBIDS dark\nRELATION Sing INCLUDES dark", "Open WITHIN [20, 21] seconds", False),
    ],
)
def test_it_may_have_a_second_to_itself(rules, asked, free):
    rules = f"""{rules}
RULE sing WHEN Call THEN Sing WITHIN 1 minute
RELATION Open EXCLUDES Dim
RULE hush WHEN Hush THEN NOT Dim WITHIN 1 day AND NOT Sing WITHIN 1 day
RULE asked WHEN Hear THEN """
    assert is_free(asked, rules) == free


LATE = "RULE late WHEN Ring THEN Stay WITHIN 5 minutes OTHERWISE NOT Open WITHIN 5 minutes"


@pytest.mark.parametrize(
    ("rules", "free"),
    [
        # One stays in any case: what comes if one does not never does.
        (LATE, False),
        (f"{LATE}\nRULE soon WHEN Ring THEN Stay", True),
        (f"{LATE}\nRULE soon WHEN Ring AND dark THEN Stay", False),
        (f"{LATE}\nRULE soon WHEN Ring THEN Stay WITHIN 6 minutes", False),
        # It is dark now, and was light a second ago at the latest.
        ("RULE shut WHEN Knock AND NOT dark THEN NOT Open WITHIN 1 minute", True),
        ("RULE shut WHEN Knock AND warm THEN NOT Open WITHIN 1 minute", False),
        ("RULE shut WHEN Knock AND NOT dark THEN NOT Open WITHIN [1, 61] seconds", False),
        # Who sings while it is warm breaks the rule at once.
        ("RULE never WHEN Sing AND warm THEN NOT Sing WITHIN 1 hour AND NOT Open WITHIN 1 day", True),
        ("RULE never WHEN Sing AND warm THEN NOT Sing WITHIN [1, 9] seconds AND NOT Open WITHIN 1 day", False),
        ("RULE never WHEN Sing AND NOT (warm OR NOT warm) THEN NOT Open WITHIN 1 day", True),
    ],
)
def test_what_cannot_have_been_stands_in_the_way_of_nothing(rules, free):
    assert is_free("Open WITHIN 1 minute", f"{rules}\nRULE asked WHEN Knock AND dark THEN ") == free


@pytest.mark.parametrize(
    ("law", "free"),
    [
        ("RELATION Hum INCLUDES dark\nRELATION Sing FORBIDS dark", True),
        ("RELATION Open FORBIDS dark", False),
        # There is a second without any who hums or sings.
        ("RELATION Hum INCLUDES dark\nRELATION Sing FORBIDS dark\nRULE a WHEN Bell THEN Hum WITHIN 9 seconds", True),
        (
            "RELATION Hum INCLUDES dark\nRELATION Sing FORBIDS dark\nRULE a WHEN Bell THEN Hum WITHIN [9, 9] seconds",
            False,
        ),
        ("ASSUME NOT dark", False),
    ],
)
def test_the_measures_at_its_own_instant_may_ask_for_what_can_be_done(law, free):
    rules = f"""{law}
RULE after WHEN Open THEN Call WITHIN 9 seconds UNLESS dark IN WHICH CASE Light WITHIN 1 minute
RULE hush WHEN Hush THEN NOT Call WITHIN 1 minute AND NOT Hum WITHIN 1 minute
RELATION Light EXCLUDES Stay
RULE asked WHEN Knock THEN """
    assert is_free("Open WITHIN 5 seconds", rules) == free


@pytest.mark.parametrize(("seconds", "free"), [(3, True), (2, False)])
def test_what_comes_with_it_at_once_may_need_the_second_to_itself(seconds, free):
    rules = """RELATION Light EXCLUDES Dim
RULE on WHEN Open THEN Light
RULE dim WHEN Call THEN Dim WITHIN 1 minute
RULE hush WHEN Hush THEN NOT Dim WITHIN 1 day
RULE asked WHEN Hear THEN """
    assert is_free(f"Open WITHIN {seconds} seconds", rules) == free


@pytest.mark.parametrize(("seconds", "free"), [(60, True), (61, False)])
def test_what_is_done_in_time_or_not_at_all(seconds, free):
    rules = f"""RULE ring WHEN Ring THEN Open WITHIN {seconds} seconds
RULE shut WHEN Shut THEN NOT Open WITHIN 1 day
RULE asked WHEN Knock THEN """
    assert is_free("Open WITHIN 1 minute OTHERWISE NOT Open WITHIN 1 hour", rules) == free


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
        ("Dim WITHIN [20, 60] seconds", "Open WITHIN 2 seconds", True),
        ("Dim WITHIN [20, 60] seconds", "Open WITHIN 1 second", False),
        ("Dim WITHIN [20, 20] seconds", "Open WITHIN 2 seconds", False),
        ("Dim WITHIN [20, 60] seconds\nRULE no WHEN No THEN NOT Dim WITHIN 1 day", "Open WITHIN 2 seconds", False),
        ("Dim WITHIN [20, 60] seconds\nRELATION Dim EXCLUDES Dusk", "Open WITHIN 2 seconds", False),
        # It may be done once more a second later, where that is called for only then.
        (
            "Dim WITHIN [20, 60] seconds\nRULE two WHEN Two THEN Open WITHIN [3, 9] seconds",
            "Open WITHIN 2 seconds",
            False,
        ),
        ("Dim WITHIN [20, 60] seconds\nRULE two WHEN Two THEN Open WITHIN 9 seconds", "Open WITHIN 2 seconds", True),
        ("Dim WITHIN [20, 60] seconds\nRELATION Open WITNESSES Two", "Open WITHIN 2 seconds", True),
    ],
)
def test_what_may_not_come_with_it_can_make_way(dim, asked, free):
    rules = f"RELATION Open EXCLUDES Dim\nRULE dim WHEN Knock THEN {dim}\nRULE asked WHEN Hear THEN "
    assert is_free(asked, rules) == free


BRIGHT = """RULE each WHEN Knock THEN Ring WITHIN [9, 9] seconds
RULE more WHEN Ring AND NOT dark THEN Light"""


@pytest.mark.parametrize(
    ("more", "free"),
    [
        ("RULE more WHEN Knock AND dark THEN Light", True),
        # Then it may matter to another one whether it is dark.
        ("RULE more WHEN Ring AND dark THEN Light", True),
        ("RULE each WHEN Knock THEN Ring WITHIN [9, 9] seconds\nRULE more WHEN Ring AND dark THEN Light", True),
        # It is light, and there may be a reason against what that calls for.
        (BRIGHT, True),
        (f"{BRIGHT}\nRULE hush WHEN Hush THEN NOT Light WITHIN 1 day", False),
        ("ASSUME dark", False),
        ("RULE more WHEN Open THEN Ring WITHIN 1 second", True),
        ("RULE more WHEN Open AND NOT dark THEN Ring WITHIN [1, 1] seconds\nRELATION Open FORBIDS dark", True),
        ("RULE more WHEN Open THEN Ring WITHIN 1 second\nRELATION Open INCLUDES dark", False),
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
        program.free.is_all_free_now(rule)
    assert 20 < len(steps) < 30_000


def differing(text, monkeypatch):
    """How many rules have no conflict by this alone."""
    program = Program(parse(text))
    count = 0
    # What leads back to itself takes long.
    for rule in program.rules if program.is_acyclic else ():
        found = answered(lambda: (conflict(program, rule),))  # noqa: B023
        with monkeypatch.context() as patch:
            patch.setattr(Free, "is_free_now", lambda self, demand, *_, **__: self.is_free(demand))
            other = answered(lambda: (conflict(program, rule),))  # noqa: B023
        if found is None or other is None:
            continue
        assert (found[0] is None) == (other[0] is None), (rule.label, text)
        free, demands = program.free, program.demands(rule)
        count += free.is_all_free_now(rule) and not all(map(free.is_free, demands))
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
