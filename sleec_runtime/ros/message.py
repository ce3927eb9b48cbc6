"""What all messages share: their form, a JSON object in the field `data` of a String, and how it is read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import MISSING, Field, fields
from fractions import Fraction
from typing import Any, ClassVar, TypeVar

from sleec_runtime.model import Value, exact
from sleec_runtime.ros.json_object import read_object, write_object
from sleec_runtime.ros.transport import Fields, Topic
from sleec_runtime.ros.transport_errors import MalformedMessage
from sleec_runtime.support.messages import listed, represent

VERSION = 1
"""The version of most messages."""

Conditions = Mapping[str, "Value | None"]
"""Reported conditions and measures, by name. None: the value is unknown."""

M = TypeVar("M", bound="Message")


class Message:
    """A message. Its topic and its fields are those of the subclass, a frozen dataclass."""

    topic: ClassVar[Topic]
    max_size: ClassVar[int] = 1024 * 1024
    version: ClassVar[int] = VERSION
    """Other versions are rejected, except for those that `read_earlier` reads."""

    @classmethod
    def from_json(cls: type[M], text: object) -> M:
        """Raises MalformedMessage."""
        given = read_object(text, cls.max_size)
        version = given.pop("v", cls.version)
        if type(version) is not int or not (version == cls.version or cls.read_earlier(version, given)):
            raise MalformedMessage(
                f"the message has version {represent(version)}, and this node reads version {cls.version}",
                "run one version of sleec-runtime on all nodes",
            )
        kinds = {one.name: one for one in fields(cls)}  # type: ignore[arg-type]
        unknown = [represent(name) for name in given if name not in kinds]
        if unknown:
            raise MalformedMessage(f"the message has unknown fields: {listed(unknown)}", f"give {listed(kinds)}")
        for name, value in given.items():
            given[name] = _READ[str(kinds[name].type)](name, value)
        try:
            return cls(**given)
        except TypeError:
            required = [f"`{name}`" for name, one in kinds.items() if _is_required(one) and name not in given]
            raise MalformedMessage(f"the message has no {listed(required)}", f"give {listed(kinds)}") from None

    @classmethod
    def read_earlier(cls, version: int, given: dict[str, Any]) -> bool:
        """Replaces the fields of an earlier version by those of this one, if it can be read."""
        del version, given
        return False

    @classmethod
    def from_fields(cls: type[M], received: object) -> M:
        """The message in the fields of a received String. Raises MalformedMessage."""
        return cls.from_json(received.get("data") if isinstance(received, Mapping) else received)

    def to_json(self) -> str:
        """Without optional fields that are None. Raises MalformedMessage for what receivers would reject."""
        written: dict[str, object] = {"v": self.version}
        for one in fields(self):  # type: ignore[arg-type]
            value = getattr(self, one.name)
            if value is not None or _is_required(one):
                written[one.name] = _plain(value)
        return write_object(written, self.max_size)

    def to_fields(self) -> Fields:
        """The fields of a String."""
        return {"data": self.to_json()}


def _is_required(one: Field[Any]) -> bool:
    return one.default is MISSING and one.default_factory is MISSING


def _plain(value: object) -> object:
    """A value for JSON. A number that no float represents exactly becomes a list of numerator and denominator."""
    if isinstance(value, Fraction):
        rounded = float(value) if abs(value) < 1e300 else 0.0
        return rounded if exact(rounded) == value else [value.numerator, value.denominator]
    if isinstance(value, Mapping):
        return {name: _plain(one) for name, one in value.items()}
    return [_plain(one) for one in value] if isinstance(value, tuple) else value


# How a field is read ---------------------------------------------------------------------------------


def _wrong(name: str, value: object, expected: str) -> MalformedMessage:
    return MalformedMessage(f"`{name}` is {represent(value)}, not {expected}")


def _text(name: str, value: object) -> str:
    if not isinstance(value, str):
        raise _wrong(name, value, "a text")
    return value


def _optional_text(name: str, value: object) -> str | None:
    return None if value is None else _text(name, value)


def _count(name: str, value: object) -> int:
    if type(value) is not int or value < 0:
        raise _wrong(name, value, "a whole number from 0 on")
    return value


def _optional_count(name: str, value: object) -> int | None:
    return None if value is None else _count(name, value)


def _truth(name: str, value: object) -> bool:
    if not isinstance(value, bool):
        raise _wrong(name, value, "true or false")
    return value


def _seconds(name: str, value: object) -> float:
    if type(value) is not int and type(value) is not float:
        raise _wrong(name, value, "a number of seconds")
    if abs(value) > 10**12:
        raise _wrong(name, value, "a time up to 10^12 seconds")
    return value


def _optional_seconds(name: str, value: object) -> float | None:
    return None if value is None else _seconds(name, value)


def _texts(name: str, value: object) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(one, str) for one in value):
        raise _wrong(name, value, "a list of texts")
    return tuple(value)


def _optional_texts(name: str, value: object) -> tuple[str, ...] | None:
    return None if value is None else _texts(name, value)


def _clauses(name: str, value: object) -> tuple[tuple[str, int], ...]:
    if not isinstance(value, list):
        raise _wrong(name, value, "a list of pairs of a rule and a number")
    found = []
    for pair in value:
        if not isinstance(pair, list) or len(pair) != 2:
            raise _wrong(name, pair, "a pair of a rule and the number of its clause")
        found.append((_text(name, pair[0]), _count(name, pair[1])))
    return tuple(found)


def _object(name: str, value: object) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise _wrong(name, value, "an object")
    return value


def conditions_of(name: str, value: object) -> Conditions:
    """Conditions and measures as they were before they were written. Raises MalformedMessage."""
    return {one: _condition(one, found) for one, found in _object(name, value).items()}


def _condition(name: str, value: Any) -> Value | None:
    if isinstance(value, list) and len(value) == 2 and all(type(one) is int for one in value) and value[1] > 0:
        return exact(Fraction(*value))
    if isinstance(value, float):
        return exact(value)
    if value is None or isinstance(value, (bool, int, str)):
        return value
    raise _wrong(name, value, "true, false, a number, a value of a scale, or null")


_READ: Mapping[str, Callable[[str, Any], object]] = {
    "str": _text,
    "str | None": _optional_text,
    "int": _count,
    "int | None": _optional_count,
    "bool": _truth,
    "float": _seconds,
    "float | None": _optional_seconds,
    "tuple[str, ...]": _texts,
    "tuple[str, ...] | None": _optional_texts,
    "tuple[tuple[str, int], ...]": _clauses,
    "Mapping[str, Any]": _object,
    "Conditions": conditions_of,
}
"""How a field is read, by its annotation."""
