"""The test of rules with time shares no decision with the robot under test: it finds mutants of the runtime itself."""

from __future__ import annotations

from typing import Any

import pytest

from sleec_runtime import Sleec
from sleec_runtime.language import parse
from sleec_runtime.model import READINGS, Reading, Ruleset
from sleec_verify.conformance import Nonconformance, check_conformance
from tests.support.source_mutants import SourceMutant

CHAINS = "sleec_runtime.evaluation.hedge_chain"
CHAINED = """
RULE walk WHEN Morning THEN OfferWalk WITHIN 2 TO 6 seconds
UNLESS Raining IN WHICH CASE OfferGame WITHIN 5 seconds
UNLESS Tired IN WHICH CASE OfferMusic
RULE nested WHEN Bell AND NOT Mute THEN (Open WITHIN 1 second UNLESS Dark IN WHICH CASE Light WITHIN 2 seconds)
UNLESS Away IN WHICH CASE (Note UNLESS Dark IN WHICH CASE Alarm)
"""
WITH_ALTERNATIVES = """
RULE ask WHEN Ask AND NOT Mute THEN Answer WITHIN 3 seconds OTHERWISE (
    Sorry WITHIN 2 seconds OTHERWISE Shout
    UNLESS Alone IN WHICH CASE Sing UNLESS Late IN WHICH CASE Hush)
RULE rest WHEN UserSleeps THEN NOT Vacuum WITHIN 4 seconds
RULE dust WHEN DustSeen THEN Vacuum
RULE either WHEN Choice THEN Left WITHIN 2 seconds ELSE Right WITHIN 4 seconds
RULE later WHEN Morning THEN OfferWalk WITHIN 2 TO 6 seconds
"""

OF_CHAINS = [
    SourceMutant(
        CHAINS, "_candidates", "if held is False:\n                break", "if held is False:\n                continue"
    ),
    SourceMutant(CHAINS, "_candidates", 'reading == "cascade"', 'reading == "priority"'),
    SourceMutant(CHAINS, "_candidates", "last = hedge", "last = hedge if last is holder else last"),
    SourceMutant(CHAINS, "_candidates", "for hedge in hedges:", "for hedge in list(hedges)[1:]:"),
    SourceMutant(CHAINS, "_candidates", "for hedge in hedges:", "for hedge in list(hedges)[:-1]:"),
    SourceMutant(CHAINS, "_candidates", "reversed(list(hedges))", "list(hedges)"),
    SourceMutant(CHAINS, "_candidates", "reversed(list(hedges))", "reversed(list(hedges)[1:])"),
    SourceMutant(CHAINS, "_candidates", "if held:", "if held is None:"),
    SourceMutant(CHAINS, "_settle", "if not clause.hedges:", "if True:"),
    SourceMutant(CHAINS, "walk", "if guard is False:", "if guard is True:"),
]
TASKS = "sleec_runtime.timed.response_tasks"
OF_TASKS = [
    SourceMutant(TASKS, "_task", "first = due + start", "first = due + start + 1"),
    SourceMutant(TASKS, "_task", "first = due + start", "first = due"),
    SourceMutant(TASKS, "_task", "due + end, end == start", "due + end + 1, end == start"),
    SourceMutant(TASKS, "_task", "due + end, end == start", "due + end - 1, end == start"),
    SourceMutant(TASKS, "_task", "over = due if last is None else last", "over = due"),
    SourceMutant(TASKS, "_task", "if timing is not None and timing.otherwise is not None:", "if False:"),
    SourceMutant(TASKS, "_task", "if timing is not None and timing.instead is not None:", "if False:"),
    SourceMutant(
        TASKS, "_active", "outcome = decide_chain(clause,", "outcome = decide_chain(Clause(None, clause.obligations),"
    ),
    SourceMutant(
        TASKS,
        "_task",
        "tasks_of(_active(timing.otherwise, origin), over,",
        "tasks_of(_active(timing.otherwise, origin), over + 1,",
    ),
    SourceMutant(
        TASKS, "_task", "first, last, at_once = due, None, True", "first, last, at_once = due + 1, None, True"
    ),
]


def try_out(text: str, *readings: Reading) -> None:
    for reading in readings:
        _try_out(parse(text).read_as(reading))


def _try_out(rules: Ruleset) -> None:
    def make(clock: Any) -> Sleec:
        sleec = Sleec(rules, clock=clock, on_error=lambda failure: None)
        for name in sorted(rules.obligations):
            sleec.implement({name: lambda: None})
        return sleec

    check_conformance(make, rules, parts=["each-rule"])


@pytest.mark.parametrize("text", [CHAINED, WITH_ALTERNATIVES])
def test_the_unchanged_runtime_passes(text: str) -> None:
    try_out(text, *READINGS)


@pytest.mark.parametrize("mutant", OF_CHAINS, ids=str)
def test_a_mutant_of_chains_is_found(mutant: SourceMutant, monkeypatch: pytest.MonkeyPatch) -> None:
    mutant.apply(monkeypatch)
    with pytest.raises(Nonconformance):
        try_out(CHAINED, *READINGS)


@pytest.mark.parametrize("mutant", OF_TASKS, ids=str)
def test_a_mutant_of_windows_and_alternatives_is_found(mutant: SourceMutant, monkeypatch: pytest.MonkeyPatch) -> None:
    mutant.apply(monkeypatch)
    with pytest.raises(Nonconformance):
        try_out(WITH_ALTERNATIVES, *READINGS)
