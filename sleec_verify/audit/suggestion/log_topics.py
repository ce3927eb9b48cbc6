"""What a log has on each topic: the type, the fields, and some of their values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from sleec_runtime.audit.observation import RawMessage
from sleec_runtime.model import Rational, exact
from sleec_verify.audit.readers.reader import IndexedReader, Reader

EACH = 200
"""The most messages of each topic that are examined."""
_MOST_VALUES = 8
"""The most distinct strings of a field that is taken for an enumeration."""
_DEEPEST = 6
_LEFT_OUT = ("header", "stamp")
"""Fields with the time and the frame of a message, which are irrelevant to rules."""


@dataclass
class FieldValues:
    """The values of one field: how many are true, false, numbers and texts, and some of them."""

    count: int = 0
    true: int = 0
    truths: int = 0
    numbers: int = 0
    least: Rational | None = None
    most: Rational | None = None
    texts: dict[str, None] = field(default_factory=dict)

    def add(self, value: object) -> None:
        """Counts a value."""
        self.count += 1
        if isinstance(value, bool):
            self.truths += 1
            self.true += value
        elif isinstance(value, str):
            # A JSON object, as our nodes send it, is not a value of an enumeration.
            if len(self.texts) <= _MOST_VALUES and not value.startswith("{"):
                self.texts[value] = None
        elif (number := exact(value)) is not None:
            self.numbers += 1
            self.least = number if self.least is None else min(self.least, number)
            self.most = number if self.most is None else max(self.most, number)

    @property
    def names(self) -> tuple[str, ...]:
        """The distinct strings, if the field looks like an enumeration."""
        return tuple(self.texts) if len(self.texts) <= _MOST_VALUES else ()


@dataclass
class Topic:
    """A topic of a log: its type if known, its fields by path, and the number of messages examined."""

    name: str
    type: str | None
    fields: dict[str, FieldValues] = field(default_factory=dict)
    messages: int = 0


def topics_of(reader: Reader) -> dict[str, Topic]:
    """The topics of a log by name. Raises UnreadableLog."""
    items = reader.sample(EACH) if isinstance(reader, IndexedReader) else (item for _, item in reader.read())
    topics: dict[str, Topic] = {}
    for item in items:
        if isinstance(item, RawMessage):
            topic = topics.setdefault(item.topic, Topic(item.topic, item.type))
            topic.messages += 1
            if topic.messages <= EACH:
                for path, value in _leaves(item.fields, ""):
                    topic.fields.setdefault(path, FieldValues()).add(value)
    return topics


def _leaves(fields: Mapping[str, object], before: str) -> Iterator[tuple[str, object]]:
    """The fields with a Boolean, a number or a string, with their paths. Lists are skipped."""
    if before.count(".") >= _DEEPEST:
        return
    for name, value in fields.items():
        path = f"{before}.{name}" if before else name
        if isinstance(value, Mapping):
            if name not in _LEFT_OUT:
                yield from _leaves(value, path)
        elif not isinstance(value, (list, tuple)) and name not in _LEFT_OUT:
            yield path, value
