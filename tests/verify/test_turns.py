"""Conflicts in which what a rule calls for is kept off by one instant after the other, triggered long ago."""

from __future__ import annotations

from itertools import pairwise

import pytest

from sleec_runtime.language import parse
from sleec_runtime.trace import broken_so_far
from sleec_verify.report.timeline import chart_of, in_words
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.histories import after
from sleec_verify.timed.program import Program
from sleec_verify.timed.replay import as_trace
from sleec_verify.timed.timeline import Moment, Timeline
from sleec_verify.timed.turns import turns

MISSED = """RULE missed WHEN Ring THEN Open WITHIN 10 minutes OTHERWISE NOT Open WITHIN 2 seconds
RULE asked WHEN Knock THEN Open WITHIN 15 seconds"""


def sets(text, most=64):
    program = Program(parse(text))
    return list(turns(program, program.ruleset.by_label["asked"], most))


def test_a_door_that_is_shut_for_two_seconds_at_a_time():
    program = Program(parse(MISSED))
    rule = program.ruleset.by_label["asked"]
    found = conflict(program, rule)
    assert found is not None
    ago = [found.instants[-1].time - instant.time for instant in found.instants]
    assert len(ago) >= 8
    assert ago[0] >= 600
    assert all(0 < one - other <= 2 for one, other in pairwise(ago[:-1]))
    assert broken_so_far(program.ruleset, as_trace(found.timeline), "at", apart=rule) == ()
    assert after(program, found.instants, rule).ask()
    assert not after(program, found.instants).ask()


def test_what_comes_every_two_seconds_is_told_once():
    ruleset = parse(MISSED)
    found = conflict(Program(ruleset), ruleset.by_label["asked"])
    assert found is not None
    told = list(in_words(found.timeline))
    assert told[0] == "at first, and every 2 seconds up to 14 seconds, Ring occurs"
    assert told[2] == (
        "after 10 minutes, and every 2 seconds up to 10 minutes 14 seconds, in place of Open, "
        "missed forbids Open within 2 seconds"
    )
    heads = [head.strip() for head in chart_of(found.timeline)[0].split("  ") if head.strip()]
    assert heads == ["0 s", "14 s", "10 min", "10 min 1 s now", "10 min 14 s"]


@pytest.mark.parametrize(
    ("times", "told"),
    [
        # One that came before the others is no part of them.
        ((0, 5, 6, 7, 8), ["at first", "after 5 seconds, and each second up to 8 seconds"]),
        (
            (0, 2, 4, 6, 7, 8, 9),
            ["at first, and every 2 seconds up to 6 seconds", "after 7 seconds", "after 8 seconds"],
        ),
        ((0, 2, 4, 9), ["at first", "after 2 seconds", "after 4 seconds", "after 9 seconds"]),
    ],
)
def test_moments_alike_are_together_where_they_are_as_far_from_each_other(times, told):
    moments = tuple(Moment(time, ("Ring",), {}, (), ()) for time in times)
    words = list(in_words(Timeline(moments, None)))
    assert [line.removesuffix(", Ring occurs") for line in words][: len(told)] == told


@pytest.mark.parametrize(
    ("old", "new"),
    [("NOT Open", "NOT Close"), ("15 seconds", "15 seconds OTHERWISE Call"), ("WHEN Ring", "WHEN Knock")],
)
def test_a_door_that_opens_between(old, new):
    program = Program(parse(MISSED.replace(old, new)))
    assert conflict(program, program.ruleset.by_label["asked"]) is None


def test_only_the_seconds_that_matter_are_looked_at():
    by_length, each = sets(MISSED)
    assert each == list(range(602, 584, -1))
    assert by_length == [602, 601, 599, 597, 595, 593, 591, 589, 587, 585, 1]
    assert not sets(MISSED, most=5)
    # A long one needs no other one after it.
    (long,) = sets("RULE shut WHEN Shut THEN NOT Open WITHIN 1 hour\nRULE asked WHEN Knock THEN Open WITHIN 1 minute")
    assert long == [3600, 1]
    assert not sets("RULE asked WHEN Knock THEN Open WITHIN 1 minute")
    assert not sets("RULE shut WHEN Shut THEN NOT Open EVENTUALLY\nRULE asked WHEN Knock THEN Open WITHIN 1 minute")


def test_what_could_be_done_instead_is_kept_off_as_well():
    (ago,) = sets(
        """RULE shut WHEN Shut THEN Call WITHIN 1 day OTHERWISE NOT Open WITHIN 30 seconds
RULE hush WHEN Hush THEN NOT Call WITHIN 2 hours
RULE late WHEN Late THEN Hush WITHIN 3 days
RULE asked WHEN Knock THEN Open WITHIN 10 minutes"""
    )
    day = 24 * 60 * 60
    assert ago[-5:] == [day - 600 + 60, day - 600 + 30, day - 600, 7200, 1]
    assert ago[0] == 3 * day
