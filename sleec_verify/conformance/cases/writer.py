"""Cases as TOML, in the form that the pytest plugin collects, and as JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from sleec_verify.wording.phrases import value_text

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Value
    from sleec_verify.conformance.cases.case import Case
    from sleec_verify.conformance.cases.selection import Cases, UnreachedGoal
    from sleec_verify.results.json_values import Json

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml(ruleset: Ruleset, criterion: str, found: Cases, path: str | None) -> str:
    """The text of a ``*.cases.toml`` file. `path` is that of the ruleset relative to the file's folder, if there is
    one."""
    return "".join(line + "\n" for line in _toml(ruleset, criterion, found, path))


def _toml(ruleset: Ruleset, criterion: str, found: Cases, path: str | None) -> Iterator[str]:
    yield from header(ruleset, criterion, found.unreached, path)
    for case in found.cases:
        yield ""
        yield from _case(case)


def header(ruleset: Ruleset, criterion: str, unreached: Sequence[UnreachedGoal], path: str | None) -> Iterator[str]:
    """The lines before the first case."""
    if path is not None:
        yield f"ruleset = {quoted_text(path)}"
    yield f"reading = {quoted_text(ruleset.reading)}"
    yield f"coverage = {quoted_text(criterion)}"
    if unreached:
        yield "unreachable = ["
        yield from (f"  {quoted_text(u.name)},  # {u.why}" for u in unreached)
        yield "]"


def situation_lines(case: Case) -> Iterator[str]:
    """The first lines of a case: its name, domain and situation."""
    yield "[[case]]"
    yield f"name = {quoted_text(case.name)}"
    if case.domain is not None:
        yield f"domain = {quoted_text(case.domain)}"
    yield f"when = {list_of(case.triggers)}"
    yield f"given = {table_of(case.conditions)}"


def _case(case: Case) -> Iterator[str]:
    yield from situation_lines(case)
    yield f"obligations = {list_of(case.obligations)}"
    if case.prohibitions:
        yield f"prohibitions = {list_of(case.prohibitions)}"
    yield "reaches = ["
    yield from (f"  {quoted_text(name)}," for name in case.reaches)
    yield "]"


def table_of(values: Mapping[str, Value | None]) -> str:
    """Values as an inline table."""
    given = ", ".join(f"{_key(name)} = {_value(value)}" for name, value in values.items() if value is not None)
    return f"{{ {given} }}" if given else "{}"


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else quoted_text(name)


def quoted_text(text: str) -> str:
    """A text in quotes."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def list_of(names: Sequence[str]) -> str:
    """A list of texts."""
    return f"[{', '.join(map(quoted_text, names))}]"


def _value(value: Value) -> str:
    text = value_text(value)
    # TOML has integers of 64 bits.
    is_long = isinstance(value, int) and not -(2**63) <= value < 2**63
    return quoted_text(text) if isinstance(value, str) or "/" in text or is_long else text


def json_text(ruleset: Ruleset, criterion: str, found: Cases, path: str | None) -> str:
    """The same as one JSON object. A number that is not a finite decimal is a string such as ``1/3``."""
    cases: list[Json] = [
        {
            "name": case.name,
            "domain": case.domain,
            "when": list(case.triggers),
            "given": {name: json_value(value) for name, value in case.conditions.items()},
            "obligations": list(case.obligations),
            "prohibitions": list(case.prohibitions or ()),
            "reaches": list(case.reaches),
        }
        for case in found.cases
    ]
    return json_document(ruleset, criterion, found.reached, found.unreached, path, cases)


def json_document(
    ruleset: Ruleset,
    criterion: str,
    reached: int,
    unreached: Sequence[UnreachedGoal],
    path: str | None,
    cases: list[Json],
) -> str:
    """The whole JSON object with these cases."""
    from sleec_verify.results.json_values import dump

    return dump(
        {
            "ruleset": path,
            "sha256": ruleset.source.sha256,
            "reading": ruleset.reading,
            "coverage": criterion,
            "reached": reached,
            "unreachable": [{"goal": u.name, "why": u.why} for u in unreached],
            "cases": cases,
        }
    )


def json_value(value: Value) -> Json:
    """A value of a condition or measure. A number that is not a finite decimal is a string."""
    if isinstance(value, Fraction):
        text = value_text(value)
        return text if "/" in text else float(value)
    return value
