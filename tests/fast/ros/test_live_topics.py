"""The topics to which a monitor or a recorder subscribes."""

from __future__ import annotations

import pytest

from sleec_runtime.audit.mapping_file import parse_mapping
from sleec_runtime.errors import MappingError
from sleec_runtime.language import parse
from sleec_runtime.ros.monitoring.live_topics import DEPTH, RECORDED, WATCHED, live_topics
from sleec_runtime.ros.transport import Topic

RULES = parse("CONDITION Dark\nRULE go WHEN Go THEN Drive UNLESS Dark\n")
MAPPING = """
conditions.Dark = {topic = "/conditions", field = "dark"}
obligations.Drive = {action = "/drive", goal = "succeeded"}
[topics]
"/conditions" = {type = "my_msgs/msg/Light", reliable = false}
"/camera" = {type = "sensor_msgs/msg/Image"}
"""


def test_a_mapping_adds_topics_and_replaces_those_of_nodes() -> None:
    topics = {topic.name: topic for topic in live_topics(WATCHED, parse_mapping(MAPPING, "m.toml", RULES))}
    assert topics.keys() == {topic.name for topic in WATCHED} | {"/camera", "/drive/_action/status"}
    assert topics["/conditions"] == Topic("/conditions", "my_msgs/msg/Light", depth=DEPTH, reliable=False)
    assert topics["/drive/_action/status"].type == "action_msgs/msg/GoalStatusArray"
    # A server of an action keeps the states of its goals for those that join late.
    assert [name for name, topic in topics.items() if topic.latched] == ["/layers_update", "/drive/_action/status"]


def test_many_messages_may_wait() -> None:
    assert {topic.depth for topic in RECORDED} == {DEPTH}


def test_a_topic_needs_a_type() -> None:
    text = MAPPING.replace('"/conditions" =', '"/condition" =')
    with pytest.raises(MappingError, match=r"Dark: the type of the topic `/conditions` is missing") as error:
        live_topics(WATCHED, parse_mapping(text, "m.toml", RULES))
    assert error.value.hint == 'add "/conditions" = {type = "…"} to [topics]; `ros2 topic type /conditions` shows it'
