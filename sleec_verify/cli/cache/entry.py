"""An entry of the cache: results as text.

Entries are written as Python writes values, and read without running anything: unlike JSON, that needs no module
which a check has not imported anyway, and it keeps exact numbers and tuples. There is a line for each check and one
for each of its findings below it, so that thousands are read one by one: read at once, they take a hundred times the
memory.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from hashlib import sha256
from typing import TYPE_CHECKING, Any

from sleec_verify.results.finding import CheckResult, ClauseRef, Finding, Proved, Refuted, Witness
from sleec_verify.wording.sentence import Sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Value
    from sleec_verify.results.timeline import Timeline

FORMAT = "sleec-verify cache 2"


def head(path: str, body: bytes) -> bytes:
    """The first line of an entry. It contains the key, so that an entry under another name is invalid."""
    folder, name = os.path.split(path)
    key = os.path.basename(folder) + name
    return f"{FORMAT} {sha256(key.encode() + body).hexdigest()}".encode()


def encode(results: tuple[CheckResult, ...]) -> bytes:
    """The body of an entry."""
    lines: list[object] = []
    for result in results:
        lines.append((result.name, result.seconds, _plain_text(result.reason), len(result.findings)))
        lines += map(_plain, result.findings)
    return "".join(f"{line!a}\n" for line in lines).encode()


def decode(body: bytes) -> tuple[CheckResult, ...]:
    """The results of an entry. Raises any exception where the body is not one that `encode` wrote."""
    from ast import literal_eval

    results = []
    lines = (literal_eval(line.decode("ascii")) for line in body.splitlines())
    for name, seconds, reason, number in lines:
        findings = tuple(_finding(next(lines)) for _ in range(number))
        results.append(CheckResult(name, Refuted(findings) if findings else Proved(), seconds, _text(reason)))
    return tuple(results)


def _plain(finding: Finding) -> dict[str, Any]:
    """A finding as tuples, dictionaries and what Python has literals for."""
    assert finding.source is None, "what `check` finds is in the text of the rules"
    fields = {name: value for name, value in vars(finding).items() if name != "source"}
    fields["span"] = tuple(finding.span)
    fields["clauses"] = [tuple(clause) for clause in finding.clauses]
    for name in _WORDS:
        fields[name] = _plain_text(fields[name])
    fields["related"] = [(tuple(span), _plain_text(word)) for span, word in finding.related]
    if finding.witness is not None:
        one = finding.witness
        fields["witness"] = (one.triggers, _plain_values(one.conditions), one.absent)
    if finding.timeline is not None:
        moments = [
            {
                **vars(moment),
                "conditions": _plain_values(moment.conditions),
                "due": [vars(due) for due in moment.due],
            }
            for moment in finding.timeline.moments
        ]
        fields["timeline"] = (moments, finding.timeline.now)
    return fields


def _finding(fields: dict[str, Any]) -> Finding:
    from sleec_runtime.model import Span

    fields["span"] = Span(*fields["span"])
    fields["clauses"] = tuple(ClauseRef(*clause) for clause in fields["clauses"])
    for name in _WORDS:
        fields[name] = _text(fields[name])
    fields["related"] = tuple((Span(*span), _text(word)) for span, word in fields["related"])
    if fields["witness"] is not None:
        triggers, values, absent = fields["witness"]
        fields["witness"] = Witness(triggers, _values(values), absent)
    if fields["timeline"] is not None:
        fields["timeline"] = _timeline(*fields["timeline"])
    return Finding(**fields)


def _timeline(moments: list[dict[str, Any]], now: int | None) -> Timeline:
    from sleec_verify.results.timeline import Due, Moment, Timeline

    for moment in moments:
        moment["conditions"] = _values(moment["conditions"])
        moment["due"] = tuple(Due(**due) for due in moment["due"])
    return Timeline(tuple(Moment(**moment) for moment in moments), now)


_WORDS = ("message", "note", "help")


def _plain_text(text: Any) -> Any:
    """Text, or a sentence as a tuple, so that it can be translated after it was read."""
    if not isinstance(text, Sentence):
        return text
    return text.template, {name: _plain_text(value) for name, value in text.values.items()}, text.many, text.number


def _text(plain: Any) -> Any:
    if not isinstance(plain, tuple):
        return plain
    template, values, many, number = plain
    return Sentence(template, {name: _text(value) for name, value in values.items()}, many, number)


def _plain_values(values: Mapping[str, Value]) -> dict[str, Any]:
    """Values with a fraction as the pair of its numbers."""
    return {
        name: value if isinstance(value, (bool, int, str)) else (value.numerator, value.denominator)
        for name, value in values.items()
    }


def _values(plain: Mapping[str, Any]) -> dict[str, Value]:
    values = dict(plain)
    for name, value in values.items():
        if isinstance(value, tuple):
            from fractions import Fraction

            values[name] = Fraction(*value)
    return values
