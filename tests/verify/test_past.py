"""How many instants before now a conflict may need: examples that need more than rules, and the number against z3."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.solver import Undecided
from sleec_verify.timed import conflicts
from sleec_verify.timed.conflict_cone import Cone
from sleec_verify.timed.conflicts import MOST_PAST, MOST_SECONDS, conflict
from sleec_verify.timed.past import past
from sleec_verify.timed.program import Program
from tests import timed_oracle as oracle
from tests.timed_agreement import SIZES, answered
from tests.timed_strategies import timed_ruleset


def asked(text, label):
    program = Program(parse(text))
    rule = program.ruleset.by_label[label]
    return program, rule, past(program, Cone(program, rule).rules.values())


@pytest.mark.parametrize("seconds", [1, 2, 3, 4])
def test_one_rule_may_have_to_be_triggered_many_times(seconds):
    # Each knock keeps the door shut for one second only.
    slow = f"RULE slow WHEN Knock THEN NOT Open WITHIN [{seconds}, {seconds}] seconds\n"
    program, rule, bound = asked(slow + f"RULE fast WHEN Ring THEN Open WITHIN {seconds} seconds", "fast")
    found = conflict(program, rule)
    assert found is not None
    assert len(found.instants) == seconds + 1
    assert bound.known
    assert bound.most >= seconds
    assert bound.pending >= seconds


@pytest.mark.parametrize("seconds", [9, 20])
def test_instants_at_any_of_the_last_seconds_are_tried_together(seconds):
    slow = f"RULE slow WHEN Knock THEN NOT Open WITHIN [{seconds}, {seconds}] seconds\n"
    program, rule, bound = asked(slow + f"RULE fast WHEN Ring THEN Open WITHIN {seconds} seconds", "fast")
    assert bound.most > MOST_PAST
    assert bound.reach == seconds
    found = conflict(program, rule)
    assert found is not None
    assert len(found.instants) == seconds + 1
    program, rule, _ = asked(slow + f"RULE fast WHEN Ring THEN Open WITHIN {seconds + 1} seconds", "fast")
    assert conflict(program, rule) is None


def test_what_comes_before_the_last_seconds_is_tried_with_them(monkeypatch):
    monkeypatch.setattr(conflicts, "MOST_PAST", 2)
    # A knock long ago counts still, one a second keeps the window shut.
    text = """RULE slow WHEN Knock THEN NOT Open WITHIN [6, 6] seconds
    RULE night WHEN Night THEN NOT Shut EVENTUALLY
    RULE fast WHEN Ring THEN Open WITHIN 6 seconds OTHERWISE Shut WITHIN 3 seconds"""
    program, rule, bound = asked(text, "fast")
    assert bound.endless == 1
    found = conflict(program, rule)
    assert found is not None
    program, rule, _ = asked(text.replace("NOT Shut EVENTUALLY", "NOT Shut WITHIN 8 seconds"), "fast")
    assert conflict(program, rule) is None


def test_more_than_are_tried_is_unknown():
    # A second less, and no unit is left that has several.
    text = "RULE slow WHEN Knock THEN NOT Open WITHIN [2, 2] minutes\nRULE fast WHEN Ring THEN Open WITHIN 119 seconds"
    program, rule, bound = asked(text, "fast")
    assert bound.reach > MOST_SECONDS
    with pytest.raises(Undecided, match="no conflict with up to 8 instants before now"):
        conflict(program, rule)


@pytest.mark.parametrize(
    ("text", "acyclic"),
    [
        ("RULE a WHEN A THEN B\nRULE b WHEN B THEN C WITHIN 2 seconds", True),
        ("RULE a WHEN A THEN B\nRULE b WHEN B THEN NOT A", True),
        ("RULE a WHEN A THEN NOT B OTHERWISE A", False),
        ("RULE a WHEN A THEN B\nRULE b WHEN B THEN C\nRULE c WHEN C THEN D UNLESS x IN WHICH CASE A", False),
        ("RULE a WHEN A THEN B\nRELATION B EQUALS A", False),
        ("RULE a WHEN A THEN B\nRELATION C EQUALS D\nRELATION D EQUALS B", True),
        ("RULE a WHEN A THEN B\nRELATION C EQUALS D\nRELATION D EQUALS B\nRULE b WHEN C THEN A", False),
    ],
)
def test_what_calls_for_itself(text, acyclic):
    assert Program(parse(text)).is_acyclic is acyclic


def test_calls_between_which_what_is_done_decides_add_up():
    # Whenever X is done, one of the calls for E cannot be met; each of them can, if X is done at another time.
    text = """RULE a WHEN A THEN E WITHIN [5, 5] seconds
    RULE r WHEN B THEN X WITHIN 3 seconds
    RULE x WHEN X THEN NOT E"""
    program, rule, bound = asked(text, "r")
    found = conflict(program, rule)
    assert found is not None
    assert [set(instant.events) for instant in found.instants[:3]] == [{"A"}] * 3
    assert bound.pending >= 3


def test_what_triggers_itself_again():
    # The check demands another night soon, which shuts for longer.
    text = """RULE shut WHEN Night THEN NOT Open WITHIN 5 minutes
    RULE again WHEN Night THEN Check WITHIN [1, 2] minutes
    RULE checked WHEN Check THEN Night WITHIN [1, 2] minutes UNLESS stops
    RULE fast WHEN Ring THEN Open WITHIN 6 minutes"""
    program, rule, bound = asked(text, "fast")
    assert not bound.known
    found = conflict(program, rule)
    assert found is not None
    assert set(found.matter) == {"fast", "shut", "checked"}
    program, rule, _ = asked(text.replace("6 minutes", "4 minutes"), "fast")
    assert conflict(program, rule) is not None


@pytest.mark.parametrize(
    ("rules", "pending"),
    [
        # One of them ends first; what has to happen some time or other is done with that.
        ("RULE a WHEN t THEN Open WITHIN [1, 9] minutes\nRULE b WHEN u THEN Open EVENTUALLY", 1),
        # Whatever is done, each can be done or cannot: all of them together are one.
        ("RULE a WHEN t THEN Open WITHIN [3, 9] minutes\nRULE b WHEN u THEN Note WITHIN [3, 9] minutes", 1),
        # Nothing forbids them.
        ("RULE a WHEN t THEN File WITHIN 9 minutes\nRULE b WHEN u THEN File WITHIN 2 minutes OTHERWISE File", 0),
        # The oldest that is over for Open, and as many as there are seconds until then.
        ("RULE a WHEN t THEN Open WITHIN 5 seconds OTHERWISE Shut WITHIN 9 seconds\nRULE o WHEN Open THEN Note", 5),
        # Those that broke the prohibition long ago, and those that may still do.
        (
            """RULE a WHEN t THEN NOT Open WITHIN 5 seconds OTHERWISE Shut WITHIN 9 seconds
            RULE b WHEN u THEN Open
            RULE o WHEN Shut THEN Note""",
            6,
        ),
    ],
)
def test_few_triggerings_say_what_all_say(rules, pending):
    forbidden = "RULE x WHEN x THEN NOT Open AND NOT Note AND NOT Shut"
    assert asked(f"{rules}\n{forbidden}", "a")[2].pending == pending


def test_what_broke_a_prohibition_is_an_instant_of_its_own():
    text = """RULE answer WHEN Bell THEN Speak
    RULE hush WHEN Night THEN NOT Bell WITHIN [2, 2] seconds OTHERWISE NOT Speak WITHIN [1, 3] seconds"""
    program, rule, _ = asked(text, "answer")
    found = conflict(program, rule)
    assert found is not None
    assert [set(instant.events) for instant in found.instants] == [{"Night"}, {"Bell", "Speak"}, {"Bell"}]


def test_rules_of_one_event_need_one_instant_each_way():
    hours = "\n".join(f"RULE r{n} WHEN t{n} THEN NOT Open WITHIN {n} hours" for n in range(1, 9))
    minutes = "\n".join(f"RULE s{n} WHEN u{n} THEN Open WITHIN {n} minutes" for n in range(1, 9))
    assert asked(f"{hours}\n{minutes}", "s8")[2][:2] == (2, True)
    # What nothing calls for need not happen again.
    assert asked(hours, "r8")[2] == (0, True, 0, 8 * 3600, 0)


LATER = "RULE b WHEN t THEN Note WITHIN [1, 2] minutes"


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        # Both can be done at once where nothing forbids it.
        ("RULE b WHEN t THEN Note WITHIN 1 minute", (2, True)),
        # It may have to wait for its own time.
        ("RULE b WHEN t THEN Note WITHIN 1 minute\nRULE c WHEN u THEN NOT Note", (3, True)),
        (LATER, (3, True)),
        # And what it calls for, too.
        (f"{LATER}\nRULE c WHEN Note THEN File WITHIN [1, 2] minutes", (4, True)),
        (f"{LATER}\nRULE c WHEN Note THEN t WITHIN [1, 2] minutes", (122, False)),
        # Done at once, but not whatever the conditions; or because of a relation.
        (
            "RULE b WHEN t THEN Note WITHIN 1 minute\nRULE c WHEN t THEN Note UNLESS c\nRULE d WHEN Note THEN NOT u",
            (3, True),
        ),
        (
            "RULE b WHEN t THEN Note WITHIN 1 minute\nRULE c WHEN t THEN Note\nRULE d WHEN Note THEN NOT u",
            (2, True),
        ),
        ("RELATION t WITNESSES u\nRULE b WHEN u THEN Note WITHIN [1, 2] minutes", (3, True)),
        # What calls for itself from then on, and nothing that keeps it from being done at once.
        ("RULE b WHEN t THEN t WITHIN 1 minute\nRULE c WHEN Note THEN NOT t", (3, True)),
        ("RULE b WHEN t THEN Note WITHIN 1 minute\nRULE c WHEN Note THEN File WITHIN 1 minute", (2, True)),
    ],
)
def test_what_a_trigger_brings_with_it(rules, expected):
    text = f"RULE a WHEN t THEN NOT Open WITHIN 1 hour\nRULE z WHEN z THEN Open WITHIN 1 hour\n{rules}"
    assert asked(text, "z")[2][:2] == expected


def bound_agrees(seed, size):
    ruleset = timed_ruleset(seed, **size)
    program = Program(ruleset)
    for rule in ruleset.rules:
        found = answered(lambda: (past(program, Cone(program, rule).rules.values()), conflict(program, rule)))  # noqa: B023
        if found is not None and found[1] is None and found[0].most <= 3:
            more = found[0].most + 2
            theirs = answered_by_z3(ruleset, rule.label, more)
            assert not theirs, f"seed {seed}: a conflict with {more} instants before now\n{ruleset.source.text}"


def answered_by_z3(ruleset, label, instants):
    try:
        return oracle.conflict(ruleset, label, past=instants, later=2, longest=instants + 3).found
    except oracle.Undecided:
        return False


@pytest.mark.slow
@pytest.mark.parametrize("first", range(6_000, 6_004, 2))
def test_no_history_with_more_instants_conflicts(first):
    for seed in range(first, first + 2):
        bound_agrees(seed, SIZES[seed % 2])


@pytest.mark.long
@pytest.mark.parametrize("first", range(7_000, 8_000, 100))
def test_no_history_with_more_instants_conflicts_in_many(first):
    for seed in range(first, first + 100):
        bound_agrees(seed, SIZES[seed % 2])
