"""Fields of messages, by paths such as ``pose.position.x`` and ``status_list[0].status``."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from sleec_runtime.audit.raw_value import raw_text
from sleec_runtime.support.messages import listed
from sleec_runtime.support.suggestions import nearest

_STEP = re.compile(r"\[(-?[0-9]{1,9})\]|(?:^|\.)([^.\[\]]+)")


class NoSuchField(Exception):
    """A message does not have a field. The text says what it has instead."""


class FieldPath:
    """The path of a field. Raises ValueError for a text that is not a path."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.steps: list[str | int] = []
        at = 0
        while at < len(text):
            found = _STEP.match(text, at)
            if found is None:
                raise ValueError(text)
            self.steps.append(int(found[1]) if found[1] is not None else found[2])
            at = found.end()
        if not self.steps:
            raise ValueError(text)

    def __repr__(self) -> str:
        return f"FieldPath({self.text!r})"

    def value(self, fields: Mapping[str, object]) -> object:
        """The value of the field in a message. Raises NoSuchField."""
        value: object = fields
        for number, step in enumerate(self.steps):
            if isinstance(step, int):
                value = self._item(value, step, number)
            elif isinstance(value, Mapping) and step in value:
                value = value[step]
            else:
                raise NoSuchField(self._missing(value, step, number))
        return value

    def _item(self, value: object, index: int, number: int) -> object:
        if not isinstance(value, Sequence) or isinstance(value, str):
            raise NoSuchField(f"`{self._before(number)}` is not a list; it is {raw_text(value)}")
        if not -len(value) <= index < len(value):
            raise NoSuchField(f"`{self._before(number)}` has {len(value)} items, and no item {index}")
        return value[index]

    def _missing(self, value: object, step: str, number: int) -> str:
        where = f"`{self._before(number)}`" if number else "the message"
        if not isinstance(value, Mapping):
            return f"{where} has no fields; it is {raw_text(value)}"
        names = [str(name) for name in value]
        near = nearest(step, names)
        hint = f"; did you mean `{near}`?" if near else f"; it has {listed(names)}" if names else ""
        return f"{where} has no field `{step}`{hint}"

    def _before(self, number: int) -> str:
        parts = [f"[{step}]" if isinstance(step, int) else f".{step}" for step in self.steps[:number]]
        return "".join(parts).removeprefix(".")
