"""Metamorphic properties of audits: splitting, shifting, and irrelevant observations change nothing."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import replace
from random import Random
from typing import Any

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.observation import Observation
from sleec_runtime.audit.state import restore, save
from sleec_runtime.errors import SnapshotRefused
from sleec_runtime.language import parse
from sleec_runtime.model import Rational
from tests.support.missions import AFTERWARDS, audit, declared, observations
from tests.support.random_traces import Case, random_cases


def cases(seed: int, number: int) -> Iterable[tuple[Case, Auditor, list[Observation]]]:
    for case in random_cases(seed, number):
        ruleset = declared(case.ruleset)
        for trace in case.traces:
            auditor = Auditor(ruleset, tolerance=Random(seed).choice((0, 1)), untimed=case.untimed)
            yield case, auditor, list(observations(trace, Random(0)))


def again(auditor: Auditor) -> Auditor:
    return Auditor(auditor.ruleset, tolerance=auditor.tolerance, untimed=auditor.untimed)


@pytest.mark.parametrize("seed", range(3))
def test_an_audit_that_resumes_finds_the_same(seed: int) -> None:
    for _, whole, mission in cases(seed, 60):
        expected = audit(whole, mission)
        split = again(whole)
        found: list[Deviation] = []
        for observation in mission:
            split = restore(split.ruleset, json.loads(json.dumps(save(split))))
            found += split.observe(observation)
        split = restore(split.ruleset, json.loads(json.dumps(save(split))))
        found += split.finish(AFTERWARDS)
        assert found == expected
        assert save(split) == save(whole)


@pytest.mark.parametrize("seed", range(3))
def test_shifting_the_time_changes_only_the_times(seed: int) -> None:
    def shifted(deviation: Deviation, by: Rational) -> Deviation:
        triggered = deviation.triggered
        return replace(
            deviation,
            time=deviation.time + by,
            first=None if deviation.first is None else deviation.first + by,
            last=None if deviation.last is None else deviation.last + by,
            triggered=None if triggered is None else replace(triggered, time=triggered.time + by),
        )

    for _, auditor, mission in cases(seed + 10, 60):
        later = [replace(one, time=one.time + 1000) for one in mission]
        found = [shifted(one, -1000) for one in audit(again(auditor), later, AFTERWARDS + 1000)]
        assert found == audit(auditor, mission)


def test_a_state_of_other_rules_is_refused() -> None:
    auditor = Auditor(parse("RULE a WHEN A THEN X"))
    state = save(auditor)
    with pytest.raises(SnapshotRefused, match="other rules"):
        restore(parse("RULE a WHEN A THEN Y"), state)
    with pytest.raises(SnapshotRefused, match="another version"):
        restore(auditor.ruleset, {**state, "format": 1})
    malformed: tuple[Any, ...] = (None, [], {}, {**state, "moment": 1}, {**state, "duties": [{"rule": "b"}]})
    for broken in malformed:
        with pytest.raises(SnapshotRefused, match="malformed"):
            restore(auditor.ruleset, broken)
