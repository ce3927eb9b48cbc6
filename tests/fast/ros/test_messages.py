"""Messages are read strictly, and are the same after they are written and read."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.model import exact
from sleec_runtime.ros.json_object import read_object
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.messages import (
    Completed,
    ConditionsUpdate,
    DomainChange,
    Executed,
    Heartbeat,
    LayersRequest,
    LayersUpdate,
    MissionEvent,
    Start,
)
from sleec_runtime.ros.transport_errors import MalformedMessage

TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=5)
COUNTS = st.integers(0, 10**6)
NUMBERS = st.fractions().map(exact) | st.sampled_from([Fraction(183, 5), Fraction(1, 3), Fraction(10**400, 7), 10**999])
CONDITIONS = st.dictionaries(TEXTS, st.none() | st.booleans() | NUMBERS | TEXTS, max_size=3)
TUPLES = st.lists(TEXTS, max_size=2).map(tuple)
RULES = {"ruleset": TEXTS, "reading": TEXTS}
ID = {"manager": TEXTS, "number": COUNTS, "beat": COUNTS}
LAYERS = {"full": st.booleans(), "conditions": CONDITIONS, "activate": TUPLES, "deactivate": TUPLES}
EXECUTED = {
    "due": TUPLES,
    "executed": st.none() | TUPLES,
    "clauses": st.lists(st.tuples(TEXTS, COUNTS)).map(tuple),
    "number": COUNTS,
}
PLAIN = st.dictionaries(TEXTS, st.just([1, 2.5, None]), max_size=2)
MESSAGES = st.one_of(
    st.builds(DomainChange, domain=st.none() | TEXTS),
    st.builds(LayersUpdate, manager=TEXTS, number=COUNTS, **RULES, **LAYERS, domain=st.none() | TEXTS),
    st.builds(LayersRequest, node=TEXTS, have=st.none() | COUNTS, **RULES),
    st.builds(Heartbeat, **ID, **RULES),
    st.builds(MissionEvent, trigger=TEXTS, arguments=PLAIN, id=st.none() | TEXTS),
    st.builds(Executed, node=TEXTS, triggered=st.floats(0, 2e9), time=st.floats(0, 2e9), trigger=TEXTS, **EXECUTED),
    st.builds(Start, **ID, id=TEXTS, obligation=TEXTS, arguments=PLAIN),
    st.builds(Completed, node=TEXTS, id=TEXTS, obligation=TEXTS),
)


@given(MESSAGES)
def test_a_message_is_the_same_after_it_is_written_and_read(message: Message) -> None:
    again = type(message).from_fields(message.to_fields())
    assert again == message
    kinds = [[type(value) for value in getattr(one, "conditions", {}).values()] for one in (message, again)]
    assert [kind is bool for kind in kinds[0]] == [kind is bool for kind in kinds[1]]


def test_conditions_may_be_written_by_hand() -> None:
    by_hand = '{"UserUndressed": true, "UserAge": 15, "Fever": null}'
    assert ConditionsUpdate.from_json(by_hand).conditions == {"UserUndressed": True, "UserAge": 15, "Fever": None}
    versioned = json.dumps({"v": 1, "conditions": json.loads(by_hand)})
    assert ConditionsUpdate.from_json(versioned) == ConditionsUpdate.from_json(by_hand)
    assert ConditionsUpdate.from_json(json.dumps({"conditions": json.loads(by_hand)})).conditions["UserAge"] == 15


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (None, "not a text"),
        (b"{}", "not a text"),
        ("", "not JSON"),
        ("{", "not JSON"),
        ("[]", "not a JSON object"),
        ('{"a": NaN}', "NaN"),
        ('{"a": -Infinity}', "-Infinity"),
        ('{"a": 1e999}', "too large"),
        ('{"a": ' + "9" * 5_000 + "}", "5,000 digits"),
        ('{"a": 1, "a": 2}', "twice"),
        ('{"a": {"b": 1, "b": 1}}', "twice"),
        ('{"a": "\\ud800"}', "surrogate"),
        ('{"\\udfff": 1}', "surrogate"),
        ('{"a": "\ud800"}', "surrogate"),
        ("[" * 100_000, "nested"),
        ('{"a":' * 100_000, "nested"),
        ('{"a": "' + "x" * 1_000 + '"}', "1,009 characters"),
    ],
)
def test_what_is_not_a_json_object_is_refused(text: object, message: str) -> None:
    limit = 1_000 if message.endswith("characters") else 10**6
    with pytest.raises(MalformedMessage, match=message):
        read_object(text, limit)


@pytest.mark.parametrize(
    ("kind", "text", "message"),
    [
        (DomainChange, '{"v": 2, "domain": "home"}', "version 2"),
        (DomainChange, '{"v": true, "domain": "home"}', "version True"),
        (DomainChange, '{"domain": 1}', "`domain` is 1, not a text"),
        (DomainChange, "{}", "no `domain`"),
        (DomainChange, '{"domain": "home", "x": 1}', "unknown fields: 'x'"),
        (ConditionsUpdate, '{"UserAge": {"years": 1}}', "`UserAge`"),
        (ConditionsUpdate, '{"UserAge": [1, 0]}', "`UserAge`"),
        (ConditionsUpdate, '{"v": 1}', "no `conditions`"),
        (Heartbeat, '{"manager": "m", "number": -1}', "`number` is -1"),
        (Heartbeat, '{"manager": "m", "number": true}', "`number` is True"),
        (Executed, '{"time": 1e300}', "`time`"),
        (Executed, '{"clauses": [["a", 0], ["b"]]}', "`clauses`"),
        (Executed, '{"executed": "Open"}', "`executed`"),
        (Executed, '{"obligations": ["Open"]}', "unknown fields"),
        (Executed, '{"v": 3}', "version 3"),
        (MissionEvent, '{"trigger": "Ring", "arguments": []}', "`arguments`"),
        (LayersUpdate, '{"full": 1}', "`full`"),
    ],
)
def test_a_message_of_another_form_is_refused(kind: type[Message], text: str, message: str) -> None:
    with pytest.raises(MalformedMessage, match=message):
        kind.from_json(text)
