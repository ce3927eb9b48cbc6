"""The JSON object in the body of a request, and its fields with their types."""

from __future__ import annotations

import json
from collections.abc import Mapping
from decimal import Decimal
from typing import Any, NoReturn, TypeVar

from sleec_runtime.errors import SleecError
from sleec_verify.wording.phrases import quoted, shortened

_Field = TypeVar("_Field")


class BadRequest(SleecError):
    """A request that is not what the page sends."""


class Body:
    """The fields of a JSON object. Each method raises `BadRequest` if its field is missing or has another type."""

    def __init__(self, fields: Mapping[str, Any]) -> None:
        self._fields = fields

    @classmethod
    def read(cls, content: bytes) -> Body:
        """Raises `BadRequest` if the content is not a JSON object."""
        try:
            text = content.decode()
            found = json.loads(text, parse_float=Decimal, parse_constant=_no_number)
            if "\\u" in text:
                json.dumps(found, ensure_ascii=False, default=str).encode()  # half of a surrogate pair is no text
        except (ValueError, RecursionError):
            raise BadRequest("the request is not JSON", "send an object in UTF-8") from None
        if not isinstance(found, dict):
            raise BadRequest("the request is not a JSON object", "send an object in UTF-8")
        return cls(found)

    def text(self, name: str) -> str:
        return self._typed(name, str, "a text")

    def text_or_none(self, name: str) -> str | None:
        return None if self._fields.get(name) is None else self.text(name)

    def number(self, name: str) -> int:
        if isinstance(self._fields.get(name), bool):
            self._refuse(name, "a whole number")
        return self._typed(name, int, "a whole number")

    def flag(self, name: str) -> bool:
        """True or false; false if the field is missing."""
        return self._typed(name, bool, "true or false", False)

    def texts(self, name: str) -> tuple[str, ...]:
        """A list of texts; empty if the field is missing."""
        items = self._typed(name, list, "a list of texts", [])
        if not all(isinstance(item, str) for item in items):
            self._refuse(name, "a list of texts")
        return tuple(items)

    def values(self, name: str) -> dict[str, bool | int | Decimal | str]:
        """The values of conditions and measures by name; empty if the field is missing."""
        given = self._typed(name, dict, "an object of values", {})
        if not all(isinstance(value, (bool, int, Decimal, str)) for value in given.values()):
            self._refuse(name, "an object of values")
        return given

    def part(self, name: str) -> Body:
        return Body(self._typed(name, dict, "an object"))

    def parts(self, name: str) -> list[Body]:
        items = self._typed(name, list, "a list of objects")
        if not all(isinstance(item, dict) for item in items):
            self._refuse(name, "a list of objects")
        return [Body(item) for item in items]

    def _typed(self, name: str, kind: type[_Field], expected: str, default: _Field | None = None) -> _Field:
        value = self._fields.get(name, default)
        if not isinstance(value, kind):
            self._refuse(name, expected)
        return value

    @staticmethod
    def _refuse(name: str, expected: str) -> NoReturn:
        raise BadRequest(f"the field {quoted(shortened(name))} of the request must be {expected}")


def _no_number(text: str) -> NoReturn:
    raise ValueError(text)
