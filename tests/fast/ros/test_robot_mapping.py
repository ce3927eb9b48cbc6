"""The meaning of the messages of our nodes, and of those of a robot beside them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from sleec_runtime.audit.mapping import Misfit
from sleec_runtime.audit.mapping_file import parse_mapping
from sleec_runtime.audit.observation import Entered, Executed, Occurred, RawMessage, Reported, read_line, write_line
from sleec_runtime.errors import MappingError
from sleec_runtime.language import parse
from sleec_runtime.ros.monitoring.robot_mapping import RobotMapping

RULES = parse("MEASURE age: number\nCONDITION Dark\nRULE go WHEN Go AND age > 3 THEN Drive UNLESS Dark\n")


def update(number: int, full: bool = False, domain: str = "null", **conditions: str) -> tuple[str, str]:
    values = ", ".join(f'"{name}": {value}' for name, value in conditions.items())
    rest = '"ruleset": "a", "reading": "cascade", "activate": [], "deactivate": []'
    head = f'"manager": "m", "number": {number}, "full": {str(full).lower()}, "domain": {domain}'
    return "/layers_update", f'{{"v": 1, {head}, {rest}, "conditions": {{{values}}}}}'


def meanings(*messages: tuple[str, Any], mapping: str = "") -> list[object]:
    """What messages mean, one a second, also if each comes from a log, and the state is saved between them."""
    live = RobotMapping(parse_mapping(mapping, "m.toml", RULES).sources)
    found: list[object] = []
    for time, (topic, text) in enumerate(messages):
        message = RawMessage(time, topic, "std_msgs/msg/String", {"data": text} if isinstance(text, str) else text)
        meaning = [one.message if isinstance(one, Misfit) else one for one in live.observations(message)]
        found += meaning
        if not isinstance(text, str):
            continue
        recorded = read_line(write_line(message))
        assert isinstance(recorded, RawMessage)
        restored = RobotMapping(live.sources)
        restored.restore(live.state())
        live = restored
    return found


def test_an_entry_of_the_mapping_replaces_what_our_nodes_say_about_its_name() -> None:
    mapping = """
        domain = {topic = "/mode", field = "data"}
        [conditions]
        Dark = {topic = "/light", field = "data"}
        [events]
        Go = {topic = "/go"}
        [obligations]
        Drive = {topic = "/wheels"}
    """
    ours: tuple[tuple[str, Any], ...] = (
        ("/domain", '{"domain": "home"}'),
        ("/conditions", '{"Dark": true}'),
        update(0, full=True, Dark="true"),
        ("/conditions", '{"Dark": true, "age": 3}'),
        ("/mission", '{"trigger": "Go"}'),
        ("/executed", '{"node": "n", "triggered": 1, "time": 1, "trigger": "Go", "executed": ["Drive", "Look"]}'),
    )
    assert meanings(*ours, mapping=mapping) == [Reported(3, {"age": 3}), Executed(5, "Look")]
    own: tuple[tuple[str, Any], ...] = (
        ("/mode", {"data": "home"}),
        ("/light", {"data": True}),
        ("/go", {}),
        ("/wheels", {}),
    )
    wanted = [Entered(0, "home"), Reported(1, {"Dark": True}), Occurred(2, "Go"), Executed(3, "Drive")]
    assert meanings(*own, mapping=mapping) == wanted


def test_messages_of_our_nodes_mean_what_they_say() -> None:
    assert meanings(
        ("/domain", '{"domain": "home"}'),
        ("/conditions", '{"Dark": true, "age": 3.1, "x": null}'),
        ("/conditions", '{"v": 1, "conditions": {"age": [1, 3]}}'),
        ("/mission", '{"trigger": "Go", "id": "1"}'),
        ("/mission", '{"trigger": "Go", "id": "1"}'),
        ("/mission", '{"trigger": "Go"}'),
        ("/executed", '{"node": "n", "triggered": 1, "time": 1.5, "trigger": "Go", "executed": ["Drive", "Look"]}'),
        ("/executed", '{"node": "n", "triggered": 1, "time": 1.5, "trigger": "Go", "refused": "out of step"}'),
        ("/executed", '{"node": "n", "triggered": 1, "time": 1.5, "executed": ["Look"]}'),
        ("/heartbeat", "{}"),
    ) == [
        Entered(0, "home"),
        Reported(1, {"Dark": True, "age": Fraction("3.1"), "x": None}),
        Reported(2, {"age": Fraction(1, 3)}),
        Occurred(3, "Go"),
        Occurred(5, "Go"),
        Executed(6, "Drive"),
        Executed(6, "Look"),
        Executed(8, "Look"),
    ]


def test_the_context_of_the_manager_counts_where_nothing_else_was_reported() -> None:
    assert meanings(
        update(1, full=True, domain='"home"', Dark="true", age="4", Other="false"),
        ("/conditions", '{"Dark": false}'),
        # It may be late, so it does not count for what /conditions has.
        update(2, domain='"home"', Dark="true", age="5"),
        ("/domain", '{"domain": null}'),
        # Another manager does not know what the first one knew.
        update(0, full=True, domain='"ward"', Dark="true"),
        update(1, domain='"ward"', age="6"),
    ) == [
        Entered(0, "home"),
        Reported(0, {"Dark": True, "age": 4, "Other": False}),
        Reported(1, {"Dark": False}),
        Entered(2, "home"),
        Reported(2, {"age": 5}),
        Entered(3, None),
        Reported(4, {"age": None, "Other": None}),
        Reported(5, {"age": 6}),
    ]


def test_a_source_of_the_mapping_takes_the_place_of_the_meaning() -> None:
    text = 'events.Go = {topic = "/mission", field = "data", equals = "go"}\n'
    assert meanings(("/mission", "go"), ("/conditions", '{"Dark": true}'), mapping=text) == [
        Occurred(0, "Go"),
        Reported(1, {"Dark": True}),
    ]


@pytest.mark.parametrize(
    ("topic", "text", "problem"),
    [
        ("/conditions", "{", "not JSON"),
        ("/conditions", '{"Dark": {}}', "`Dark` is {}"),
        ("/conditions", '{"Dark": NaN}', "NaN"),
        ("/domain", "{}", "has no `domain`"),
        ("/domain", '{"v": 2, "domain": null}', "version 2"),
        ("/mission", '{"trigger": 1}', "`trigger` is 1"),
        ("/executed", '{"executed": ["Drive"]}', "has no"),
        ("/layers_update", " {}", "has no"),
    ],
)
def test_a_malformed_message_means_nothing(topic: str, text: object, problem: str) -> None:
    (found,) = meanings((topic, text))
    assert problem in str(found)


@pytest.mark.parametrize("fields", [5, {}, {"data": 5}, {"data": "go to the kitchen"}, {"data": "[]"}, {"text": "{}"}])
def test_messages_of_other_robots_mean_nothing(fields: object) -> None:
    topics = ("/domain", "/conditions", "/layers_update", "/mission", "/executed")
    assert meanings(*((topic, fields) for topic in topics)) == []
    message = RawMessage(0, "/domain", "nav_msgs/msg/Domain", {"data": '{"domain": "home"}'})
    assert list(RobotMapping().observations(message)) == []


def executed(node: str, triggered: float, time: float, trigger: str = "Go") -> tuple[str, str]:
    times = f'"triggered": {triggered}, "time": {time}'
    return "/executed", f'{{"node": "{node}", {times}, "trigger": "{trigger}", "executed": ["Drive"]}}'


def test_a_report_of_a_task_stands_for_a_trigger_that_nothing_else_shows() -> None:
    reports = (
        executed("one", 8, 8.05),
        executed("two", 8.01, 8.05),
        executed("one", 8.5, 8.5),
        executed("two", 20, 25),
        ("/mission", '{"trigger": "Stop"}'),
        executed("two", 21, 21, "Stop"),
    )
    unknown = "the time of `Go` is not known; add the topic that triggers it to the mapping"
    assert meanings(*reports) == [
        *(Occurred(0, "Go"), Executed(0, "Drive")),
        Executed(1, "Drive"),
        *(Occurred(2, "Go"), Executed(2, "Drive")),
        *(unknown, Executed(3, "Drive")),
        *(Occurred(4, "Stop"), Executed(5, "Drive")),
    ]
    mapped = 'events.Go = {topic = "/button"}'
    assert Occurred(0, "Go") not in meanings(*reports, mapping=mapped)


def test_ever_new_names_do_not_exhaust_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_runtime.ros.monitoring.robot_mapping.MOST_NAMES", 10)
    mapping = RobotMapping()
    for number in range(200):
        name = f"n{number}"
        for topic, text in (
            ("/conditions", f'{{"{name}": true, "m{name}": null}}'),
            update(number, False, "null", **{name: "true"}),
            ("/mission", f'{{"trigger": "{name}"}}'),
            executed("node", number, number, f"other {name}"),
        ):
            assert list(mapping.observations(RawMessage(number, topic, None, {"data": text})))
    assert len(str(mapping.state())) < 2_000


def test_another_state_is_refused() -> None:
    states: list[dict[str, object]] = [{"held": [], "goals": []}, {"held": [], "goals": [], "nodes": [1]}]
    for state in states:
        with pytest.raises(MappingError):
            RobotMapping().restore(state)
