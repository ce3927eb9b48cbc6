"""Observations as lines of JSON."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.audit.observation import (
    Entered,
    Executed,
    Observation,
    Occurred,
    RawMessage,
    Reported,
    read_line,
    write_line,
)
from sleec_runtime.errors import MalformedObservation
from sleec_runtime.model import exact

decimals = st.decimals(0, 10**12, places=9).map(lambda d: exact(d) or 0)
names = st.text(max_size=8)
values = st.none() | st.booleans() | st.integers() | decimals | names
observations = (
    st.builds(Entered, decimals, st.none() | names)
    | st.builds(Reported, decimals, st.dictionaries(names, values, max_size=3))
    | st.builds(Occurred, decimals, names)
    | st.builds(Executed, decimals, names)
)
plain = st.recursive(
    st.none() | st.booleans() | st.integers() | names,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3),
    max_leaves=6,
)
messages = st.builds(RawMessage, decimals, names, st.none() | names, st.dictionaries(names, plain, max_size=3))


@given(observations | messages)
def test_a_line_is_read_as_it_was_written(observation: Observation | RawMessage) -> None:
    line = write_line(observation)
    assert "\n" not in line
    assert line.isascii()
    json.loads(line)
    assert read_line(line) == observation == read_line(line.encode())


def test_times_are_exact() -> None:
    assert read_line('{"time": 1732381234.123456789, "event": "E"}').time == Fraction(1732381234123456789, 10**9)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("", "it is not JSON"),
        ('{"time": 1, "event": "A', "it is not JSON: Unterminated string starting at: column 22"),
        ('{"time": 1, "event": "A"\r\n', "it is not JSON: Expecting ',' delimiter: column 25"),
        ('{"time": -0.5, "event": "A"}', "got -0.5"),
        ('{"time": -25e-1, "event": "A"}', "got -2.5"),
        ('{"time": -1e300, "event": "A"}', "got -1e+300"),
        ('{"time": 0.5, "x": 1}', "at the time 0.5"),
        ('{"time": 1e9999999999999999999, "event": "A"}', "the exponent of '1e9999999999999999999' is too large"),
        ('{"time": 1, "event": 0.25}', "got 0.25"),
        (b"\xff\xfe\x00", "it is not"),
        ('{"time": 1, "event": "A", "event": "B"}', "it is not JSON: the key 'event' occurs twice"),
        ('{"time": 1, "evnt": "A"}', "unknown key 'evnt' at the time 1"),
        ('"event"', "it is not a JSON object"),
        ("[" * 100_000, "it is nested too deeply"),
        ('{"event": "A"}', 'the key "time" is missing'),
        ('{"time": "soon", "event": "A"}', '"time" is a number of seconds'),
        ('{"time": true, "event": "A"}', '"time" is a number of seconds'),
        ('{"time": -1, "event": "A"}', "from 0 to 1,000,000,000,000; got -1"),
        ('{"time": 1000000000001, "event": "A"}', "from 0 to 1,000,000,000,000; got 1000000000001"),
        ('{"time": NaN, "event": "A"}', "got nan"),
        ('{"time": Infinity, "event": "A"}', "got inf"),
        ('{"time": 1e999999999, "event": "A"}', '"time" is a number of seconds'),
        ('{"time": 1e99999999999999999999999, "event": "A"}', "it is"),
        ('{"time": 1}', "it has no content at the time 1"),
        ('{"time": 1, "event": "A", "executed": "B"}', "it has the keys event, executed"),
        ('{"time": 1, "event": ["A"]}', '"event" is a name'),
        ('{"time": 1, "event": "A", "evnt": "A"}', "unknown key 'evnt'"),
        ('{"time": 1, "conditions": ["A"]}', '"conditions" is an object'),
        ('{"time": 1, "conditions": {"A": NaN}}', "the value of 'A' is nan"),
        ('{"time": 1, "conditions": {"A": [1]}}', "the value of 'A' is [1]"),
        ('{"time": 1, "conditions": {"A": 1e1001}}', "the value of 'A' is 1e+1001"),
        ('{"time": 1, "conditions": {"A": NaN, "B": 1, "C": {}}}', "the value of 'A' is nan; the value of 'C' is {}"),
        ('{"time": 1, "message": {}}', 'a "message" needs a "topic"'),
        ('{"time": 1, "topic": "/a", "message": 1}', '"message" is an object'),
        ('{"time": 1, "topic": "/a", "type": 3, "message": {}}', '"type" is the name'),
    ],
)
def test_other_lines_are_refused_with_the_reason(line: str | bytes, message: str) -> None:
    with pytest.raises(MalformedObservation) as error:
        read_line(line)
    assert message in error.value.message
