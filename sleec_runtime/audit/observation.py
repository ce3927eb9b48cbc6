"""Observations of a mission, and their form as lines of JSON.

Each line is one JSON object, with its time in seconds, and one of these keys (docs/audit.md):

{"time": 0, "domain": "household"}
{"time": 12.5, "conditions": {"UserUndressed": true, "UserAge": 15, "RoomTemperature": null}}
{"time": 13, "event": "CurtainOpenRequest"}
{"time": 13.2, "executed": "RefuseRequest"}
{"time": 13.5, "topic": "/battery_state", "type": "sensor_msgs/msg/BatteryState", "message": {"percentage": 0.4}}

A recorder that could not write messages records their number: {"time": 14, "lost": 3}. Readers report a problem.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any, Union

from sleec_runtime.audit.raw_value import raw_text
from sleec_runtime.errors import MalformedObservation
from sleec_runtime.language.common.formula_printer import print_number
from sleec_runtime.model import LONGEST, NUMBER, Rational, Value, exact
from sleec_runtime.support.messages import listed, represent

if TYPE_CHECKING:
    from decimal import Decimal
    from json import JSONDecoder

_SHORT = 40
"""The most characters of a number that is converted without a check of its length."""


@dataclass(frozen=True, slots=True)
class Entered:
    """From `time` on, the rules of `domain` apply; all rules if it is None. If it is a `request`, a Context Manager
    rejects a domain that the rules do not have."""

    time: Rational
    domain: str | None
    request: bool = field(default=False, compare=False)


@dataclass(frozen=True, slots=True)
class Reported:
    """Values of conditions and measures from `time` on. None: the value is unknown."""

    time: Rational
    conditions: Mapping[str, Value | None]


@dataclass(frozen=True, slots=True)
class Occurred:
    """An event, which triggers rules."""

    time: Rational
    event: str


@dataclass(frozen=True, slots=True)
class Executed:
    """An obligation that the robot has executed."""

    time: Rational
    obligation: str


@dataclass(frozen=True, slots=True)
class RawMessage:
    """A message on a topic of a robot, which a mapping turns into observations.

    `fields` are plain values: truth values, numbers, text, lists and mappings. `type` is the name of the message type,
    if the log has one.
    """

    time: Rational
    topic: str
    type: str | None
    fields: Mapping[str, object]


class LostMessages(MalformedObservation):
    """Instead of observations, a line has the number of messages that the recorder lost."""


class MalformedValues(MalformedObservation):
    """Some values of conditions cannot be read. In `rest`, they are unknown, and the others have their values."""

    def __init__(self, message: str, hint: str, rest: Reported) -> None:
        super().__init__(message, hint)
        self.rest = rest


Observation = Union[Entered, Reported, Occurred, Executed]
"""What an audit compares with the rules. Times are exact numbers of seconds, from 0 on."""

LONGEST_LINE = 16 * 1024 * 1024
"""Bytes of the longest line of JSON that is read."""

_KEYS = ("domain", "conditions", "event", "executed", "message")
_FORM = 'write one object with "time" and one of "domain", "conditions", "event", "executed" or "message" in each line'


def write_line(observation: Observation | RawMessage) -> str:
    """The observation as one line of JSON, without a line break.

    Numbers are written exactly. A fraction without a finite decimal form is rounded as a float is. Raises
    MalformedObservation for fields of a message that are not plain values.
    """
    try:
        return _line(observation)
    except RecursionError:
        raise MalformedObservation("it is nested too deeply") from None


def _line(observation: Observation | RawMessage) -> str:
    time = observation.time
    if isinstance(observation, Entered):
        return _text({"time": time, "domain": observation.domain})
    if isinstance(observation, Reported):
        return _text({"time": time, "conditions": observation.conditions})
    if isinstance(observation, Occurred):
        return _text({"time": time, "event": observation.event})
    if isinstance(observation, Executed):
        return _text({"time": time, "executed": observation.obligation})
    kind = {} if observation.type is None else {"type": observation.type}
    head = _text({"time": time, "topic": observation.topic, **kind})
    return f'{head[:-1]}, "message": {_fields_text(observation.fields)}}}'


def write_loss(time: Rational, count: int) -> str:
    """The line for `count` messages before `time` that could not be written."""
    return _text({"time": time, "lost": count})


def read_line(line: str | bytes) -> Observation | RawMessage:
    """The observation in one line of JSON. Raises MalformedObservation."""
    try:
        value = read_json((line if isinstance(line, str) else line.decode("utf-8-sig")).rstrip())
    except UnicodeDecodeError:
        raise MalformedObservation("it is not UTF-8 text") from None
    except RecursionError:
        raise MalformedObservation("it is nested too deeply") from None
    except (ValueError, ArithmeticError) as problem:
        column = getattr(problem, "colno", None)
        why = problem if column is None else f"{problem.msg}: column {column}"  # type: ignore[union-attr]
        raise MalformedObservation(f"it is not JSON: {why}", _FORM) from None
    return observation_of(value)


def read_json(text: str) -> object:
    """The value of a JSON text, with exact numbers. Raises ValueError, also for an object that has a key twice;
    ArithmeticError for a number that is too large, and RecursionError."""
    return _decoder().decode(text)


@cache
def _decoder() -> JSONDecoder:
    from json import JSONDecoder

    return JSONDecoder(parse_float=_number, object_pairs_hook=_object)


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found = dict(pairs)
    if len(found) < len(pairs):
        keys = [key for key, _ in pairs]
        raise ValueError(f"the key {represent(next(key for key in keys if keys.count(key) > 1))} occurs twice")
    return found


def _number(text: str) -> Fraction | Decimal:
    if len(text) > _SHORT or "e" in text or "E" in text:
        from decimal import Decimal

        try:
            return Decimal(text)
        except ArithmeticError:
            raise ArithmeticError(f"the exponent of {represent(text)} is too large") from None
    whole, _, digits = text.partition(".")
    return Fraction(int(whole + digits), 10 ** len(digits))


def observation_of(value: object) -> Observation | RawMessage:
    """The observation that a JSON value describes. Raises MalformedObservation."""
    if not isinstance(value, dict):
        raise MalformedObservation("it is not a JSON object", _FORM)
    time = _time(value)
    found = [key for key in _KEYS if key in value]
    if not found and type(value.get("lost")) is int:
        raise LostMessages(f"the recorder lost {value['lost']:,} messages before the time {raw_text(time)}")
    if len(found) != 1:
        others = [represent(key) for key in value if key not in ("time", "topic", "type")]
        what = f"it has the keys {listed(found)}" if found else "it has no content"
        if others and not found:
            what = f"unknown key {others[0]}"
        raise MalformedObservation(f"{what} at the time {raw_text(time)}", _FORM)
    (key,) = found
    content = value[key]
    if key == "message":
        return _message(time, value, content)
    unknown = [name for name in value if name not in ("time", key)]
    if unknown:
        raise MalformedObservation(f"unknown key {represent(unknown[0])}", _FORM)
    if key == "conditions":
        return _reported(time, content)
    if key == "domain" and content is None:
        return Entered(time, None)
    if not isinstance(content, str):
        raise MalformedObservation(f'"{key}" is a name; got {raw_text(content)}', "write it in quotes")
    return (
        Occurred(time, content)
        if key == "event"
        else Executed(time, content)
        if key == "executed"
        else Entered(time, content)
    )


def _time(value: Mapping[str, Any]) -> Rational:
    if "time" not in value:
        raise MalformedObservation('the key "time" is missing', "give the time in seconds")
    given = value["time"]
    time = given if type(given) is Fraction else exact(given)
    if time is None or not 0 <= time <= LONGEST:
        raise MalformedObservation(f'"time" is a number of seconds, from 0 to {LONGEST:,}; got {raw_text(given)}')
    return time


def _message(time: Rational, value: Mapping[str, Any], fields: object) -> RawMessage:
    topic, kind = value.get("topic"), value.get("type")
    if not isinstance(topic, str):
        raise MalformedObservation('a "message" needs a "topic", a name', 'such as "topic": "/battery_state"')
    if not (kind is None or isinstance(kind, str)):
        raise MalformedObservation(f'"type" is the name of a message type; got {raw_text(kind)}')
    if not isinstance(fields, dict):
        raise MalformedObservation(f'"message" is an object with the fields of the message; got {raw_text(fields)}')
    return RawMessage(time, topic, kind, fields)


def _reported(time: Rational, content: object) -> Reported:
    if not isinstance(content, dict):
        raise MalformedObservation(f'"conditions" is an object with names and values; got {raw_text(content)}')
    values: dict[str, Value | None] = {}
    wrong = []
    for name, value in content.items():
        values[name] = value if isinstance(value, (bool, str)) else exact(value)
        if value is not None and values[name] is None:
            wrong.append(f"the value of {represent(name)} is {raw_text(value)}")
    if wrong:
        hint = f"give true, false, {NUMBER}, or null if it is not known"
        raise MalformedValues("; ".join(wrong), hint, Reported(time, values))
    return Reported(time, values)


def _fields_text(fields: Mapping[str, object]) -> str:
    """Fields as JSON text. Those that Python writes as JSON by itself, such as large arrays, are written fast."""
    import json

    try:
        return json.dumps(fields)
    except (TypeError, ValueError):
        return _text(fields)


def _text(value: object) -> str:
    """Plain data as JSON text."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_text(str(key))}: {_text(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_text, value)) + "]"
    import json

    if value is None or isinstance(value, (bool, str, float)):
        return json.dumps(value)
    number = exact(value)
    if number is None:
        raise MalformedObservation(f"{represent(value)} has no form in JSON")
    text = print_number(number)
    if "/" not in text:
        return text
    try:
        return repr(float(number))
    except OverflowError:
        raise MalformedObservation(f"{represent(value)} has no form in JSON") from None
