"""The topics to which a monitor or a recorder subscribes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sleec_runtime.audit.mapping_file import NO_MAPPING, MappingFile
from sleec_runtime.errors import MappingError
from sleec_runtime.ros.messages import (
    Completed,
    ConditionsUpdate,
    DomainChange,
    Executed,
    LayersUpdate,
    MissionEvent,
    Start,
)
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport
from sleec_runtime.ros.transport import Topic

DEPTH = 1_000
"""Messages of a topic that wait for a monitor or recorder, so that it loses none in a burst."""

WATCHED = tuple(
    replace(kind.topic, depth=DEPTH) for kind in (DomainChange, ConditionsUpdate, LayersUpdate, MissionEvent, Executed)
)
"""The topics of our nodes that a monitor interprets."""
RECORDED = (*WATCHED, *(replace(kind.topic, depth=DEPTH) for kind in (Start, Completed, DeviationReport)))
"""The topics of our nodes that a recorder records."""

_GOAL_STATES = "action_msgs/msg/GoalStatusArray"


def live_topics(nodes: Iterable[Topic], mapping: MappingFile = NO_MAPPING) -> tuple[Topic, ...]:
    """The topics of a mapping, and those of `nodes` that it does not name, each once.

    Raises MappingError for a topic without a type.
    """
    topics = {topic.name: topic for topic in nodes}
    for source in mapping.sources:
        if source.goal is not None:
            # Servers of actions keep the states for those that join late.
            topics[source.topic] = Topic(source.topic, _GOAL_STATES, latched=True, depth=DEPTH)
        elif source.topic not in mapping.topics:
            raise MappingError(
                f"{source.where}: the type of the topic `{source.topic}` is missing",
                f'add "{source.topic}" = {{type = "…"}} to [topics]; `ros2 topic type {source.topic}` shows it',
            )
    for name, live in mapping.topics.items():
        topics[name] = Topic(name, live.type, depth=DEPTH, reliable=live.reliable)
    return tuple(topics.values())
