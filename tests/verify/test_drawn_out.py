"""Conflicts in which every second matters: drawn out from those of the same rules with shorter windows."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model_time import Lasting
from sleec_runtime.trace import broken_so_far
from sleec_verify.report.timeline import chart_of, in_words
from sleec_verify.solver import Undecided
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.drawn_out import drawn_out, shortened
from sleec_verify.timed.histories import after
from sleec_verify.timed.instant import Fixed
from sleec_verify.timed.program import Program
from sleec_verify.timed.replay import as_trace
from sleec_verify.timed.responses import Occurs
from tests.timed_agreement import SIZES
from tests.timed_strategies import timed_ruleset

FILLED = """RULE slow WHEN Knock THEN NOT Open WITHIN [2, 2] minutes
RULE fast WHEN Ring THEN Open WITHIN 1 minute"""


def found_in(text):
    ruleset = parse(text)
    rule = ruleset.by_label["fast"]
    found = conflict(Program(ruleset), rule)
    if found is not None:
        assert broken_so_far(ruleset, as_trace(found.timeline), "at", apart=rule) == ()
    return found


def test_a_minute_that_is_forbidden_second_by_second():
    found = found_in(FILLED)
    times = [instant.time for instant in found.instants]
    assert times == [*range(61), 120]
    assert all(instant.events == {"Knock"} for instant in found.instants[:-1])
    assert set(found.matter) == {"slow", "fast"}


@pytest.mark.parametrize(
    ("forbidden", "due", "conflicts"),
    [
        ("[2, 2] minutes", "WITHIN [1, 2] minutes", True),
        ("[2, 2] minutes", "WITHIN [1, 3] minutes", False),
        ("[1, 3] minutes", "WITHIN [2, 3] minutes", True),
        ("[1, 1] minutes", "WITHIN [2, 3] minutes", False),
        ("[1, 1] minutes", "EVENTUALLY", False),
    ],
)
def test_each_second_of_its_window_has_to_be_forbidden(forbidden, due, conflicts):
    text = FILLED.replace("[2, 2] minutes", forbidden).replace("Open WITHIN 1 minute", f"Open {due}")
    assert (found_in(text) is not None) == conflicts


CALLED = """def_start
    event Knock
    event Open
    event Close
    measure m: boolean
def_end
rule_start
    fast when Knock then Open otherwise Close within [2, 2] minutes
    slow when Knock and {m} then not Close within 2 minutes otherwise Open within 2 minutes
rule_end
relation_start
    includes Open {m}
    forbid Close {m}
relation_end
"""


def test_what_each_second_calls_for_has_a_time_of_its_own():
    """To confirm it, two minutes of seconds are continued by two minutes of seconds."""
    found = found_in(CALLED)
    assert len(found.instants) == 121
    assert found.instants[-1].time == 120


def test_it_is_told_as_one_stretch():
    found = found_in(FILLED)
    words = list(in_words(found.timeline))
    assert words == [
        "at first, and each second up to 1 minute, Knock occurs",
        "  slow forbids Open from 2 minutes to 2 minutes after the trigger",
        "after 2 minutes, Ring occurs",
        "  fast calls for Open within 1 minute",
        "and then there is no way to keep every rule",
    ]
    assert chart_of(found.timeline) == [
        "       0 s        1 min      2 min now",
        "Knock  ************",
        "Ring                         *",
        "Open                         !!!!!!!!!>",
    ]


def test_few_seconds_alike_are_told_one_by_one():
    found = found_in(FILLED.replace("minute", "second").replace("seconds", "second").replace("[2, 2]", "[4, 4]"))
    words = [line for line in in_words(found.timeline) if "Knock occurs" in line]
    assert words == ["at first, Knock occurs", "after 1 second, Knock occurs"]


@pytest.mark.parametrize(
    "text",
    [
        "WHEN A THEN B",
        "WHEN A THEN B WITHIN 2 seconds",
        "WHEN A THEN B WITHIN [2, 5] minutes\nWHEN C THEN B WITHIN 61 seconds",
        "def_start event A measure m: numeric def_end rule_start R1 when A then A within {m} minutes rule_end",
    ],
)
def test_windows_that_have_no_unit_of_several_seconds(text):
    assert shortened(parse(text)) is None


def test_a_unit_is_what_all_windows_have_a_number_of():
    shorter = shortened(
        parse(
            "def_start event A event B event C measure m: boolean measure low: boolean def_end rule_start "
            "R1 when A then B within [1, 2] minutes otherwise {C within 30 seconds unless {low}} "
            "R2 when C then not B within 90 seconds "
            "rule_end relation_start when A then {m} for 1 minutes relation_end"
        )
    )
    assert shorter is not None
    short, unit = shorter
    assert unit == 30
    first, second = Program(short).rules
    assert list(Program(short).windows(first)) == [Occurs("B", 4, 8), Occurs("C", 8, 10)]
    assert list(Program(short).windows(second)) == [Occurs("B", 0, 6, negated=True)]
    (law,) = Program(short).laws
    assert isinstance(law, Lasting)
    assert law.duration is not None
    assert law.duration.seconds == 4


def lasting(unit, *events):
    """What comes of a history with these events, each at a time: times and events."""
    history = tuple(Fixed(time, frozenset({event}), {}) for time, event in events)
    return [[(one.time, *one.events) for one in drawn] for drawn in drawn_out(history, unit)]


def test_what_is_drawn_out_keeps_the_order_of_its_seconds():
    assert lasting(5, (0, "A"), (1, "B"), (4, "C")) == [
        [(0, "A"), (1, "B"), (10, "C")],
        [(0, "A"), *((time, "B") for time in range(1, 5)), (10, "C")],
    ]
    assert lasting(5, (0, "A"), (1, "B")) == [
        [(0, "A"), (4, "B")],
        [*((time, "A") for time in range(4)), (4, "B")],
    ]


def test_no_more_than_ten_minutes_are_drawn_out():
    assert [len(drawn) for drawn in lasting(700, (0, "A"), (1, "B"))] == [2, 700]
    assert [len(drawn) for drawn in lasting(701, (0, "A"), (1, "B"), (4, "C"))] == [3]
    years = FILLED.replace("[2, 2] minutes", "[2000, 2000] days").replace("1 minute", "1000 days")
    program = Program(parse(years))
    with pytest.raises(Undecided, match="more could matter"):
        conflict(program, program.ruleset.by_label["fast"])


@pytest.mark.parametrize("seed", [25, 47, 4171, 6220])
def test_what_is_found_in_minutes_is_a_conflict(seed):
    """By a second look at each: without the rule's demand of now there is a way to go on, and with it there is none."""
    text = timed_ruleset(seed, **SIZES[seed % 3]).source.text.replace(" seconds", " minutes")
    ruleset = parse(text)
    program = Program(ruleset)
    all_found = [(rule, conflict(program, rule)) for rule in ruleset.rules]
    for rule, found in all_found:
        if found is not None:
            assert broken_so_far(ruleset, as_trace(found.timeline), "at", apart=rule) == ()
            assert after(program, found.instants, rule).ask()
            assert not after(program, found.instants).ask()
    assert any(found is not None for _, found in all_found)
