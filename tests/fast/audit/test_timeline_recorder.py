"""The timeline of a mission that is audited."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, Reported
from sleec_runtime.language import parse
from sleec_verify.audit import timeline_recorder
from sleec_verify.audit.timeline_recorder import TimelineRecorder
from sleec_verify.results.mission_timeline import Change, DeviationMark, MissionTimeline, Occurrence

RULES = """
RULE call
WHEN Fall THEN Call WITHIN 60 seconds OTHERWISE Alarm WITHIN 30 seconds
UNLESS Quiet IN WHICH CASE NOT Call WITHIN 10 seconds
RULE help
WHEN Fall THEN Help
"""


def record(mission: Sequence[Observation], end: int | None = None, rules: str = RULES) -> MissionTimeline:
    auditor = Auditor(parse(rules), tolerance=1)
    recorder = TimelineRecorder("log", auditor)
    for observation in mission:
        recorder.observe(observation)
        for deviation in auditor.observe(observation):
            recorder.deviate(deviation)
    for deviation in auditor.finish(end):
        recorder.deviate(deviation)
    return recorder.finish()


def windows(timeline: MissionTimeline) -> list[tuple[object, ...]]:
    return [(window.name, window.state, window.first, window.last) for window in timeline.windows]


MISSION: list[Observation] = [
    Entered(5, "home"),
    Reported(5, {"Quiet": False, "Age": 8}),
    Reported(6, {"Quiet": False, "Age": 9}),
    Occurred(10, "Fall"),
    Executed(Fraction(21, 2), "Help"),
    Entered(19, "home"),
    Executed(20, "Call"),
]


def test_what_is_observed_and_what_is_due() -> None:
    timeline = record(MISSION)
    assert (timeline.start, timeline.end) == (5, 20)
    assert timeline.domains == [Change(5, "home", None)]
    assert timeline.changes == [Change(5, "Quiet", False), Change(5, "Age", 8), Change(6, "Age", 9)]
    assert timeline.triggers == [Occurrence(10, "Fall")]
    assert timeline.executions == [Occurrence(Fraction(21, 2), "Help"), Occurrence(20, "Call")]
    # The alternative was not necessary, and Help was executed within the tolerance.
    assert windows(timeline) == [("Call", "met", 10, 70), ("Help", "met", 10, Fraction(21, 2))]
    assert [window.words for window in timeline.windows] == [
        "rule call requires Call within 60 seconds, otherwise Alarm within 30 seconds",
        "rule help requires Help",
    ]


@pytest.mark.parametrize(
    ("rest", "end", "expected"),
    [
        ((), 12, [("Call", "open", 10, 70), ("Alarm", "open", 70, 100)]),
        ((), 90, [("Call", "missed", 10, 70), ("Alarm", "open", 70, 100)]),
        ((), 200, [("Call", "missed", 10, 70), ("Alarm", "missed", 70, 100)]),
        ((Executed(80, "Alarm"),), 200, [("Call", "missed", 10, 70), ("Alarm", "met", 70, 100)]),
    ],
)
def test_windows_that_are_missed_or_open(
    rest: tuple[Observation, ...], end: int, expected: list[tuple[object, ...]]
) -> None:
    timeline = record([*MISSION[:-1], *rest], end)
    assert [window for window in windows(timeline) if window[0] != "Help"] == expected
    is_broken = expected[-1][1] == "missed"
    assert any(mark.is_breach for mark in timeline.deviations if "Alarm" in mark.words) is is_broken


def test_prohibitions_and_deviations() -> None:
    timeline = record([Reported(0, {"Quiet": True}), Occurred(10, "Fall"), Executed(15, "Call")], 30)
    assert windows(timeline) == [("Call", "prohibited", 10, 20), ("Help", "missed", 10, 10)]
    assert [mark for mark in timeline.deviations if mark.is_breach] == [
        DeviationMark(10, "`Help` has not been executed, and rule `help` requires it at this time", True),
        DeviationMark(15, "`Call` was executed, and rule `call.hc1` prohibits it since 10 s", True),
    ]


def test_what_is_out_of_order_is_shown_when_it_counts() -> None:
    timeline = record(
        [Occurred(100, "Fall"), Executed(50, "Help"), Reported(20, {"Quiet": True}), Entered(101, "home")]
    )
    assert (timeline.start, timeline.end) == (100, 101)
    assert timeline.executions == [Occurrence(100, "Help")]
    assert timeline.changes == [Change(100, "Quiet", True)]
    backwards = [mark for mark in timeline.deviations if "earlier" in mark.words]
    assert [mark.time for mark in backwards] == [100, 100]


@pytest.mark.parametrize(("length", "drawn"), [(-1, []), (0, [("B", "prohibited", 5, 5)])])
def test_a_prohibition_whose_window_has_a_negative_length_is_not_drawn(
    length: int, drawn: list[tuple[object, ...]]
) -> None:
    rules = "MEASURE wait: integer\nRULE a WHEN A THEN NOT B WITHIN wait minutes"
    assert windows(record([Reported(1, {"wait": length}), Occurred(5, "A")], 9, rules)) == drawn


def test_a_long_mission_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(timeline_recorder, "MOST", 6)
    timeline = record([one for time in range(9) for one in (Occurred(time, "Fall"), Executed(time, "Help"))])
    assert timeline.cut is not None
    assert timeline.end == timeline.cut < 8
    marks = (*timeline.triggers, *timeline.executions, *timeline.deviations)
    assert len(marks) <= 6
