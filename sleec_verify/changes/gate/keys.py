"""The keys of a configuration, and their values.

Every key is checked, because a misspelled one would allow what it was meant to block. Paths stay inside the repository.
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

from sleec_runtime.errors import SleecError
from sleec_verify.results.finding import SEVERITIES, Severity


class ConfigError(SleecError):
    """An invalid configuration: missing, not TOML, or with an unknown key or value."""


class Target(NamedTuple):
    """A robot's code, and the rules whose structure it must have. Paths are relative to `folder`, the folder of the
    settings."""

    code: str
    rules: str
    domain: str | None = None
    folder: str = "."

    def at(self, path: str) -> str:
        """One of its paths, relative to the top of the repository."""
        return joined(self.folder, path)


class Policy(NamedTuple):
    """What blocks a change.

    `findings`: findings of `check` and `conform` of at least this severity; "never" for none. `new_conflicts`:
    situations that conflict now and did not in the base. `lost_obligations`: patterns (``Call*``, ``NOT Speak``) of
    obligations that some situation loses. `ruled_out_situations`: situations that the current assumptions exclude and
    those of the base allowed. `dead_hedges`: a hedge that never decides. `unknown`: every inconclusive answer.
    `unused_suppressions`: a suppression that no finding needs. `clause_coverage`: cases that reach fewer clauses than
    this percentage; None for no limit. `certificates`: a ruleset without a valid certificate beside it.
    `require_proved` and `require_tied` imply `certificates` and require more of them (`certificate.manifest.Required`).
    `deletions`: a path that has rules in the base and none now. `policy_changes`: a change to the configuration, the
    baseline or the assertions. `new_suppressions`: a suppression that the base does not have, which then allows
    nothing.
    """

    findings: Severity | Literal["never"] = "error"
    new_conflicts: bool = True
    lost_obligations: tuple[str, ...] = ()
    ruled_out_situations: bool = False
    dead_hedges: bool = False
    unknown: bool = True
    unused_suppressions: bool = False
    clause_coverage: float | None = None
    certificates: bool = False
    require_proved: bool = False
    require_tied: bool = False
    deletions: bool = True
    policy_changes: bool = True
    new_suppressions: bool = True

    def requiring(self, proved: bool, tied: bool) -> Policy:
        """This policy with further requirements for certificates. Each of them implies `certificates`."""
        proved, tied = proved or self.require_proved, tied or self.require_tied
        asked = self.certificates or proved or tied
        return self._replace(certificates=asked, require_proved=proved, require_tied=tied)


def settings(table: object, called: str, where: str, folder: str) -> dict[str, Any]:
    """The fields of a `Config` that a table sets, with paths relative to `folder`. Messages call the file `called`,
    and the table in it `where`. Raises `ConfigError`."""
    return _Reader(called, where, folder).read(table, SETTINGS, "")


def is_assertion(entry: str) -> bool:
    """Whether an entry of `assertions` is an assertion; other entries are files."""
    return entry.split(" ")[0].lower() in ("never", "always")


def joined(folder: str, path: str) -> str:
    """A path in `folder`, relative to the top of the repository."""
    return posixpath.normpath(posixpath.join(folder, path))


class _Reader:
    """Reads tables, and reports errors with their places."""

    def __init__(self, path: str, where: str, folder: str) -> None:
        self._path = path
        self._where = where
        self.folder = folder

    def read(self, table: object, keys: Mapping[str, _Read], at: str) -> dict[str, Any]:
        if not isinstance(table, dict):
            self.fail(at or "the table", table, "a table of keys and values")
        assert isinstance(table, dict)
        found = {}
        for key, value in table.items():
            name = f"{at}.{key}" if at else key
            if key not in keys:
                from sleec_runtime.support.suggestions import nearest

                near = nearest(key, sorted(keys))
                hint = f"did you mean `{near}`?" if near else f"the keys are {', '.join(sorted(keys))}"
                raise ConfigError(f"{self._path}: {self._where}unknown key `{name}`", hint)
            found[key.replace("-", "_")] = keys[key](self, name, value)
        return found

    def fail(self, name: str, value: object, wanted: str) -> Any:
        shown = repr(value)
        shown = f"{shown[:37]}..." if len(shown) > 40 else shown
        raise ConfigError(f"{self._path}: {self._where}{name} is {shown}", f"it is {wanted}")


_Read = Callable[[_Reader, str, object], Any]


def _text(reader: _Reader, name: str, value: object) -> str:
    return value if isinstance(value, str) and value else str(reader.fail(name, value, "a text"))


def _path(reader: _Reader, name: str, value: object) -> str:
    path = _text(reader, name, value)
    if posixpath.isabs(path) or joined(reader.folder, path).split("/")[0] == "..":
        reader.fail(name, value, "a path inside the repository, from the folder of the configuration")
    return path


def _truth(reader: _Reader, name: str, value: object) -> bool:
    return value if isinstance(value, bool) else bool(reader.fail(name, value, "true or false"))


def _texts(reader: _Reader, name: str, value: object) -> tuple[str, ...]:
    if isinstance(value, str) and value:
        return (value,)
    if not isinstance(value, list) or not all(isinstance(one, str) and one for one in value):
        reader.fail(name, value, "a list of texts")
    return tuple(value)  # type: ignore[arg-type]


def _paths(reader: _Reader, name: str, value: object) -> tuple[str, ...]:
    return tuple(_path(reader, name, one) for one in _texts(reader, name, value))


def _assertions(reader: _Reader, name: str, value: object) -> tuple[str, ...]:
    return tuple(one if is_assertion(one) else _path(reader, name, one) for one in _texts(reader, name, value))


def _severity(reader: _Reader, name: str, value: object) -> str:
    allowed = (*SEVERITIES, "never")
    return str(value) if value in allowed else str(reader.fail(name, value, f"one of {', '.join(allowed)}"))


def _percent(reader: _Reader, name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 <= value <= 100:
        reader.fail(name, value, "a number from 0 to 100")
    return float(value)  # type: ignore[arg-type]


def _targets(reader: _Reader, name: str, value: object) -> tuple[Target, ...]:
    tables: Sequence[object] = value if isinstance(value, list) else [value]
    found = []
    for number, table in enumerate(tables, 1):
        at = f"{name} {number}" if len(tables) > 1 else name
        settings = reader.read(table, {"code": _path, "rules": _path, "domain": _text}, at)
        for key in ("code", "rules"):
            if key not in settings:
                raise ConfigError(
                    f"{reader._path}: {reader._where}{at} has no {key}", "a target needs both code and rules"
                )
        found.append(Target(folder=reader.folder, **settings))
    return tuple(found)


def _policy(reader: _Reader, name: str, value: object) -> Policy:
    return Policy(**reader.read(value, POLICIES, name))


POLICIES: Mapping[str, _Read] = {
    "findings": _severity,
    "new-conflicts": _truth,
    "lost-obligations": _texts,
    "ruled-out-situations": _truth,
    "dead-hedges": _truth,
    "unknown": _truth,
    "unused-suppressions": _truth,
    "clause-coverage": _percent,
    "certificates": _truth,
    "require-proved": _truth,
    "require-tied": _truth,
    "deletions": _truth,
    "policy-changes": _truth,
    "new-suppressions": _truth,
}

SETTINGS: Mapping[str, _Read] = {
    "rulesets": _paths,
    "base": _text,
    "baseline": _path,
    "assertions": _assertions,
    "targets": _targets,
    "block": _policy,
}
