"""The picture of a mission."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from random import Random
from xml.etree.ElementTree import Element, fromstring

import pytest

from sleec_runtime.model import Rational
from sleec_verify.report.mission_plot import grouping, plot
from sleec_verify.report.mission_plot.time_scale import TimeScale
from sleec_verify.results.mission_timeline import Change, DeviationMark, DueWindow, MissionTimeline, Occurrence

SVG = "{http://www.w3.org/2000/svg}"


def drawn(timeline: MissionTimeline) -> Element:
    return fromstring(plot(timeline).encode())


def texts(picture: Element) -> list[str]:
    return [text.text or "" for text in picture.iter(f"{SVG}text")]


def kinds(picture: Element) -> dict[str, int]:
    """How often each class of shapes is drawn, without the legend."""
    found: dict[str, int] = {}
    in_legend = {
        id(shape) for group in picture.iter(f"{SVG}g") if group.findtext(f"{SVG}title") == "Legend" for shape in group
    }
    for shape in picture.iter():
        if id(shape) not in in_legend:
            for kind in shape.get("class", "").split():
                found[kind] = found.get(kind, 0) + 1
    return found


def small_mission() -> MissionTimeline:
    return MissionTimeline(
        "log.mcap",
        0,
        90,
        domains=[Change(0, "household", None)],
        triggers=[Occurrence(12, "CurtainOpenRequest"), Occurrence(40, "CurtainOpenRequest")],
        changes=[Change(5, "UserUndressed", True), Change(35, "UserUndressed", False), Change(50, "Age", 15)],
        executions=[Occurrence(13, "RefuseRequest")],
        windows=[
            DueWindow("RefuseRequest", "a requires RefuseRequest", "met", 12, 13),
            DueWindow("ExplainWhy", "a requires ExplainWhy", "missed", 12, 17),
            DueWindow("Call", "a requires Call", "open", 70, None),
            DueWindow("OpenCurtains", "a prohibits OpenCurtains", "prohibited", 12, 40),
        ],
        deviations=[DeviationMark(17, "ExplainWhy has not been executed", True), DeviationMark(90, "Call", False)],
    )


def test_each_fact_has_a_shape_of_its_own() -> None:
    picture = drawn(small_mission())
    found = kinds(picture)
    assert (found["trigger"], found["execution"], found["true"], found["false"], found["value"]) == (2, 1, 1, 1, 2)
    # Not only the colour differs: the pattern, the dashes, a cross and a question mark.
    assert (found["met"], found["missed"], found["open"], found["prohibited"]) == (1, 3, 1, 1)
    assert "?" in texts(picture)
    assert found["breach"] == 2  # in the picture, and in the list
    assert found["doubt"] == 2


def test_a_screen_reader_gets_the_same_in_words() -> None:
    picture = drawn(small_mission())
    assert picture.get("role") == "img"
    labels = {element.get("id"): element.text or "" for element in picture if element.get("id")}
    assert picture.get("aria-labelledby", "").split() == list(labels)
    assert labels["mission-title"] == "Timeline of log.mcap"
    assert "2 triggers" in labels["mission-desc"]
    assert "1 broken rule" in labels["mission-desc"]
    titles = {title.text for title in picture.iter(f"{SVG}title")}
    assert "a requires ExplainWhy: missed, from 12 s to 17 s" in titles
    assert "UserUndressed true from 5 s" in titles
    assert "1: ExplainWhy has not been executed" in titles


def test_a_picture_needs_nothing_else_and_is_inside_its_page() -> None:
    text = plot(small_mission())
    assert "href" not in text
    assert "<script" not in text
    picture = fromstring(text.encode())
    _, _, width, height = map(float, picture.get("viewBox", "").split())
    for shape in picture.iter():
        assert 0 <= float(shape.get("x", 0)) <= width
        assert 0 <= float(shape.get("y", 0)) <= height


def test_many_events_are_drawn_as_few_marks() -> None:
    chance = Random(1)
    times = sorted(Fraction(chance.randrange(10**7), 1000) for _ in range(5_000))
    windows = [DueWindow("Stop", "a requires Stop", chance.choice(["met", "missed"]), at, at + 1) for at in times]
    mission = MissionTimeline(
        "log",
        0,
        10**4,
        triggers=[Occurrence(at, "Call") for at in times],
        changes=[Change(at, name, value) for at in times for name, value in (("a", at % 2 < 1), ("b", at % 7))],
        executions=[Occurrence(at, "Stop") for at in times],
        windows=windows,
        deviations=[DeviationMark(at, "missed", True) for at in times[::7]],
    )
    text = plot(mission)
    assert len(text) < 300_000
    picture = fromstring(text.encode())
    found = kinds(picture)
    assert found["trigger"] < 50
    assert found["execution"] < 50
    assert found["met"] < 1000
    assert found["breach"] < 200
    assert "×" in "".join(texts(picture))
    assert any("drawn as one" in text for text in texts(picture))
    assert any("more deviations" in text for text in texts(picture))


def test_many_names_are_cut_with_a_note() -> None:
    mission = MissionTimeline("log", 0, 9, triggers=[Occurrence(1, f"Event{n}") for n in range(100)])
    picture = drawn(mission)
    assert kinds(picture)["trigger"] == 40
    assert "… and 60 more, which are not shown" in texts(picture)


@pytest.mark.parametrize("end", [0, Fraction(1, 10**6), 10**7])
def test_missions_of_any_length(end: Rational) -> None:
    start = 1_700_000_000
    mission = small_mission()
    mission.start, mission.end, mission.cut = start, start + end, start + end
    mission.triggers = [Occurrence(start + end, "Call")]
    found = texts(drawn(mission))
    assert any("2023-11-14 22:13:20 UTC" in text for text in found)
    assert any("the picture ends at" in text for text in found)
    assert plot(MissionTimeline("empty"))


def test_names_cannot_change_the_picture() -> None:
    name = "<script>&\x1b[0m\x00\ud800\u202e" + "x" * 99
    mission = MissionTimeline(name, 0, 9, triggers=[Occurrence(1, name)], changes=[Change(1, name, name)])
    mission.deviations = [DeviationMark(1, name, True)]
    text = plot(mission)
    fromstring(text.encode())
    assert "<script" not in text
    assert "\x1b" not in text
    assert "\u202e" not in text


@pytest.mark.parametrize(
    ("seconds", "labels"),
    [
        (Fraction(1, 10), ["0 s", "0.01 s", "0.02 s"]),
        (9, ["0 s", "1 s", "2 s"]),
        (600, ["0:00 min", "1:00 min", "2:00 min"]),
        (86_400, ["0:00:00 h", "3:00:00 h", "6:00:00 h"]),
        (10**7, ["0:00:00 h", "264:00:00 h", "528:00:00 h"]),
    ],
)
def test_the_axis_has_usual_times(seconds: Rational, labels: list[str]) -> None:
    ticks = list(TimeScale(5, 5 + seconds, 0, 1000).ticks())
    assert [label for _, label in ticks][:3] == labels
    assert all(right - left >= 90 for (left, _), (right, _) in pairwise(ticks))


@pytest.mark.parametrize("digits", range(-3, 13))
def test_long_labels_of_the_axis_do_not_overlap(digits: int) -> None:
    for seconds in (Fraction(10) ** digits, 3 * Fraction(10) ** digits):
        ticks = list(TimeScale(5, 5 + seconds, 0, 920).ticks())
        assert all(right - left >= 6 * len(label) + 12 for (left, _), (right, label) in pairwise(ticks))


@pytest.mark.parametrize("name", ["n" * 300, "\x00" * 300, "\ud800" * 300, "\u202e\x1b[31m" * 60])
def test_long_names_end_where_the_picture_begins(name: str) -> None:
    picture = drawn(MissionTimeline("log", 0, 90, triggers=[Occurrence(5, name)]))
    (label,) = (text for text in texts(picture) if text.endswith("…"))
    assert len(label) == 34
    axis = min(float(line.get("x1", "")) for line in picture.iter() if line.get("class") == "grid")
    assert 28 + 7.5 * len(label) <= axis, "a name in CamelCase takes 7.5 pixels for each character"


def test_bars_in_one_lane_do_not_overlap() -> None:
    chance = Random(2)
    intervals = [(left := chance.random() * 90, left + chance.random() * 9, None) for _ in range(50)]
    groups = [grouping.Group(left, right, [None]) for left, right, _ in sorted(intervals)]
    chosen = grouping.lanes(groups, 99)
    for number, (lane, group) in enumerate(zip(chosen, groups)):
        assert all(one.right < group.left for other, one in zip(chosen[:number], groups) if other == lane)
    assert max(grouping.lanes(groups, 3)) == 2
    joined = grouping.bars(intervals, 0)
    assert all(one.right <= other.left for one, other in pairwise(joined))
    assert sum(len(group.members) for group in joined) == 50
