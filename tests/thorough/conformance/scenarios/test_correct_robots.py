"""The suite for rules with time passes robots that are correct: plain callables, and random robots."""

from __future__ import annotations

from random import Random

import contextpy3
import pytest

import sleec_runtime
from sleec_runtime import Sleec
from sleec_runtime.language import parse
from sleec_verify.conformance import check_conformance
from sleec_verify.conformance.scenarios.course import Course, Happening
from sleec_verify.conformance.scenarios.judgement import Judge
from sleec_verify.conformance.scenarios.player import WithheldCompletion
from tests.support.timed_robot_sources import LOAD, NOTE, random_rules, robot_source

BOTH = "RULE r WHEN T THEN (A WITHIN 2 seconds AND B WITHIN 3 seconds)"
RULES = (
    BOTH,
    "RULE r WHEN T THEN (A AND B WITHIN 3 seconds)",
    "RULE r WHEN T THEN (A WITHIN 3 seconds OTHERWISE NOT P WITHIN 2 seconds) AND B WITHIN 2 seconds",
    "RULE r WHEN T THEN (A WITHIN 1 TO 2 seconds AND B WITHIN 1 TO 3 seconds)",
    "RULE r WHEN T THEN (B WITHIN 1 TO 4 seconds ELSE A WITHIN 4 seconds)",
    "RULE r WHEN T THEN (B WITHIN 1 TO 3 seconds ELSE A)",
    "RULE r0 WHEN U THEN (A ELSE (A WITHIN 4 seconds UNLESS d IN WHICH CASE NOT Q WITHIN 2 seconds))",
)


@pytest.mark.parametrize("part", ["each-rule", "scenarios"])
@pytest.mark.parametrize("text", RULES)
def test_plain_callables_pass(text: str, part: str) -> None:
    rules = parse(text)

    def make(clock) -> Sleec:
        sleec = Sleec(rules, clock=clock)
        sleec.implement({name: lambda: None for name in rules.obligations})
        return sleec

    check_conformance(make, parts=[part], examples=30)


def test_an_exception_excuses_only_what_it_stopped() -> None:
    """A stops B at the second T; nothing stopped it at the first."""
    judge = Judge(parse(BOTH))
    first = (Happening(0, "occurs", ("T",), 1), Happening(0, "starts", ("A",), 1), Happening(0, "done", ("A",), 1))
    stopped = Happening(9, "fails", ("A",), 2, WithheldCompletion("A"))
    second = (Happening(9, "occurs", ("T",), 2), Happening(9, "starts", ("A",), 2), stopped)
    fault = judge.fault(Course((*first, *second), {}, 20))
    assert fault is not None
    assert (fault.kind, fault.names, fault.at) == ("missing", ("B",), 3)
    with_b = (Happening(0, "starts", ("B",), 1), Happening(0, "done", ("B",), 1))
    assert judge.fault(Course((*first, *with_b, *second), {}, 20)) is None


def test_otherwise_is_due_if_the_clock_comes_before_a_completion() -> None:
    """The window of A closes at 4. The clock of `r1` starts A then, but `r0` already waits to start B."""
    judge = Judge(
        parse(
            "RULE r0 WHEN T THEN A WITHIN 4 seconds OTHERWISE B WITHIN 1 TO 4 seconds\n"
            "RULE r1 WHEN T THEN A WITHIN 4 seconds OTHERWISE A WITHIN 4 seconds"
        )
    )
    start = Happening(0, "starts", ("A",), 1)
    begin = (Happening(0, "occurs", ("T",), 1), start, start)
    done = Happening(4, "done", ("A",), 3)
    end = (Happening(5, "starts", ("B",), 4), Happening(5, "done", ("B",), 4))
    after = (*begin, Happening(4, "starts", ("A",), 2), done, *end)
    assert judge.fault(Course(after, {}, 20, frozenset("A"))) is None
    fault = judge.fault(Course((*begin, done, *end), {}, 20, frozenset("A")))
    assert fault is not None
    assert (fault.kind, fault.names, fault.at) == ("not required", ("B",), 5)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [47, 80, 132])
def test_random_robots_pass(seed: int) -> None:
    random = Random(seed)
    rules = parse(random_rules(random))
    source = robot_source(rules, random).replace(LOAD, "").replace(NOTE, "")

    def make(clock) -> Sleec:
        sleec = Sleec(rules, clock=clock)
        names = {"sleec": sleec, "note": lambda name: None, "sleec_runtime": sleec_runtime, "cop": contextpy3}
        exec(source, names)
        names["Robot"]()
        return sleec

    check_conformance(make, parts=["each-rule", "scenarios"], examples=10)
