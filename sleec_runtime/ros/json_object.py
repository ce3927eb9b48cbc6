"""JSON objects from other processes, read strictly: each is a mapping of a bounded size, with finite numbers."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Any

from sleec_runtime.model import DIGITS, exact
from sleec_runtime.ros.transport_errors import MalformedMessage
from sleec_runtime.support.messages import represent


def read_object(text: object, max_size: int) -> dict[str, Any]:
    """The JSON object in `text`, of at most `max_size` characters.

    Raises MalformedMessage also for what Python accepts and JSON or a receiver does not: NaN, infinite numbers, numbers
    of more than 1,000 digits, a key that occurs twice, lone surrogates, and nesting that exhausts the stack.
    """
    import json

    if not isinstance(text, str):
        raise MalformedMessage(f"the message holds {represent(text)}, not a text", "send a JSON object in `data`")
    _refuse_longer(text, max_size)
    try:
        value = json.loads(
            text, object_pairs_hook=_object, parse_constant=_constant, parse_int=_integer, parse_float=_float
        )
        # An escape such as \ud800 makes a lone surrogate, which no other process can receive.
        json.dumps(value, ensure_ascii=False).encode()
    except MalformedMessage:
        raise
    except UnicodeEncodeError:
        raise MalformedMessage("the message holds a lone surrogate, which is not Unicode text") from None
    except RecursionError:
        raise MalformedMessage("the message is nested too deeply") from None
    except ValueError as error:
        raise MalformedMessage(
            f"the message is not JSON: {error}", 'send a JSON object, such as {"UserUndressed": true}'
        ) from None
    if not isinstance(value, dict):
        raise MalformedMessage(
            f"the message is {represent(value)}, not a JSON object", 'send an object, such as {"UserUndressed": true}'
        )
    return value


def write_object(fields: Mapping[str, object], max_size: int) -> str:
    """The fields as a JSON object. Raises MalformedMessage for values that are not plain data, for lone surrogates, and
    for more than `max_size` characters."""
    import json

    try:
        text = json.dumps(fields, ensure_ascii=False, allow_nan=False)
        text.encode()
    except (TypeError, ValueError, RecursionError) as error:
        raise MalformedMessage(f"the message cannot be written as JSON: {error}", "give it plain data") from None
    _refuse_longer(text, max_size)
    return text


def _refuse_longer(text: str, max_size: int) -> None:
    if len(text) > max_size:
        raise MalformedMessage(f"the message has {len(text):,} characters, and at most {max_size:,} are accepted")


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise MalformedMessage(f"the message has the key {represent(twice)} twice", "give each key once")
    return found


def _constant(text: str) -> object:
    raise MalformedMessage(f"the message holds {text}, which is not a number", "leave the value out, or send null")


def _integer(text: str) -> int:
    # As for other numbers, so that a receiver accepts what a sender has. A sign is not a digit.
    digits = len(text.lstrip("-"))
    number = exact(int(text)) if digits <= DIGITS + 1 else None
    if not isinstance(number, int):
        raise MalformedMessage(f"the message holds a number of {digits:,} digits, and at most {DIGITS:,} are accepted")
    return number


def _float(text: str) -> float:
    number = float(text)
    if not isfinite(number):
        raise MalformedMessage(f"the message holds the number {represent(text)}, which is too large")
    return number
