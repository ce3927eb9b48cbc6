"""Drafts of mappings."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from time import process_time
from typing import Any

import pytest

from sleec_runtime.audit.observation import Occurred, RawMessage, write_line
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.audit.readers.forms import open_log
from sleec_verify.audit.suggestion.draft import draft
from sleec_verify.audit.suggestion.log_topics import FieldValues, Topic, topics_of
from tests.support.care_robot_log import write_care_robot_log
from tests.support.paths import ROOT

toml = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")


def drafted(log: Path, ruleset: Ruleset) -> tuple[dict[str, Any], str]:
    """The active lines of a draft, and its whole text."""
    text = draft(topics_of(open_log(log)), ruleset, log.name)
    return toml.loads(text), text


def json_log(folder: Path, messages: list[tuple[str, dict[str, object]]]) -> Path:
    path = folder / "log.jsonl"
    lines = [write_line(RawMessage(time, topic, None, fields)) for time, (topic, fields) in enumerate(messages)]
    path.write_text("".join(f"{line}\n" for line in [*lines, write_line(Occurred(99, "Call"))]))
    return path


def rules(trigger: str = "Go", condition: str = "Ready", obligation: str = "Act") -> Ruleset:
    return parse(f"RULE a\nWHEN {trigger} THEN {obligation}\nUNLESS {condition} IN WHICH CASE NOT {obligation}\n")


@pytest.mark.parametrize("plugin", ["mcap", "sqlite3"])
def test_a_draft_for_a_robot_that_knows_nothing_of_rules(plugin: str, tmp_path: Path) -> None:
    path = ROOT / "rulesets" / "care-robot.sleec"
    ruleset = parse(path.read_text(encoding="utf-8"), path=path.name)
    table, text = drafted(write_care_robot_log(tmp_path / "mission", plugin), ruleset)
    assert table == {
        "domain": {"topic": "/site", "field": "data"},
        "conditions": {
            "UserUndressed": {"topic": "/user_state", "field": "undressed"},
            "UserDistressed": {"topic": "/user_state", "field": "is_distressed"},
            "UserResponsive": {"topic": "/user_state", "field": "responsive"},
        },
        "measures": {
            "UserAge": {"topic": "/user_state", "field": "age"},
            "RiskLevel": {
                "topic": "/risk_level",
                "field": "data",
                "values": {"r_low": "low", "r_moderate": "moderate", "r_severe": "severe"},
            },
        },
        "events": {
            "CurtainOpenRequest": {"topic": "/curtain_open_requests"},
            "PreparingExamination": {"topic": "/preparing_examination"},
            "UserSaysStop": {"topic": "/speech/heard", "field": "data", "equals": "user says stop"},
        },
        "obligations": {
            "EnsurePrivateSpace": {"topic": "/private_space_ensured", "field": "data"},
            "OpenCurtains": {"action": "/open_curtains", "goal": "succeeded"},
            "RefuseRequest": {"action": "/refuse_request", "goal": "succeeded"},
            "RobotStop": {"action": "/stop_robot", "goal": "succeeded"},
        },
        "topics": {
            "/curtain_open_requests": {"type": "std_msgs/msg/Empty"},
            "/preparing_examination": {"type": "std_msgs/msg/Empty"},
            "/private_space_ensured": {"type": "std_msgs/msg/Bool"},
            "/risk_level": {"type": "std_msgs/msg/String"},
            "/site": {"type": "std_msgs/msg/String"},
            "/speech/heard": {"type": "std_msgs/msg/String"},
            "/user_state": {"type": "care_msgs/msg/UserState"},
        },
    }
    lines = text.splitlines()
    for name in (*ruleset.conditions, *ruleset.measures, *ruleset.triggers, *ruleset.obligations):
        (line,) = [one for one in lines if f" {name} = " in f" {one}" and not one.startswith("#   or")]
        assert line.startswith("# no suggestion: ") or "likely, " in line or "possible, " in line
    assert "UserUndressed = " in text
    assert "in the log: true in 6 of 17" in text
    assert "#   /battery_state (sensor_msgs/msg/BatteryState): voltage, " in text


@pytest.mark.parametrize(
    ("name", "topic", "fields", "entry"),
    [
        ("BatteryLow", "/battery_state", {"percentage": 0.3}, 'field = "percentage", below = 0}'),
        ("BatteryLow", "/robot1/battery", {"level": 0.3}, 'field = "level", below = 0}'),
        ("RoomTemperatureHigh", "/room/temp", {"data": 21}, 'topic = "/room/temp", field = "data", above = 0}'),
        ("DoorOpen", "/doors/front", {"state": "open"}, 'field = "state", equals = "open"}'),
        ("PersonDetected", "/persons", {"detected": True}, 'field = "detected"}'),
        ("UserDistressed", "/user/distresed", {"data": True}, 'topic = "/user/distresed", field = "data"}'),
    ],
)
def test_words_are_compared_and_not_letters(
    name: str, topic: str, fields: dict[str, object], entry: str, tmp_path: Path
) -> None:
    log = json_log(tmp_path, [(topic, fields), ("/other", {"data": True, "header": {"stamp": {"sec": 1}}})])
    _, text = drafted(log, rules(condition=name))
    (line,) = [line for line in text.splitlines() if f"{name} = " in line]
    assert entry in line
    assert "no suggestion" not in line


def test_a_bound_is_not_guessed(tmp_path: Path) -> None:
    table, text = drafted(json_log(tmp_path, [("/battery_state", {"percentage": 0.3})]), rules(condition="BatteryLow"))
    assert table["conditions"] == {}
    assert "in the log: 0.3 to 0.3; set the bound" in text


def test_two_that_fit_equally_are_both_shown(tmp_path: Path) -> None:
    log = json_log(tmp_path, [("/left/door", {"open": True}), ("/right/door", {"open": True})])
    table, text = drafted(log, rules(condition="DoorOpen"))
    assert table["conditions"] == {}
    assert '# DoorOpen = {topic = "/left/door", field = "open"}' in text
    assert '#   or DoorOpen = {topic = "/right/door", field = "open"}' in text


def test_a_word_that_every_name_has_tells_little(tmp_path: Path) -> None:
    log = json_log(tmp_path, [("/user", {"id": 5, "present": True})])
    names = "".join(f"RULE r{n}\nWHEN Go THEN Act\nUNLESS User{word} IN WHICH CASE NOT Act\n" for n, word in
                    enumerate(("Undressed", "Asleep", "Distressed", "Alone")))  # fmt: skip
    table, text = drafted(log, parse(names))
    assert table["conditions"] == {}
    assert text.count("# no suggestion: User") == 4


def test_each_message_counts_only_without_fields(tmp_path: Path) -> None:
    log = json_log(tmp_path, [("/doorbell", {}), ("/call_request", {"by": 5})])
    table, text = drafted(log, parse("RULE a\nWHEN Doorbell THEN A\nRULE b\nWHEN CallRequest THEN A\n"))
    assert table["events"] == {"Doorbell": {"topic": "/doorbell"}}
    assert '# CallRequest = {topic = "/call_request"}' in text
    assert "each message counts, whatever its field values" in text


def test_messages_of_our_nodes_need_no_mapping(tmp_path: Path) -> None:
    messages = [("/conditions", '{"Ready": true}'), ("/mission", '{"trigger": "Go"}')]
    log = json_log(tmp_path, [(topic, {"data": data}) for topic, data in messages])
    table, text = drafted(log, rules())
    assert not any(table.values())
    assert sum(" = {" in line for line in text.splitlines() if line.startswith("# no suggestion: ")) == 3


def test_names_and_values_of_any_kind_give_a_valid_draft(tmp_path: Path) -> None:
    hostile = '"\\\n\x00\x7f]}#ünïcode\u2028'
    log = json_log(tmp_path, [(f"/ready{hostile}", {f"a{hostile}": f"ready {hostile}", "": {"ready": True}})])
    table, text = drafted(log, rules())
    assert set(table) == {"conditions", "events", "obligations"}
    assert "\x00" not in text
    assert drafted(json_log(tmp_path, []), rules())[0] == {key: {} for key in table}


@pytest.mark.parametrize(
    ("number", "text"),
    [(0.25, "0.25"), (1234567890123, "1.23457e+12"), (1 / 3, "0.333333"), (-(10**400), "-1e+400"), (1e-320, "1e-320")],
)
def test_numbers_of_any_size_are_shown(number: float, text: str, tmp_path: Path) -> None:
    _, draft = drafted(json_log(tmp_path, [("/ready", {"ready": number})]), rules())
    assert f"in the log: {text} to {text}" in draft


@pytest.mark.speed
def test_a_draft_for_many_names_and_topics_is_fast() -> None:
    words = ("Battery", "Door", "User", "Curtain", "Arm", "Speed", "Joint", "Light")
    pairs = [f"{one}{other}" for one in words for other in words]
    topics = {}
    for pair in pairs:
        topics[f"/{pair}"] = topic = Topic(f"/{pair}", None)
        for other in pairs[:10]:
            topic.fields[other] = FieldValues(truths=1)
    rules = "".join(f"RULE {pair}\nWHEN {pair}A THEN {pair}B UNLESS {pair}C\n" for pair in pairs)
    started = process_time()
    assert len(draft(topics, parse(rules), "log").splitlines()) > 3 * len(pairs)
    assert process_time() - started < 5


def test_only_some_messages_of_a_recording_are_read(tmp_path: Path) -> None:
    log = write_care_robot_log(tmp_path / "mission")
    sample = list(open_log(log).sample(2))  # type: ignore[attr-defined]
    topics = [item.topic for item in sample]
    assert max(map(topics.count, topics)) == 2
    assert set(topics) == set(topics_of(open_log(log)))
