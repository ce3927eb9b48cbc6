"""Messages of other processes on the topics of the nodes."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path

from sleec_runtime.evaluation.due import due
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_runtime.ros import messages
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.transport_errors import MalformedMessage
from tests.fuzz.property import check_error
from tests.support.robot_nodes import Robot

RULES = parse("""
MEASURE Age: number
MEASURE Risk: low < high
ASSUME Age >= 0 AND Age < 150
RULE door WHEN Ring THEN Open UNLESS Night OR Age < 6 IN WHICH CASE Wait
RULE risk WHEN Ring THEN Look UNLESS Risk > low IN WHICH CASE Call
RULE fall WHEN Fall THEN Help WITHIN 5 minutes OTHERWISE Shout
DOMAIN home
RULE light WHEN Dark THEN Shine
""")
KINDS: dict[str, type[Message]] = {
    kind.topic.name: kind
    for kind in (
        *(messages.DomainChange, messages.ConditionsUpdate, messages.MissionEvent, messages.LayersUpdate),
        *(messages.LayersRequest, messages.Heartbeat, messages.Executed, messages.Start, messages.Completed),
    )
}
logging.getLogger("sleec_runtime.ros").addHandler(logging.NullHandler())


def message(data: bytes, folder: Path) -> None:
    """Nodes report a bad message, and continue to decide by the rules. An accepted message is written as it was read.

    The first line of the input is the topic.
    """
    name, _, text = data.decode("utf-8", "surrogateescape").partition("\n")
    kind = KINDS.get(name)
    if kind is None:
        return
    robot = Robot(RULES)
    robot.task()
    robot.deliver()
    robot.outside.publisher(kind.topic).publish({"data": text})
    try:
        robot.deliver()
    except MalformedMessage:
        # Of the test, which reads /executed.
        assert kind is messages.Executed
        return
    for problem in robot.problems:
        check_error(problem)
    try:
        accepted = kind.from_json(text)
    except MalformedMessage:
        assert robot.problems or kind is messages.Executed
    else:
        assert kind.from_json(accepted.to_json()) == accepted
    # A Context Manager that the message names is silent by then.
    robot.advance(8)
    executed = robot.trigger("Ring")
    known = Context(frozenset(["Ring"]), robot.manager_sleec.conditions)
    assert executed == list(due(RULES if robot.manager_sleec.domain is None else HOME, known).obligations)


LAYERS = (
    '{"manager": "m", "number": 3, "ruleset": "0", "reading": "cascade", "full": true, '
    '"conditions": {"Night": true}, "activate": ["door.hc1"], "deactivate": []}'
)
HOME = RULES.in_domain("home")


def seeds() -> Iterator[bytes]:
    """A message of each kind, and malformed ones."""
    texts = {
        "/domain": ['{"v": 1, "domain": "home"}', '{"domain": null}', '{"domain": "hone"}'],
        "/conditions": [
            '{"Night": true, "Age": 15, "Risk": "high"}',
            '{"v": 1, "conditions": {"Age": [73, 2], "Night": null}}',
            '{"Age": 1e400}',
            '{"Age": -1}',
            '{"Night": true, "Night": false}',
            '{"Age": NaN}',
            '{"\\ud800": true}',
            '{"Age": ' + "9" * 1500 + "}",
            '{"Night": ' + "[" * 1500,
        ],
        "/mission": ['{"trigger": "Ring", "arguments": {"room": 1}, "id": "a/1"}', '{"trigger": "Fall"}'],
        "/layers_update": [LAYERS],
        "/layers_request": ['{"node": "n", "ruleset": "0", "reading": "priority", "have": 3}'],
        "/heartbeat": ['{"manager": "m", "number": 7, "beat": 2, "ruleset": "0", "reading": "cascade"}'],
        "/executed": ['{"node": "n", "triggered": 1.5, "time": 2, "trigger": "Ring", "clauses": [["door", 1]]}'],
        "/obligations": [
            '{"manager": "m", "number": 0, "beat": 1, "id": "m/1", "obligation": "Help", "arguments": {}}'
        ],
        "/completions": ['{"node": "n", "id": "m/1", "obligation": "Help"}'],
    }
    for topic, all_texts in texts.items():
        for text in all_texts:
            yield f"{topic}\n{text}".encode()
