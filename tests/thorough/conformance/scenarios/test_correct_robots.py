"""The suite passes robots that are correct: plain callables under rules with time."""

from __future__ import annotations

import pytest

from sleec_runtime import Sleec
from sleec_runtime.language import parse
from sleec_verify.conformance import check_conformance
from sleec_verify.conformance.scenarios.course import Course, Happening
from sleec_verify.conformance.scenarios.judgement import Judge
from sleec_verify.conformance.scenarios.player import WithheldCompletion

BOTH = "RULE r WHEN T THEN (A WITHIN 2 seconds AND B WITHIN 3 seconds)"
RULES = (
    BOTH,
    "RULE r WHEN T THEN (A AND B WITHIN 3 seconds)",
    "RULE r WHEN T THEN (A WITHIN 3 seconds OTHERWISE NOT P WITHIN 2 seconds) AND B WITHIN 2 seconds",
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
