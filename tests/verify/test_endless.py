"""Events that can never occur: what they call for never comes to an end, or to something that cannot be."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.solver import Undecided
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.endless import endless
from sleec_verify.timed.program import Program
from sleec_verify.timed.unfolding import Unfolding
from tests.timed_agreement import SIZES
from tests.timed_strategies import timed_ruleset

CASES = {
    "each calls for the other, later": (
        "WHEN A THEN B WITHIN [1, 2] seconds\nWHEN B THEN A WITHIN [1, 2] seconds",
        "AB",
    ),
    "or at once": ("WHEN A THEN B WITHIN 2 seconds\nWHEN B THEN A WITHIN 2 seconds", ""),
    "or not, as measures are": (
        "CONDITION m\nWHEN A THEN B WITHIN [1, 2] seconds\nWHEN B AND m THEN A WITHIN [1, 2] seconds",
        "",
    ),
    "it forbids itself": ("WHEN A THEN NOT A", "A"),
    "what it calls for forbids itself": (
        "WHEN A THEN B EVENTUALLY\nWHEN B THEN C WITHIN 1 day\nWHEN C THEN NOT C",
        "ABC",
    ),
    "or may be left out": ("WHEN A THEN B OTHERWISE C\nWHEN B THEN NOT B", "B"),
    "a law forbids what it calls for": (
        "EVENT A, B, C\nNEVER C\nWHEN A THEN B EVENTUALLY\nWHEN B THEN C EVENTUALLY",
        "ABC",
    ),
}


@pytest.mark.parametrize(("text", "expected"), CASES.values(), ids=CASES.keys())
def test_what_can_never_occur(text, expected):
    assert endless(Program(parse(text))) == frozenset(expected)


def test_what_cannot_be_moves_to_no_other_instant():
    """B could be taken to come at each instant that is added for C."""
    program = Program(
        parse("RULE r WHEN A THEN B\nWHEN B THEN C\nWHEN B THEN C WITHIN 2 minutes\nWHEN C THEN NOT C"), "eventually"
    )
    found = conflict(program, program.ruleset.by_label["r"])
    assert found is not None
    assert [instant.events for instant in found.instants] == [{"A"}]


def occurs(program, event):
    unfolding = Unfolding(program, most=2)
    only = unfolding.instant(unfolding.formula.true)
    try:
        return unfolding.ask(unfolding.instants[only].event(event))
    except Undecided:
        return None


@pytest.mark.parametrize("first", range(0, 200, 100))
def test_no_trace_has_what_can_never_occur(first):
    found = 0
    for seed in range(first, first + 100):
        program = Program(timed_ruleset(seed, **SIZES[seed % 3]))
        for event in sorted(endless(program)):
            found += 1
            assert not occurs(program, event), f"{event}\n{program.ruleset.source.text}"
    assert found > 5


CIRCLES = ["witness C B", "equal C B", "causation B {m}\nincludes C {m}"]


@pytest.mark.parametrize("window", ["eventually", "within 3 seconds", "within [1, 2] hours"])
@pytest.mark.parametrize("laws", CIRCLES)
def test_what_comes_back_to_itself_by_a_law_never_ends(laws, window):
    """B calls for C a second later, and with C comes B again: so A, which calls for B, has no way to go on."""
    text = f"""def_start event A event B event C measure m: boolean def_end
        rule_start
            later when B then C within [1, 1] seconds
            r when A then B {window}
        rule_end
        relation_start {laws} relation_end"""
    program = Program(parse(text))
    assert conflict(program, program.ruleset.by_label["r"]) is not None
