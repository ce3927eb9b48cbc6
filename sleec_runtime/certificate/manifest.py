"""The manifest of a certificate: its one parser, and the one way to write it.

The parser accepts exactly what `canonical` writes: these keys in this order with values of these types, and nothing
else. So two manifests that differ by a byte never say the same.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.errors import CertificateRefused
from sleec_runtime.model import READINGS
from sleec_runtime.support.messages import represent

if TYPE_CHECKING:
    from pathlib import Path

FORMAT = 2
"""The version of what stands in a certificate. Another one is refused."""


class Required(NamedTuple):
    """What is required of a certificate besides that it holds.

    `proved`: the checker that is proved in Coq accepts every refutation. `tied`: every verdict that rests on a
    refutation is proved of the rules themselves, by what is extracted from the theory in Coq.
    """

    proved: bool = False
    tied: bool = False


@dataclass(frozen=True)
class Manifest:
    """What a certificate says.

    `ruleset` describes the text of the rules, with its SHA-256. `domain` is None where the rules were checked in each
    of their domains. `untimed` says when a response without a window is due, None for rules without time; `chains`
    whether what is done triggers rules. `required` was so when the certificate was written. `verdicts` are those of the
    checks, and `files` the SHA-256 of all other files, by name. `whole` is all of it.
    """

    ruleset: Mapping[str, Any]
    reading: str
    domain: str | None
    untimed: str | None
    chains: bool
    required: Required
    verdicts: Mapping[str, str]
    files: Mapping[str, str]
    whole: Mapping[str, Any]

    @property
    def sha256(self) -> str:
        """The SHA-256 of the bytes of the rules."""
        return str(self.ruleset["sha256"])


def canonical(whole: Mapping[str, Any]) -> bytes:
    """The bytes of a manifest: JSON in ASCII, a line for each entry and one for each check."""
    rows = []
    for key, entry in whole.items():
        if key == "checks" and isinstance(entry, list):
            written = "[\n  " + ",\n  ".join(json.dumps(check) for check in entry) + "\n ]"
        else:
            written = json.dumps(entry)
        rows.append(f" {json.dumps(key)}: {written}")
    return ("{\n" + ",\n".join(rows) + "\n}\n").encode("ascii")


def parse(data: bytes, path: str | Path) -> Manifest:
    """The manifest that these bytes are; `path` is what messages call it.

    Raises CertificateRefused where they are not exactly what `canonical` writes.
    """
    try:
        whole = json.loads(data.decode("utf-8"), parse_constant=_refuse_constant)
    except (ValueError, RecursionError):
        whole = None
    if not isinstance(whole, dict) or whole.get("certificate") != "sleec-verify":
        raise CertificateRefused([("no-certificate", f"{path} is not the manifest of a certificate")])
    found = whole.get("format")
    if type(found) is not int or found != FORMAT:
        raise CertificateRefused(
            [("format", f"the certificate is of format {represent(found)}, and this version reads {FORMAT}")],
            "certify the rules again, or use the version of sleec-verify that made it",
        )
    try:
        return _strict(data, whole)
    except _Malformed as error:
        raise CertificateRefused(
            [("manifest", f"{path} is not what certify writes: {error}")], "certify the rules again"
        ) from None


def _strict(data: bytes, whole: Mapping[str, Any]) -> Manifest:
    _MANIFEST(whole, "")
    if canonical(whole) != data:
        raise _Malformed("its bytes differ from the one way to write what it says")
    verdicts = {check["name"]: check["verdict"] for check in whole["checks"]}
    if len(verdicts) < len(whole["checks"]):
        raise _Malformed("a check has two entries")
    taken = {key: whole[key] for key in ("ruleset", "reading", "domain", "untimed", "chains", "files")}
    return Manifest(required=Required(**whole["required"]), verdicts=verdicts, whole=whole, **taken)


def _refuse_constant(name: str) -> None:
    raise ValueError(f"{name} is not JSON")


# Shapes ---------------------------------------------------------------------------------------------------


class _Malformed(ValueError):
    """The manifest is not exactly what `canonical` writes. The message says where."""


_Shape = Callable[[Any, str], None]
"""Raises _Malformed for a value that does not have the shape; the text says where the value stands."""


def _exact(called: str, *kinds: type) -> _Shape:
    def check(value: Any, at: str) -> None:
        if type(value) not in kinds:
            raise _Malformed(f"{at} is not {called}")

    return check


def _matching(pattern: str, called: str) -> _Shape:
    compiled = re.compile(pattern, re.ASCII)

    def check(value: Any, at: str) -> None:
        if type(value) is not str or not compiled.fullmatch(value):
            raise _Malformed(f"{at} is not {called}")

    return check


def _one_of(*words: str | None) -> _Shape:
    def check(value: Any, at: str) -> None:
        if not any(value == word and type(value) is type(word) for word in words):
            raise _Malformed(f"{at} is not one of {', '.join(map(str, words))}")

    return check


def _or_null(shape: _Shape) -> _Shape:
    def check(value: Any, at: str) -> None:
        if value is not None:
            shape(value, at)

    return check


def _list(shape: _Shape) -> _Shape:
    def check(value: Any, at: str) -> None:
        if type(value) is not list:
            raise _Malformed(f"{at} is not a list")
        for number, one in enumerate(value):
            shape(one, f"{at}[{number}]")

    return check


def _table(names: _Shape, shape: _Shape) -> _Shape:
    """An object with any names as its keys."""

    def check(value: Any, at: str) -> None:
        if type(value) is not dict:
            raise _Malformed(f"{at} is not an object")
        for name, one in value.items():
            names(name, f"a key of {at}")
            shape(one, f"{at}.{name}")

    return check


def _record(entries: Mapping[str, _Shape], optional: str | None = None) -> _Shape:
    """An object with exactly these keys, in this order; one may be left out."""

    def check(value: Any, at: str) -> None:
        here = at or "the manifest"
        if type(value) is not dict:
            raise _Malformed(f"{here} is not an object")
        expected = [key for key in entries if key != optional or key in value]
        if list(value) != expected:
            raise _Malformed(f"the keys of {here} are not {', '.join(expected)}, in this order")
        for key, one in value.items():
            entries[key](one, f"{at}.{key}" if at else key)

    return check


_TEXT = _exact("a text", str)
_TEXTS = _list(_TEXT)
_FLAG = _exact("true or false", bool)
_INTEGER = _exact("an integer", int)
_DIGEST = _matching("[0-9a-f]{64}", "a SHA-256 in hexadecimal")
_FILE = _matching(r"[a-z-]+(-[0-9]+)?\.(cnf|lrat)", "the name of a file of a certificate")
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
        "evidence": _one_of("proof", "trivial", "witnesses", "situations", "text", "none"),
        "refuted": _INTEGER,
        "models": _INTEGER,
        "files": _list(_FILE),
        "findings": _list(_FINDING),
    }
)
_MANIFEST = _record(
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
