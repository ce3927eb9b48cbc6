"""Nodes reject messages that do not fit the rules, report them, and continue."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime import language
from sleec_runtime.errors import SleecError, UnknownCondition, UnknownDomain, UnknownTrigger, WrongType
from sleec_runtime.ros.problems import OutOfRange
from sleec_runtime.ros.transport import Fields, Topic
from sleec_runtime.ros.transport_errors import MalformedMessage
from tests.fuzz.messages import KINDS, RULES, message, seeds
from tests.support.robot_nodes import Robot


@pytest.mark.parametrize(
    ("topic", "text", "kind"),
    [
        ("/conditions", '{"Nigth": true}', UnknownCondition),
        ("/conditions", '{"Ring": true}', UnknownCondition),
        ("/conditions", '{"Night": 1}', WrongType),
        ("/conditions", '{"Night": "true"}', WrongType),
        ("/conditions", '{"Age": true}', WrongType),
        ("/conditions", '{"Age": "15"}', WrongType),
        ("/conditions", '{"Risk": "medium"}', WrongType),
        ("/conditions", '{"Age": 150}', OutOfRange),
        ("/conditions", '{"Age": -0.5}', OutOfRange),
        ("/conditions", '{"Night": true, "Age": -1}', OutOfRange),
        ("/conditions", '{"Night": true, "Nigth": true}', UnknownCondition),
        ("/conditions", '{"Night": true, "Age": [1]}', MalformedMessage),
        ("/conditions", '{"Night": true} x', MalformedMessage),
        ("/domain", '{"domain": "hone"}', UnknownDomain),
        ("/domain", '{"domain": ["home"]}', MalformedMessage),
        ("/mission", '{"trigger": "Rang"}', UnknownTrigger),
        ("/mission", '{"trigger": "Night"}', UnknownTrigger),
    ],
)
def test_a_message_with_one_fault_changes_nothing(topic: str, text: str, kind: type[SleecError]) -> None:
    robot = Robot(RULES)
    robot.task()
    robot.report({"Age": 20})
    robot.outside.publisher(Topic(topic)).publish({"data": text})
    robot.deliver()
    assert [type(problem) for problem in robot.problems if isinstance(problem, kind)]
    assert dict(robot.manager_sleec.conditions) == {"Age": 20}
    assert robot.manager_sleec.domain is None
    assert robot.trigger("Ring") == ["Open", "Look"]


@pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")
def test_a_range_may_be_an_invariant_of_the_dsl() -> None:
    robot = Robot(
        language.parse("""
def_start event Ring event Open measure patience: numeric def_end
rule_start R1 when Ring and ({patience} > 3) then Open rule_end
relation_start measure invariant ({patience} >= 1 and {patience} <= 30) relation_end
""")
    )
    robot.report({"patience": 31})
    assert [str(problem) for problem in robot.problems] == [
        "patience is 31, outside its range: patience >= 1 AND patience <= 30 (check the sensor)"
    ]
    robot.report({"patience": 30})
    assert dict(robot.manager_sleec.conditions) == {"patience": 30}


@pytest.mark.parametrize("fields", [{}, {"data": None}, {"data": {"Night": True}}, {"Night": True}, {"data": b"{}"}])
@pytest.mark.parametrize("topic", sorted(set(KINDS) - {"/executed"}))
def test_fields_without_a_text_are_rejected(topic: str, fields: Fields) -> None:
    robot = Robot(RULES)
    robot.task()
    robot.deliver()
    robot.outside.publisher(KINDS[topic].topic).publish(fields)
    robot.deliver()
    assert isinstance(robot.problems[0], MalformedMessage)


@st.composite
def changed_messages(draw: st.DrawFn) -> bytes:
    """A message in which a part is replaced by something else."""
    data = draw(st.sampled_from(list(seeds())))
    start = draw(st.integers(0, len(data)))
    end = draw(st.integers(start, min(len(data), start + 10)))
    words = [b"null", b"true", b"-1", b"1e9", b'"Night"', b'"home"', b"[]", b"{}", b'", "', b"Infinity", b'"a": 1,']
    return data[:start] + draw(st.sampled_from(words) | st.binary(max_size=3)) + data[end:]


@given(changed_messages())
def test_nodes_continue_after_any_message(data: bytes) -> None:
    message(data, Path())
