"""Mappings of topics to names: what messages mean, and errors with their places."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.mapping import Misfit, TopicMapping
from sleec_runtime.audit.mapping_file import LiveTopic, parse_mapping
from sleec_runtime.audit.moment import UNKNOWN_DOMAIN
from sleec_runtime.audit.observation import Entered, Executed, Occurred, RawMessage, Reported
from sleec_runtime.errors import MappingError
from sleec_runtime.language import parse
from tests.support.missions import audit

RULES = parse("""
MEASURE battery: number
MEASURE risk: low < middle < high
CONDITION Dark
DOMAIN home
RULE dock WHEN LowBattery AND battery < 20 THEN Dock UNLESS Dark IN WHICH CASE Wait
DOMAIN ward
RULE stop WHEN Button AND risk > low THEN Halt
""")


def meanings(text: str, *messages: tuple[str, Any]) -> list[object]:
    mapping = TopicMapping(parse_mapping(text, "m.toml", RULES).sources)
    found: list[object] = []
    for time, (topic, fields) in enumerate(messages):
        found += [
            str(one.message) if isinstance(one, Misfit) else one
            for one in mapping.observations(RawMessage(time, topic, None, fields))
        ]
        restored = TopicMapping(mapping.sources)
        restored.restore(mapping.state())
        mapping = restored
    return found


def test_values_of_fields_are_conditions_and_measures() -> None:
    text = """
        domain = {topic = "/mode", field = "data", values = {home = "household", ward = 2}}
        [conditions]
        Dark = {topic = "/light", field = "lux.value", below = 10, until = 20}
        [measures]
        battery = {topic = "/battery", field = "cells[-1].charge", scale = 100, offset = 1}
        risk = {topic = "/risk", field = "level", values = {low = 0, high = 2}}
    """
    assert meanings(
        text,
        ("/mode", {"data": "household"}),
        ("/mode", {"data": 2}),
        ("/mode", {"data": "other"}),
        ("/light", {"lux": {"value": 9.5}}),
        ("/light", {"lux": {"value": 19}}),
        ("/light", {"lux": {"value": 20}}),
        ("/light", {"lux": {"value": 19}}),
        ("/battery", {"cells": [{"charge": 1}, {"charge": 0.123}]}),
        ("/battery", {"cells": [{"charge": float("nan")}]}),
        ("/battery", {"cells": []}),
        ("/risk", {"level": 2}),
        ("/risk", {"level": 1}),
        ("/other", {}),
    ) == [
        Entered(0, "home"),
        Entered(1, "ward"),
        "`values` has no name for 'other'",
        Entered(2, UNKNOWN_DOMAIN),
        Reported(3, {"Dark": True}),
        Reported(4, {"Dark": True}),
        Reported(5, {"Dark": False}),
        Reported(6, {"Dark": False}),
        Reported(7, {"battery": parse_number("13.3")}),
        Reported(8, {"battery": None}),
        "`cells` has 0 items, and no item -1",
        Reported(9, {"battery": None}),
        Reported(10, {"risk": "high"}),
        "`values` has no name for 1",
        Reported(11, {"risk": None}),
    ]


@pytest.mark.parametrize(
    ("entry", "raw", "problem"),
    [
        ('equals = "dark"', None, None),
        ("equals = 3", math.nan, None),
        ("equals = 3", "3", "'3' is not a number, as in `equals`"),
        ('equals = "3"', 3, "3 is not a text, as in `equals`"),
        ('equals = "3"', [3], "[3] is not a text, as in `equals`"),
        ("equals = 1", True, "True is not a number, as in `equals`"),
        ("equals = true", Fraction(1, 2), "0.5 is not true or false, as in `equals`"),
        ("above = 3", None, None),
        ("above = 3", math.nan, None),
        ("above = 3", "3", "'3' is not a number"),
        ("scale = 1", Fraction(1, 2), "0.5 is not true or false; compare it with `equals`, `above` or `below`"),
    ],
)
def test_a_value_that_is_missing_or_has_another_type_is_unknown(entry: str, raw: object, problem: str | None) -> None:
    conditions = f'[conditions]\nDark = {{topic = "/t", field = "data", {entry}}}'
    problems = [] if problem is None else [problem]
    assert meanings(conditions, ("/t", {"data": raw})) == [*problems, Reported(0, {"Dark": None})]
    events = f'[events]\nButton = {{topic = "/t", field = "data", {entry}, each = false}}'
    assert meanings(events, ("/t", {"data": raw})) == problems


@pytest.mark.parametrize("scale", [2, -2])
@pytest.mark.parametrize("raw", [math.inf, -math.inf])
def test_infinity_is_compared_with_bounds(raw: float, scale: int) -> None:
    for bound, expected in (("above", raw * scale > 0), ("below", raw * scale < 0)):
        condition = f'[conditions]\nDark = {{topic = "/t", field = "data", {bound} = 3, scale = {scale}}}'
        assert meanings(condition, ("/t", {"data": raw})) == [Reported(0, {"Dark": expected})]
    measure = f'[measures]\nbattery = {{topic = "/t", field = "data", scale = {scale}}}'
    assert meanings(measure, ("/t", {"data": raw})) == [f"{raw} is not a number", Reported(0, {"battery": None})]


def test_an_unknown_value_does_not_repeat_an_event() -> None:
    text = '[events]\nButton = {topic = "/t", field = "data", equals = "stop", each = false}'
    messages = [("/t", {"data": data}) for data in ("go", "stop", None, "stop", "go", "stop")]
    assert meanings(text, *messages) == [Occurred(1, "Button"), Occurred(5, "Button")]


@pytest.mark.parametrize("values", ["", ", values = {home = 1, ward = 'w'}"])
@pytest.mark.parametrize("raw", [5, Fraction(1, 2), True, [1], {"a": 1}, None, math.nan])
def test_a_domain_is_a_text_or_a_value_with_a_name(values: str, raw: object) -> None:
    text = f'domain = {{topic = "/t", field = "data"{values}}}'
    is_missing = raw is None or raw != raw
    *problems, entered = meanings(text, ("/t", {"data": raw}))
    assert len(problems) == (0 if is_missing else 1)
    assert all(isinstance(one, str) for one in problems)
    assert entered == Entered(0, UNKNOWN_DOMAIN)


@pytest.mark.parametrize("fields", [{"data": 3}, {"data": None}, {"dta": 1}, {}])
def test_in_a_domain_that_is_not_known_no_rule_of_a_domain_is_decided(fields: dict[str, object]) -> None:
    text = """
        domain = {topic = "/mode", field = "data", values = {home = 1, ward = 2}}
        [events]
        Button = {topic = "/button"}
    """
    auditor = Auditor(RULES)
    observed = meanings(
        text, ("/mode", {"data": 2}), ("/mode", fields), ("/button", {}), ("/mode", {"data": 1}), ("/button", {})
    )
    found = audit(auditor, [one for one in observed if isinstance(one, (Entered, Occurred))])
    assert [(one.kind, one.time, one.missing) for one in found] == [("undetermined", 2, ("domain",))]


def parse_number(text: str) -> Any:
    return Fraction(text)


def test_an_event_occurs_when_its_field_becomes_true() -> None:
    text = """
        [events]
        LowBattery = {topic = "/battery", field = "charge", below = 0.2}
        Button = [{topic = "/button"}, {topic = "/command", field = "data", equals = "stop"}]
        [obligations]
        Dock = {topic = "/docked", field = "data"}
        Halt = {topic = "/halted", field = "data", each = true}
    """
    assert meanings(
        text,
        *(("/battery", {"charge": charge}) for charge in (0.1, 0.1, 0.3, 0.1, float("nan"), 0.1)),
        ("/button", {}),
        *(("/command", {"data": data}) for data in ("go", "stop", "stop")),
        *(("/docked", {"data": data}) for data in (True, None, True, False, True)),
        *(("/halted", {"data": data}) for data in (True, True)),
    ) == [
        *(Occurred(time, "LowBattery") for time in (0, 3)),
        *(Occurred(time, "Button") for time in (6, 8, 9)),
        *(Executed(time, "Dock") for time in (10, 14)),
        *(Executed(time, "Halt") for time in (15, 16)),
    ]


def test_the_first_message_of_a_late_observation_shows_what_was_true_before() -> None:
    text = """
        events.LowBattery = {topic = "/battery", field = "charge", below = 0.2}
        obligations.Dock = {action = "/dock", goal = "succeeded"}
        obligations.Halt = {topic = "/halted", field = "data", each = true}
    """
    late = TopicMapping(parse_mapping(text, "m.toml", RULES).sources, late=True)
    goals = [{"goal_info": {"goal_id": {"uuid": [number]}}, "status": 4} for number in range(2)]
    messages: tuple[tuple[str, Any], ...] = (
        *(("/battery", {"charge": charge}) for charge in (math.nan, 0.1, 0.1, 0.3, 0.1)),
        *(("/dock/_action/status", {"status_list": goals[:number]}) for number in (1, 1, 2)),
        ("/halted", {"data": True}),
    )
    found = [
        one
        for time, (topic, fields) in enumerate(messages)
        for one in late.observations(RawMessage(time, topic, None, fields))
    ]
    assert found == [Occurred(4, "LowBattery"), Executed(7, "Dock"), Executed(8, "Halt")]


def test_goals_of_actions_count_once() -> None:
    text = """
        [events]
        LowBattery = {action = "/dock", goal = "accepted"}
        [obligations]
        Dock = {action = "/dock", goal = "succeeded"}
    """

    def status(**goals: int) -> tuple[str, Any]:
        listed = [{"goal_info": {"goal_id": {"uuid": [ord(name)]}}, "status": code} for name, code in goals.items()]
        return "/dock/_action/status", {"status_list": listed}

    assert meanings(text, status(a=1), status(a=2), status(a=4, b=2), status(a=4, b=5), status(), status(c=4)) == [
        Occurred(0, "LowBattery"),
        Occurred(2, "LowBattery"),
        Executed(2, "Dock"),
        Occurred(5, "LowBattery"),
        Executed(5, "Dock"),
    ]
    assert meanings(text, ("/dock/_action/status", {"status_list": [1]})) == ["1 is not the status of a goal"] * 2


@pytest.mark.parametrize(
    ("fields", "problem"),
    [
        ({"dat": 1}, "the message has no field `data`; did you mean `dat`?"),
        ({}, "the message has no field `data`"),
        ({"x": 1, "y": 2}, "the message has no field `data`; it has x, y"),
        ({"data": "full"}, "'full' is not a number"),
        ({"data": True}, "True is not a number"),
    ],
)
def test_a_message_that_does_not_fit_makes_the_value_unknown(fields: dict[str, object], problem: str) -> None:
    text = '[conditions]\nDark = {topic = "/t", field = "data", above = 1}'
    assert meanings(text, ("/t", fields)) == [problem, Reported(0, {"Dark": None})]
    text = '[events]\nButton = {topic = "/t", field = "data", above = 1}'
    assert meanings(text, ("/t", fields)) == [problem]


def test_a_mapping_says_what_live_topics_are() -> None:
    text = """
        [topics]
        "/battery" = {type = "sensor_msgs/msg/BatteryState", reliable = false}
        "/mode" = {type = "std_msgs/msg/String"}
    """
    assert parse_mapping(text, "m.toml", RULES).topics == {
        "/battery": LiveTopic("sensor_msgs/msg/BatteryState", reliable=False),
        "/mode": LiveTopic("std_msgs/msg/String", reliable=True),
    }


@pytest.mark.parametrize(
    ("text", "problem", "hint"),
    [
        ("x", "m.toml is not TOML", None),
        ("evnts = 1", "m.toml: unknown key 'evnts'", "did you mean `events`?"),
        *(
            (f"tolerance = {t}", "m.toml: tolerance: it is ", None)
            for t in ("-1", "nan", "inf", "1e13", "1e999", "true")
        ),
        ("events = 1", "m.toml: events: it is not a table", "[events]"),
        ('events.Button = "x"', "m.toml: [events] Button: it is 'x', not a table", "topic"),
        ("[events]\nButton = {}", "[events] Button: the key `topic` is missing", None),
        ("[events]\nButton = {topic = 1}", "`topic` is 1, not a text", None),
        ("[events]\nButon = {}", "the ruleset has no event `Buton`", "did you mean `Button`?"),
        ("[events]\nDark = {}", "`Dark` is a condition", "move it to [conditions]"),
        ("[conditions]\nbattery = {}", "`battery` is a measure", "move it to [measures]"),
        ("[conditions]\nDark = {topic = '/t'}", "the key `field` is missing", 'field = "data"'),
        ("[events]\nButton = {topic = '/t', above = 1}", "the key `field` is missing", None),
        ("[measures]\nbattery = {topic = '/t', feild = 'a'}", "unknown key `feild`", "did you mean `field`?"),
        ("[measures]\nbattery = {topic = '/t', field = 'a..b'}", "`a..b` is not the path of a field", "status_list[0]"),
        ("[measures]\nbattery = {topic = '/t', field = 'a', scale = 'b'}", "`scale` is 'b', not a number", None),
        ("[measures]\nbattery = {topic = '/t', field = 'a', scale = nan}", "not a number", None),
        ("[measures]\nbattery = {topic = '/t', field = 'a', values = {low = 1}}", "`battery` is a number", "`scale`"),
        (
            "[measures]\nrisk = {topic = '/t', field = 'a', values = {midle = 1}}",
            "has no value `midle`",
            "did you mean `middle`",
        ),
        ("[conditions]\nDark = {topic = '/t', field = 'a', above = 1, below = 2}", "exclude each other", None),
        ("[conditions]\nDark = {topic = '/t', field = 'a', until = 2}", "`until` needs", None),
        (
            "[conditions]\nDark = {topic = '/t', field = 'a', scale = 2, equals = 4}",
            "`scale` and `offset` need",
            "field",
        ),
        ("[events]\nButton = {topic = '/t', field = 'a', offset = 2}", "need `above` or `below`", "field"),
        ("[measures]\nrisk = {topic = '/t', field = 'a', scale = 2, values = {low = 1}}", "`values` excludes", "field"),
        ("[conditions]\nDark = {topic = '/t', field = 'a', above = 1, until = 2}", "`until` is at most `above`", None),
        ("[conditions]\nDark = {topic = '/t', field = 'a', equals = [1]}", "`equals` is [1]", None),
        ("[events]\nButton = {topic = '/t', field = 'a', each = 1}", "`each` is 1, not true or false", None),
        ("[events]\nButton = {action = '/t', goal = 'done'}", "the state of a goal is accepted", None),
        ("[events]\nButton = {action = '/t', goal = 'aborted', field = 'a'}", "exclude `field`", None),
        ("domain = {topic = '/t', field = 'a', values = {home = 0, ward = 0.0}}", "two names: `home` and `ward`", None),
        ("domain = {topic = '/t', field = 'a', values = {hme = 1}}", "no domain `hme`", "did you mean `home`?"),
        ("definitions = 1", "m.toml: definitions: it is not a table", "[definitions]"),
        ("[definitions]\n'my_msgs/msg/Grip' = 1", "`my_msgs/msg/Grip` is 1, not a text", None),
        ("topics = 1", "m.toml: topics: it is not a table", "[topics]"),
        ("[topics]\n'/t' = 'std_msgs/msg/Bool'", "it is 'std_msgs/msg/Bool', not a table", "type"),
        ("[topics]\n'/t' = {reliable = true}", "the key `type` is missing", None),
        ("[topics]\n'/t' = {typ = 'a'}", "unknown key `typ`", "did you mean `type`?"),
        ("[topics]\n'/t' = {type = 'a', reliable = 1}", "`reliable` is 1, not true or false", None),
    ],
)
def test_errors_name_the_place_and_the_remedy(text: str, problem: str, hint: str | None) -> None:
    with pytest.raises(MappingError) as error:
        parse_mapping(text, "m.toml", RULES)
    assert problem in error.value.message
    assert error.value.message.startswith("m.toml")
    assert hint is None or (error.value.hint is not None and hint in error.value.hint)
