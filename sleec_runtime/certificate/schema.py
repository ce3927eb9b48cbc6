"""The schema of a manifest: exactly these keys in this order, with values of these types."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from sleec_runtime.model import READINGS


class Malformed(ValueError):
    """Data that do not fit the schema. The message says where."""


_Shape = Callable[[Any, str], None]
"""Checks a value at a place, which is given as text. Raises Malformed."""


def _exact(called: str, *kinds: type) -> _Shape:
    def check(value: Any, at: str) -> None:
        if type(value) not in kinds:
            raise Malformed(f"{at} is not {called}")

    return check


def _matching(pattern: str, called: str) -> _Shape:
    compiled = re.compile(pattern, re.ASCII)

    def check(value: Any, at: str) -> None:
        if type(value) is not str or not compiled.fullmatch(value):
            raise Malformed(f"{at} is not {called}")

    return check


def _one_of(*words: str | None) -> _Shape:
    def check(value: Any, at: str) -> None:
        if not any(value == word and type(value) is type(word) for word in words):
            raise Malformed(f"{at} is not one of {', '.join(map(str, words))}")

    return check


def _or_null(shape: _Shape) -> _Shape:
    def check(value: Any, at: str) -> None:
        if value is not None:
            shape(value, at)

    return check


def _list(shape: _Shape) -> _Shape:
    def check(value: Any, at: str) -> None:
        if type(value) is not list:
            raise Malformed(f"{at} is not a list")
        for number, one in enumerate(value):
            shape(one, f"{at}[{number}]")

    return check


def _table(names: _Shape, shape: _Shape) -> _Shape:
    """The shape of an object with any keys."""

    def check(value: Any, at: str) -> None:
        if type(value) is not dict:
            raise Malformed(f"{at} is not an object")
        for name, one in value.items():
            names(name, f"a key of {at}")
            shape(one, f"{at}.{name}")

    return check


def _record(entries: Mapping[str, _Shape], optional: str | None = None) -> _Shape:
    """The shape of an object with exactly these keys in this order, except that one may be missing."""

    def check(value: Any, at: str) -> None:
        here = at or "the manifest"
        if type(value) is not dict:
            raise Malformed(f"{here} is not an object")
        expected = [key for key in entries if key != optional or key in value]
        if list(value) != expected:
            raise Malformed(f"the keys of {here} are not {', '.join(expected)}, in this order")
        for key, one in value.items():
            entries[key](one, f"{at}.{key}" if at else key)

    return check


_TEXT = _exact("a text", str)
_TEXTS = _list(_TEXT)
_FLAG = _exact("true or false", bool)
_INTEGER = _exact("an integer", int)
_DIGEST = _matching("[0-9a-f]{64}", "a SHA-256 in hexadecimal")
_FILE = _matching(r"[a-z-]+(-[0-9]+)?\.(cnf|lrat)|(traces|templates)\.json", "the name of a file of a certificate")
_SPAN = _record(dict.fromkeys(("line", "column", "end_line", "end_column"), _INTEGER))
_CONDITIONS = _table(_TEXT, _exact("a value", bool, int, float, str))
_DUE = _record(
    {
        "rule": _or_null(_TEXT),
        "clause": _or_null(_INTEGER),
        "law": _or_null(_SPAN),
        "response": _TEXT,
        "event": _TEXT,
        "negated": _FLAG,
        "from": _INTEGER,
        "until": _or_null(_INTEGER),
        "instead_of": _or_null(_TEXT),
        "overdue": _FLAG,
    }
)
_MOMENT = _record({"time": _INTEGER, "events": _TEXTS, "conditions": _CONDITIONS, "due": _list(_DUE)})
_FINDING = _record(
    {
        "code": _TEXT,
        "severity": _one_of("error", "warning", "note"),
        "message": _TEXT,
        "rules": _TEXTS,
        "clauses": _list(_record({"rule": _TEXT, "clause": _INTEGER})),
        "obligations": _TEXTS,
        "span": _SPAN,
        "witness": _or_null(_record({"triggers": _TEXTS, "conditions": _CONDITIONS, "absent": _TEXTS}, "absent")),
        "timeline": _record({"moments": _list(_MOMENT), "now": _or_null(_INTEGER)}),
        "domains": _TEXTS,
    },
    optional="timeline",
)
_CHECK = _record(
    {
        "name": _matching("[a-z-]+", "the name of a check"),
        "verdict": _one_of("proved", "refuted", "unknown"),
        "reason": _or_null(_TEXT),
        "evidence": _one_of("proof", "trivial", "witnesses", "situations", "traces", "text", "none"),
        "refuted": _INTEGER,
        "models": _INTEGER,
        "files": _list(_FILE),
        "traces": _INTEGER,
        "uncertified": _list(_record({"what": _TEXT, "why": _TEXT})),
        "findings": _list(_FINDING),
    }
)
MANIFEST_SHAPE = _record(
    {
        "certificate": _one_of("sleec-verify"),
        "format": _INTEGER,
        "tool": _record(
            {"name": _one_of("sleec-verify"), "version": _matching("[0-9A-Za-z.+-]{1,64}", "a version")},
        ),
        "ruleset": _record(
            {"sha256": _DIGEST, "syntax": _one_of("english", "dsl"), "rules": _INTEGER, "domains": _TEXTS}
        ),
        "reading": _one_of(*READINGS),
        "domain": _or_null(_TEXT),
        "untimed": _one_of("at", "eventually", None),
        "chains": _FLAG,
        "required": _record({"proved": _FLAG, "tied": _FLAG}),
        "checks": _list(_CHECK),
        "files": _table(_FILE, _DIGEST),
    }
)
