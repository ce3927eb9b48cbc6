"""The saved state, and what is refused."""

from __future__ import annotations

import copy
import time
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from typing import Any

import pytest

from sleec_runtime import Sleec, VirtualClock, errors
from sleec_runtime.language import load, parse
from sleec_runtime.model import Ruleset
from sleec_runtime.timed.plain_data import DEEPEST
from tests.support.restarts import RULES, SAVED_AT, Robot, restarted

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


def test_a_snapshot_does_not_change_with_what_was_given() -> None:
    robot = Robot()
    rooms = [{"floor": [1]}]
    robot.sleec.trigger("Fall", rooms, where=rooms)
    snapshot = robot.sleec.pending_snapshot(SAVED_AT)
    other = Robot()
    other.sleec.restore(snapshot, SAVED_AT)
    rooms[0]["floor"].append(2)
    snapshot["decisions"][0]["arguments"]["args"].clear()
    other.clock.advance(300)
    assert other.log == [("CallAmbulance", [{"floor": [1]}], ("where", [{"floor": [1]}]))]


def deep() -> list[object]:
    whole: list[object] = []
    for _ in range(10_000):
        whole = [whole]
    return whole


class Text(str):
    __slots__ = ()


@pytest.mark.parametrize(
    "value",
    [
        object(),
        (1, 2),
        {1: 2},
        {"a": {2}},
        float("nan"),
        float("inf"),
        10**5_000,
        b"x",
        Text("x"),
        deep(),
        [Fraction(1)],
    ],
    ids=lambda value: type(value).__name__,
)
def test_arguments_that_are_not_plain_are_refused_where_code_may_need_them(value: object) -> None:
    robot = Robot()
    robot.sleec.trigger("Sleep", value)
    assert len(robot.saved()["pending"]) == 1, "nothing is called for a prohibition"
    for args, kwargs, name in (((0, value), {}, "argument 2"), ((), {"place": value}, "argument place")):
        robot.sleec.trigger("Fall", *args, **kwargs)
        with pytest.raises(errors.WrongType, match=f"{name} of the trigger Fall is plain data") as refusal:
            robot.sleec.pending_snapshot(SAVED_AT)
        assert "fall" in refusal.value.message
        assert len(str(refusal.value)) < 1_000
        robot.sleec.completed("CallNurse")
    assert len(robot.saved()["pending"]) == 1


def test_the_deepest_arguments_that_are_saved_are_restored() -> None:
    value: list[object] = []
    for _ in range(DEEPEST - 1):
        value = [value]
    robot, other = Robot(), Robot()
    robot.sleec.trigger("Fall", value, where=value)
    assert len(other.sleec.restore(robot.sleec.pending_snapshot(SAVED_AT), SAVED_AT)) == 1
    robot.sleec.trigger("Fall", [value])
    with pytest.raises(errors.WrongType):
        robot.sleec.pending_snapshot(SAVED_AT)


def test_rules_that_were_replaced_are_reported_as_lost() -> None:
    robot = Robot()
    robot.sleec.trigger("Fall")
    second = parse("RULE other WHEN Fall THEN CallNurse WITHIN 1 minute")
    robot.sleec.replace(second)
    robot.sleec.trigger("Fall")
    snapshot = robot.saved()
    assert snapshot["left_out"] == [{"rule": "fall", "obligation": "CallNurse"}]
    other = Robot(second.source.text)
    (one,) = other.sleec.restore(snapshot, SAVED_AT)
    assert one.rule == "other"
    assert other.failures() == [
        "CallNurse (fall): `CallNurse` was pending under rules that had been replaced, and is not restored"
    ]


def test_rules_of_another_domain_go_on() -> None:
    text = """
DOMAIN day
RULE a WHEN A THEN X WITHIN 2 TO 5 seconds
DOMAIN night
RULE b WHEN B THEN NOT Y WITHIN 9 seconds
"""
    robot = Robot(text, domain="day")
    robot.sleec.trigger("A")
    robot.sleec.enter_domain("night")
    robot.sleec.trigger("B")
    other = restarted(robot, text=text, domain="night")
    other.clock.advance(1)
    assert other.pending() == [
        "X (a): waiting, opens in 1 second, closes in 4 seconds",
        "NOT Y (b): in force, closes in 8 seconds",
    ]
    other.clock.advance(2)
    assert other.taken() == ["X"]


def test_a_snapshot_may_be_of_nothing() -> None:
    for text in (RULES, "RULE a WHEN A THEN X"):
        assert restarted(Robot(text), text=text).pending() == []


def test_rules_without_a_text_are_refused() -> None:
    sleec = Sleec(Ruleset(parse("RULE a WHEN A THEN X WITHIN 5 seconds").statements), clock=VirtualClock())
    for act in (sleec.pending_snapshot, lambda: sleec.restore({})):
        with pytest.raises(errors.SnapshotRefused):
            act()
    with pytest.raises(errors.SnapshotRefused, match="the rules were not read from a text"):
        sleec.pending_snapshot()


def test_a_snapshot_is_of_the_bytes_of_a_file(tmp_path: Any) -> None:
    path = tmp_path / "rules.sleec"
    path.write_text(RULES, encoding="utf-8")
    assert Sleec(load(path), clock=VirtualClock()).pending_snapshot(1) == Robot().sleec.pending_snapshot(1)


def test_by_default_the_time_is_that_of_the_computer() -> None:
    robot, other = Robot(), Robot()
    robot.sleec.trigger("Fall")
    snapshot = robot.sleec.pending_snapshot()
    assert abs(snapshot["saved_at"] - time.time()) < 60
    other.sleec.restore(snapshot)
    (one,) = other.sleec.pending()
    assert 390 <= float(one.until or 0) <= 400


def refused(robot: Robot, data: Any, words: str, now: Any = SAVED_AT) -> None:
    before = robot.pending()
    with pytest.raises(errors.SnapshotRefused, match=words) as refusal:
        robot.sleec.restore(data, now)
    assert refusal.value.hint
    assert len(str(refusal.value)) < 2_500
    assert robot.pending() == before
    assert robot.log == []


@pytest.fixture
def snapshot() -> Any:
    robot = Robot()
    robot.sleec.update({"Awake": True, "Age": Fraction(1, 3), "Risk": "low", "wait": 9})
    robot.sleec.trigger("Fall", "bath")
    robot.sleec.trigger_all(["Nap", "Morning", "Ask", "Noon"])
    robot.clock.advance(1)
    return robot.saved()


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        (RULES + "\n", {}, "its sha256 is"),
        (RULES, {"reading": "priority"}, "its reading is 'cascade', and that of the rules in force is 'priority'"),
        (RULES, {"chains": True}, "its chains is False"),
    ],
)
def test_a_snapshot_of_other_rules_is_refused(snapshot: Any, text: str, options: Any, words: str) -> None:
    refused(Robot(text, **options), snapshot, f"the snapshot is of other rules: {words}")


def test_a_snapshot_of_another_domain_is_refused() -> None:
    text = "DOMAIN day\nRULE a WHEN A THEN X WITHIN 5 seconds\nDOMAIN night\nRULE b WHEN B THEN X"
    refused(Robot(text), Robot(text, domain="day").saved(), "its domain is 'day'")


def test_a_clock_that_was_set_back_is_refused_and_the_right_time_is_taken(snapshot: Any) -> None:
    robot = Robot()
    refused(robot, snapshot, r"taken 3.500 seconds later than now: the clock was set back", SAVED_AT - 3.5)
    robot.sleec.restore(snapshot, now=snapshot["saved_at"])
    assert robot.pending()


@pytest.mark.parametrize("now", [True, "now", float("nan"), 10**13, object()])
def test_a_time_that_is_none_is_refused(snapshot: Any, now: Any) -> None:
    robot = Robot()
    for act in (lambda: robot.sleec.restore(snapshot, now), lambda: robot.sleec.pending_snapshot(now)):
        with pytest.raises(errors.WrongType, match="now is a number of seconds"):
            act()
    assert robot.pending() == []


def test_a_snapshot_is_restored_once_and_first(snapshot: Any) -> None:
    robot = Robot()
    robot.sleec.restore(snapshot, SAVED_AT)
    robot.taken()
    refused(robot, snapshot, "restored only once, and before the first trigger")
    robot = Robot()
    robot.sleec.trigger("Sleep")
    refused(robot, snapshot, "restored only once, and before the first trigger")
    robot.sleec.close()
    with pytest.raises(errors.SleecError, match="the instance is closed"):
        robot.sleec.restore(snapshot, SAVED_AT)


def test_missing_and_other_code_is_refused(snapshot: Any) -> None:
    bare = Sleec(parse(RULES), clock=VirtualClock())
    with pytest.raises(errors.NotBound):
        bare.restore(snapshot, SAVED_AT)
    assert bare.pending() == ()
    robot = Robot()
    robot.sleec.implement({"CallPolice": lambda: None})
    with pytest.raises(errors.WrongArguments):
        robot.sleec.restore(snapshot, SAVED_AT)
    assert robot.pending() == []


WRONG: list[Any] = [
    None,
    True,
    -1,
    0,
    1,
    2,
    99,
    1.5,
    10**4_000,
    "",
    "x",
    "1/0",
    "9/7",
    "waiting",
    [],
    [[]],
    {},
    {"x": 1},
]


def places(data: Any, place: tuple[Any, ...] = ("whole",)) -> list[tuple[Any, ...]]:
    """The paths to all that is in `data`, by keys and indices."""
    inner = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    return [place, *(found for key, one in inner for found in places(one, (*place, key)))]


def versions(snapshot: Any) -> Iterator[Any]:
    """`snapshot` with something else, with nothing, or with more in some place."""
    for place in places(snapshot):
        for value in (*WRONG, None):
            holder = whole = {"whole": copy.deepcopy(snapshot)}
            for key in place[:-1]:
                holder = holder[key]
            if value is not None or place == ("whole",):
                holder[place[-1]] = value
            elif isinstance(holder[place[-1]], (dict, list)):
                holder[place[-1]] = [*holder[place[-1]]] * 2
            else:
                del holder[place[-1]]
            if whole["whole"] != snapshot:
                yield whole["whole"]


def test_whatever_is_changed_in_a_snapshot_is_refused_or_harmless(snapshot: Any) -> None:
    """No other error, and nothing has changed then. What is let through is asked for by the rules."""
    accepted = total = 0
    robot = Robot()
    labels = robot.sleec.ruleset.by_label.keys()
    for version in versions(snapshot):
        total += 1
        with suppress(errors.SleecError):
            robot.sleec.restore(version, SAVED_AT)
            accepted += 1
            assert {one.rule for one in robot.sleec.pending()} <= labels
            robot = Robot()
        assert robot.pending() == []
        assert robot.log == []
    assert total > 1_000
    assert 0 < accepted < total / 8
    robot.sleec.restore(snapshot, SAVED_AT)


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        (("format",), 2, "the snapshot has the format 2, and this version reads 1"),
        (("contexts", 0, "conditions", "Awakes"), True, r"malformed at contexts\[0\]: unknown condition or measure"),
        (("contexts", 0, "conditions", "Age"), "old", "malformed: Age is 'old'"),
        (
            ("contexts", 0, "conditions", "Risk"),
            "medium",
            r"malformed at contexts\[0\]: Risk is a measure on the scale",
        ),
        (("contexts", 0, "domain"), "ward", r"malformed at contexts\[0\]: unknown domain 'ward'"),
        (("decisions", 0, "rule"), "fell", r"decisions\[0\] is .* and should be a rule that applies in its context"),
        (("decisions", 0, "clause"), 1, r"decisions\[0\].clause is 1, and should be 0"),
        (("decisions", 0, "triggered"), 1, "should be a number up to 0"),
        (("decisions", 0, "arguments"), None, "should be a decision with arguments"),
        (("pending", 0, "obligation"), "Vacuum", "should be CallNurse, which is at its path"),
        (("pending", 0, "path"), [0, "otherwise"], "should be a path to an obligation of the rule"),
        (("pending", 0, "path"), [0, "else", 0], "should be a whole number from 0 to -1"),
        (("pending", 0, "state"), "done", "should be a state of a pending obligation"),
        (("pending", 0, "broken"), True, "should be true for a prohibition only"),
        (("pending", 0, "starts"), 1, "of what is waiting"),
        (("pending", 0, "decision"), 99, "should be a whole number from 0 to"),
        (("left_out",), [{"rule": 1, "obligation": "X"}], "the names of a rule and an obligation"),
    ],
)
def test_a_malformed_snapshot_is_refused_with_the_place(
    snapshot: Any, place: tuple[Any, ...], value: Any, words: str
) -> None:
    holder = snapshot
    for key in place[:-1]:
        holder = holder[key]
    holder[place[-1]] = value
    refused(Robot(), snapshot, words)


def test_nothing_is_pending_twice(snapshot: Any) -> None:
    snapshot["pending"].append(snapshot["pending"][0])
    refused(Robot(), snapshot, "should be pending once")


def test_nothing_is_pending_beside_what_is_due_in_its_place(snapshot: Any) -> None:
    first = snapshot["pending"][0]
    snapshot["pending"].append({**first, "path": [0, "otherwise", 0], "obligation": "CallAmbulance"})
    refused(Robot(), snapshot, "should be pending in place of CallNurse, not beside it")
