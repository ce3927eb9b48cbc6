"""What is taken on trust to come about: not where it is forbidden, nor where what is bound to follow it is."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.histories import after
from sleec_verify.timed.instant import Fixed
from sleec_verify.timed.program import Program
from sleec_verify.timed.questions import breaking, coming_about, triggering
from sleec_verify.timed.responses import Occurs
from sleec_verify.timed.windows import allows, inside
from tests.timed_agreement import SIZES, answered
from tests.timed_strategies import timed_ruleset

EACH = {
    "always the same": "WITHIN 5 seconds",
    "by what is the case": "WITHIN 5 seconds UNLESS m IN WHICH CASE E{next} WITHIN 2 TO 3 seconds",
    "with something else": "WITHIN 5 seconds AND Other",
}


def chain(length, each, seconds):
    rules = [f"RULE r{k} WHEN E{k} THEN E{k + 1} {each.replace('{next}', str(k + 1))}\n" for k in range(length)]
    return Program(parse("".join(rules) + f"RULE x WHEN X THEN NOT E{length} WITHIN {seconds} seconds\n"))


@pytest.mark.parametrize("each", EACH.values(), ids=EACH.keys())
@pytest.mark.parametrize("length", [1, 2, 3, 4, 30])
def test_a_chain_is_stuck_exactly_where_its_last_link_is_forbidden(length, each):
    """Each link may come at any of six seconds, so that there are many ways to try, of which none does."""
    history = (Fixed(0, frozenset({"X"}), {}), Fixed(30, frozenset({"E0"}), {}, complete=False))
    stuck = after(chain(length, each, 30 + 5 * length), history)
    assert not stuck.ask()
    assert len(stuck.instants) == 2
    if length < 5:
        assert after(chain(length, each, 30 + 5 * length - 1), history).ask()


@pytest.mark.parametrize("each", EACH.values(), ids=EACH.keys())
def test_a_conflict_at_the_end_of_a_long_chain_is_found(each):
    program = chain(30, each, 600)
    for rule in program.rules:
        history = conflict(program, rule)
        assert history is not None
        assert len(history.instants) == 1


@pytest.mark.parametrize("seed", [2413, 4772])
def test_rules_that_are_left_out_bind_to_nothing(seed):
    """As they are while a minimal set of rules is looked for; to be told so again and again came to no end."""
    program = Program(timed_ruleset(seed, **SIZES[seed % 3]), ("at", "eventually")[seed % 7 == 0])
    for rule in program.rules:
        for question in (breaking, triggering, conflict):
            answered(lambda: question(program, rule))  # noqa: B023
    for claim in program.claims:
        answered(lambda: coming_about(program, claim))  # noqa: B023


def test_a_rule_that_may_call_for_nothing_is_not_bound_to():
    text = """WHEN A THEN B WITHIN 5 seconds
    WHEN B AND m THEN C WITHIN 5 seconds
    WHEN B THEN D WITHIN 5 seconds UNLESS m
    WHEN B THEN E WITHIN 5 seconds OTHERWISE F WITHIN 5 seconds
    WHEN B THEN NOT G WITHIN 5 seconds
    WHEN B THEN H EVENTUALLY
    WHEN H THEN B"""
    program = Program(parse(text))
    # What comes back goes round once.
    assert [(one.what, len(one.labels)) for one in program.bound_to_follow("A")] == [
        (Occurs("B", 0, 5), 1),
        (Occurs("H", 0, None), 2),
        (Occurs("B", 0, None), 3),
    ]


@pytest.mark.parametrize("window", [(0, 0), (0, 3), (2, 3), (2, None), (None, 3), (None, None)])
@pytest.mark.parametrize("other", [(0, 0), (0, 4), (1, 4), (1, None), (None, 4), (None, None)])
def test_a_window_is_inside_another_one_where_all_its_seconds_are(window, other):
    start, end = window
    # A second further away than any bound stands for all that are.
    seconds = range(-20 if start is None else start, (20 if end is None else end) + 1)
    for later in range(-10, 11):
        all_are = all(Occurs("E", *other).covers(later + second) for second in seconds)
        assert allows(inside(Occurs("E", *window), Occurs("E", *other)), later) == all_are
