"""Traces of one ruleset that answer the questions about a similar one."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.traces import replay_found
from sleec_verify.results.found_trace import FoundTrace
from sleec_verify.traces.known_traces import KnownTraces, using

RULES = """RULE a
WHEN it rings THEN open the door WITHIN 2 minutes
RULE b
WHEN it rings AND it is late THEN close the window WITHIN 5 minutes
"""
REDUNDANT = f"{RULES}RULE c\nWHEN it rings THEN close the window WITHIN 4 minutes\n"
IMPOSSIBLE = f"{RULES}RULE c\nWHEN it rings THEN NOT open the door WITHIN 9 minutes\n"
NAMES = ("redundant-rule", "vacuous-conflict")


class _Counting:
    def __init__(self) -> None:
        self.confirmed = self.refused = 0

    def __call__(self, ruleset: Ruleset, untimed: Untimed, found: FoundTrace) -> bool:
        shown = replay_found(RulesetIndex(ruleset, untimed=untimed), found)
        self.confirmed += shown
        self.refused += not shown
        return shown


@pytest.mark.parametrize("changed", [REDUNDANT, IMPOSSIBLE, RULES.replace("5", "3")])
def test_the_verdicts_are_those_without_known_traces(changed: str) -> None:
    counting = _Counting()
    known = KnownTraces(counting)
    with using(known):
        run_checks(parse(RULES), NAMES)
        assert counting.confirmed == counting.refused == 0
        found = run_checks(parse(changed), NAMES)
    expected = run_checks(parse(changed), NAMES)
    assert [one.verdict for one in found] == [one.verdict for one in expected]
    assert counting.confirmed
    assert bool(counting.refused) == (changed in (REDUNDANT, IMPOSSIBLE))
