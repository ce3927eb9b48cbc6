"""What the messages of a log can mean: each field, value, topic and action is a candidate for names of rules."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from sleec_runtime.audit.raw_value import number_text
from sleec_runtime.support.messages import listed, represent
from sleec_runtime.support.word_forms import stem, words_of_each
from sleec_verify.audit.suggestion.log_topics import FieldValues, Topic
from sleec_verify.wording.phrases import counted

CandidateForm = Literal["truth", "number", "text", "value", "message", "action"]
"""A field with truth values, numbers or texts, one text of a field, each message of a topic, or the goals of an
action."""

_ACTION = "/_action/status"
_GENERIC = frozenset({"data", "valu", "messag", "msg", "state", "statu", "info", "robot"}) | {
    *("std", "string", "bool", "float", "int", "uint")
}
"""Stop words: stems without information about the meaning of a message."""


@dataclass(frozen=True)
class Candidate:
    """Messages that a name can mean. `words` are the stems of the words that name them, and `type_words` those of the
    message type. `values` describes the values in the log. `texts` are the texts of a field, or
    the fields of a message."""

    topic: str
    form: CandidateForm
    words: frozenset[str]
    type_words: frozenset[str]
    values: str
    path: str | None = None
    equals: str | None = None
    texts: tuple[str, ...] = ()


def candidates(topics: Iterable[Topic]) -> Iterator[Candidate]:
    """The candidates in a log."""
    for topic in topics:
        kind = stems_of((topic.type or "").rpartition("/")[2])
        messages = counted(topic.messages, "message")
        if topic.name.endswith(_ACTION):
            action = topic.name.removesuffix(_ACTION)
            yield Candidate(action, "action", stems_of(action), frozenset(), messages)
            continue
        words = stems_of(topic.name)
        yield Candidate(topic.name, "message", words, kind, messages, texts=tuple(topic.fields))
        for path, found in topic.fields.items():
            own = words | stems_of(path)
            if found.truths:
                yield Candidate(topic.name, "truth", own, kind, f"true in {found.true} of {found.truths}", path)
            if found.numbers:
                yield Candidate(topic.name, "number", own, kind, _range(found), path)
            if found.names:
                values = listed([represent(name) for name in found.names])
                yield Candidate(topic.name, "text", own, kind, values, path, texts=found.names)
                for name in found.names:
                    yield Candidate(topic.name, "value", own | stems_of(name), kind, values, path, name)


@lru_cache(maxsize=10_000)
def stems_of(name: str) -> frozenset[str]:
    """The stems of the words in a name, without stop words."""
    return frozenset(stem(word) for word in words_of_each([name])[0]) - _GENERIC


def _range(found: FieldValues) -> str:
    assert found.least is not None
    assert found.most is not None
    return f"{number_text(found.least, 11)} to {number_text(found.most, 11)}"
