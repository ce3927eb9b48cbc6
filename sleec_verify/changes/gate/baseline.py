"""The baseline: a file of known findings, so that only new findings block.

A finding is identified by its ruleset and its fingerprint (`results.fingerprint`): lines may move, but the statements
stay. Its code, rules, clauses and obligations are there for people.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from sleec_verify.changes.gate.keys import ConfigError
from sleec_verify.results.fingerprint import fingerprint
from sleec_verify.wording.phrases import shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.results.finding import Finding

Key = tuple[str, str, tuple[str, ...], tuple[tuple[str, int], ...], tuple[str, ...], str]
_VERSION = 2
_WITHOUT_FINGERPRINTS = 1
"""The version whose entries have no fingerprint. They allow nothing, so the gate counts them as obsolete."""


def key(path: str, ruleset: Ruleset, finding: Finding) -> Key:
    """The identity of a finding."""
    clauses = tuple((clause.rule, clause.clause) for clause in finding.clauses)
    return path, finding.code, finding.rules, clauses, finding.obligations, fingerprint(ruleset, finding)


class KnownFindings:
    """The findings of a baseline, and those of them that still exist."""

    def __init__(self, keys: Collection[Key] = ()) -> None:
        self.keys = frozenset(keys)
        self.met: set[Key] = set()

    def has(self, ruleset: Ruleset, finding: Finding, paths: Sequence[str]) -> bool:
        """Whether a finding is known under one of the paths that its ruleset has had."""
        its = {key(path, ruleset, finding) for path in paths}
        self.met |= its
        return not its.isdisjoint(self.keys)


def read_baseline(data: bytes, called: str) -> frozenset[Key]:
    """The findings of a baseline file, which messages call `called`. Raises `ConfigError`."""
    import json

    try:
        table = json.loads(data)
        version = table["version"]
        if type(version) is not int or version not in (_VERSION, _WITHOUT_FINGERPRINTS):
            raise ConfigError(f"{called} is a baseline of version {shortened(repr(version))}", _RENEW)
        return frozenset(_key(entry, version) for entry in _list(table["findings"]))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise ConfigError(f"{called} is not a baseline", _RENEW) from None


_RENEW = "write it again: sleec-verify gate --write-baseline …"


def _key(entry: Mapping[str, Any], version: int) -> Key:
    clauses = tuple((clause["rule"], clause["clause"]) for clause in _list(entry["clauses"]))
    rules, obligations = tuple(_list(entry["rules"])), tuple(_list(entry["obligations"]))
    mark = "" if version == _WITHOUT_FINGERPRINTS else entry["fingerprint"]
    texts = [entry["ruleset"], entry["code"], mark, *rules, *obligations, *(rule for rule, _ in clauses)]
    if not all(type(text) is str for text in texts) or not all(type(number) is int for _, number in clauses):
        raise TypeError("names are texts, and clauses have numbers")
    return entry["ruleset"], entry["code"], rules, clauses, obligations, mark


def _list(value: object) -> list[Any]:
    if type(value) is not list:
        raise TypeError("several things are a list")
    return value


def baseline_text(keys: Iterable[Key]) -> str:
    """A baseline file of these findings, sorted, so that versions of it can be compared."""
    findings = [
        {
            "ruleset": path,
            "code": code,
            "rules": list(rules),
            "clauses": [{"rule": rule, "clause": clause} for rule, clause in clauses],
            "obligations": list(obligations),
            "fingerprint": mark,
        }
        for path, code, rules, clauses, obligations, mark in sorted(set(keys))
    ]
    import json

    return json.dumps({"version": _VERSION, "findings": findings}, indent=2) + "\n"
