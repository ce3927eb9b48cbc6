"""Cases as TOML, in the form that the pytest plugin collects, and as JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from sleec_verify.results.phrases import value_text

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Value
    from sleec_verify.conformance.cases.case import Case
    from sleec_verify.conformance.cases.selection import Cases
    from sleec_verify.results.json_values import Json

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml(ruleset: Ruleset, criterion: str, found: Cases, path: str | None) -> str:
    """The text of a ``*.cases.toml`` file. `path` is that of the ruleset relative to the file's folder, if there is
    one."""
    return "".join(line + "\n" for line in _toml(ruleset, criterion, found, path))


def _toml(ruleset: Ruleset, criterion: str, found: Cases, path: str | None) -> Iterator[str]:
    if path is not None:
        yield f"ruleset = {_quoted(path)}"
    yield f"reading = {_quoted(ruleset.reading)}"
    yield f"coverage = {_quoted(criterion)}"
    if found.unreached:
        yield "unreachable = ["
        yield from (f"  {_quoted(u.name)},  # {u.why}" for u in found.unreached)
        yield "]"
    for case in found.cases:
        yield ""
        yield from _case(case)


def _case(case: Case) -> Iterator[str]:
    yield "[[case]]"
    yield f"name = {_quoted(case.name)}"
    if case.domain is not None:
        yield f"domain = {_quoted(case.domain)}"
    yield f"when = {_list(case.triggers)}"
    given = ", ".join(f"{_key(name)} = {_value(value)}" for name, value in case.conditions.items())
    yield f"given = {{ {given} }}" if given else "given = {}"
    yield f"obligations = {_list(case.obligations)}"
    if case.prohibitions:
        yield f"prohibitions = {_list(case.prohibitions)}"
    yield "reaches = ["
    yield from (f"  {_quoted(name)}," for name in case.reaches)
    yield "]"


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else _quoted(name)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _list(names: Sequence[str]) -> str:
    return f"[{', '.join(map(_quoted, names))}]"


def _value(value: Value) -> str:
    text = value_text(value)
    # TOML has integers of 64 bits.
    is_long = isinstance(value, int) and not -(2**63) <= value < 2**63
    return _quoted(text) if isinstance(value, str) or "/" in text or is_long else text


def json_text(ruleset: Ruleset, criterion: str, found: Cases, path: str | None) -> str:
    """The same as one JSON object. A number that is not a finite decimal is a string such as ``1/3``."""
    from sleec_verify.results.json_values import dump

    cases: list[Json] = [
        {
            "name": case.name,
            "domain": case.domain,
            "when": list(case.triggers),
            "given": {name: _number(value) for name, value in case.conditions.items()},
            "obligations": list(case.obligations),
            "prohibitions": list(case.prohibitions or ()),
            "reaches": list(case.reaches),
        }
        for case in found.cases
    ]
    return dump(
        {
            "ruleset": path,
            "sha256": ruleset.source.sha256,
            "reading": ruleset.reading,
            "coverage": criterion,
            "reached": found.reached,
            "unreachable": [{"goal": u.name, "why": u.why} for u in found.unreached],
            "cases": cases,
        }
    )


def _number(value: Value) -> Json:
    if isinstance(value, Fraction):
        text = value_text(value)
        return text if "/" in text else float(value)
    return value
