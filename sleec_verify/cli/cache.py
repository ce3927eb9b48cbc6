"""What was decided once, kept for rules that did not change: results of `check`, by what they depend on.

An entry is a file, named by a hash of all that its results depend on: the bytes of the rules, how they were read, what
was asked, and the program itself. It holds a hash of its content, and what does not fit that is no entry: it is
decided anew. Where a solver gave up nothing is kept, as another time it may not.

Entries are trusted as the program is, so they belong into a folder that only their user writes to; by default that is
the user's cache folder, never the project's, in which a pull request could bring along results of its own.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import sleec_runtime
import sleec_verify
from sleec_runtime.errors import SleecError
from sleec_verify import __version__
from sleec_verify.files.temporary import put_in_place
from sleec_verify.results.finding import CheckResult, ClauseRef, Finding, Proved, Refuted, Unknown, Witness

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Value
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.results.timeline import Timeline

VARIABLE = "SLEEC_VERIFY_CACHE"
OFF = "off"
_FORMAT = "sleec-verify cache 1"
_MOST = 64
"""Entries in one of the 256 folders; of more, the oldest are deleted."""


class Cache:
    """Results in a folder. `tell` is told of what is not as it should be, in a sentence."""

    def __init__(self, folder: str, tell: Callable[[str], None], chosen: bool = True) -> None:
        self._folder = folder
        self._tell = tell
        self._chosen = chosen
        self._program: str | None = None

    @classmethod
    def of_environment(cls, tell: Callable[[str], None]) -> Cache | None:
        """The cache in the folder that SLEEC_VERIFY_CACHE names, or in the user's cache folder; None if it is ``off``,
        or there is no such folder.

        Raises:
            SleecError: SLEEC_VERIFY_CACHE names something that is no folder.
        """
        named = os.environ.get(VARIABLE, "")
        if named == OFF:
            return None
        if named and os.path.lexists(named) and not os.path.isdir(named):
            raise SleecError(f"{VARIABLE} is {named}, which is no folder", f"name a folder, or say {VARIABLE}={OFF}")
        folder = named or _users()
        return None if folder is None else cls(folder, tell, chosen=bool(named))

    def kept(
        self, ruleset: Ruleset, domain: str | None, untimed: Untimed, chains: bool = True
    ) -> tuple[CheckResult, ...] | None:
        """The results for a ruleset, if they are kept. O(their size)."""
        path = self._path(ruleset, domain, untimed, chains)
        # What is no file is no entry, and reading it might never end.
        if path is None or not os.path.isfile(path):
            return None
        try:
            with open(path, "rb") as file:
                head, _, body = file.read().partition(b"\n")
        except OSError:
            return None
        if head == _head(path, body):
            with suppress(Exception):  # what a decoder may raise at what it does not expect is of every kind
                return _decoded(body)
        self._tell(f"the cache entry {path} is broken; what it held is decided anew")
        return None

    def keep(
        self,
        ruleset: Ruleset,
        domain: str | None,
        untimed: Untimed,
        results: tuple[CheckResult, ...],
        chains: bool = True,
    ) -> None:
        """Keep the results for a ruleset, unless one of them is unknown. That it cannot be done is no failure."""
        path = self._path(ruleset, domain, untimed, chains)
        if path is None or any(isinstance(result.verdict, Unknown) for result in results):
            return
        body = _encoded(results)
        try:
            self._put(path, _head(path, body) + b"\n" + body)
        except OSError as error:
            if self._chosen:
                self._tell(f"nothing can be kept in {self._folder}: {error.strerror}")

    def _path(self, ruleset: Ruleset, domain: str | None, untimed: Untimed, chains: bool) -> str | None:
        """Where the results for a ruleset are kept. None for one that was made without a text."""
        text = ruleset.source.sha256
        if text is None:
            return None
        if self._program is None:
            self._program = _program()
        asked = (domain, untimed, chains)
        read = (ruleset.syntax, ruleset.dialect, ruleset.reading)
        key = sha256(ascii((_FORMAT, __version__, self._program, text, read, asked)).encode()).hexdigest()
        return os.path.join(self._folder, key[:2], key[2:])

    def _put(self, path: str, content: bytes) -> None:
        folder = os.path.dirname(path)
        if not os.path.isdir(folder):
            self._make(folder)
        put_in_place(path, content)
        names = os.listdir(folder)
        if len(names) > _MOST:
            with suppress(FileNotFoundError):  # another process tidies up, too
                paths = sorted((os.path.join(folder, name) for name in names), key=os.path.getmtime)
                for old in paths[: len(paths) - _MOST]:
                    os.unlink(old)

    def _make(self, folder: str) -> None:
        """Make a folder for entries, and at first the whole cache: for its user alone, and for no repository."""
        if not os.path.isdir(self._folder):
            os.makedirs(self._folder, 0o700)
            with open(os.path.join(self._folder, ".gitignore"), "w", encoding="ascii") as file:
                file.write("*\n")
        os.makedirs(folder, 0o700, exist_ok=True)


def _users() -> str | None:
    """The folder for the caches of this user's programs, and ours in it."""
    windows = sys.platform == "win32"
    base = os.environ.get("LOCALAPPDATA" if windows else "XDG_CACHE_HOME", "")
    if not os.path.isabs(base):  # the XDG standard says to ignore others
        base = os.path.join(os.path.expanduser("~"), ".cache")
    return os.path.join(base, "sleec-verify") if os.path.isabs(base) else None


def _program() -> str:
    """What tells this program from another one of the same version: the hashes that it was installed with, or, where
    it runs from its sources, when these changed."""
    return ascii([_installed(package) or sorted(_stamps(package)) for package in _packages()])


def _packages() -> list[str]:
    """The folders of the packages that decide. They are two distributions and may lie apart."""
    return [os.path.dirname(os.path.abspath(file)) for file in (sleec_runtime.__file__, sleec_verify.__file__)]


def _installed(package: str) -> str | None:
    """The hash of what the installer recorded of a package."""
    try:
        with open(os.path.join(f"{package}-{__version__}.dist-info", "RECORD"), "rb") as file:
            return sha256(b"".join(line for line in file if line.startswith(b"sleec_"))).hexdigest()
    except OSError:
        return None


def _stamps(package: str) -> list[tuple[str, int, int]]:
    found = []
    folders = [package]
    while folders:
        with suppress(OSError), os.scandir(folders.pop()) as entries:
            for entry in entries:
                if entry.name.endswith(".py"):
                    known = entry.stat()
                    found.append((entry.path, known.st_mtime_ns, known.st_size))
                elif entry.name != "__pycache__" and entry.is_dir():
                    folders.append(entry.path)
    return found


def _head(path: str, body: bytes) -> bytes:
    """The first line of an entry. The key is part of what it vouches for: an entry under another name is none."""
    folder, name = os.path.split(path)
    key = os.path.basename(folder) + name
    return f"{_FORMAT} {sha256(key.encode() + body).hexdigest()}".encode()


# Entries are written as Python writes values, and read without running anything: unlike JSON, that needs no module
# which a check has not imported anyway, and it keeps exact numbers and tuples. There is a line for each check and one
# for each of its findings below it, so that thousands are read one by one: read at once, they take a hundred times
# the memory.


def _encoded(results: tuple[CheckResult, ...]) -> bytes:
    lines: list[object] = []
    for result in results:
        lines.append((result.name, result.seconds, result.reason, len(result.findings)))
        lines += map(_plain, result.findings)
    return "".join(f"{line!a}\n" for line in lines).encode()


def _decoded(body: bytes) -> tuple[CheckResult, ...]:
    from ast import literal_eval

    results = []
    lines = (literal_eval(line.decode("ascii")) for line in body.splitlines())
    for name, seconds, reason, number in lines:
        findings = tuple(_finding(next(lines)) for _ in range(number))
        results.append(CheckResult(name, Refuted(findings) if findings else Proved(), seconds, reason))
    return tuple(results)


def _plain(finding: Finding) -> dict[str, Any]:
    """A finding as tuples, dictionaries and what Python has literals for."""
    assert finding.source is None, "what `check` finds is in the text of the rules"
    fields = {name: value for name, value in vars(finding).items() if name != "source"}
    fields["span"] = tuple(finding.span)
    fields["clauses"] = [tuple(clause) for clause in finding.clauses]
    fields["related"] = [(tuple(span), word) for span, word in finding.related]
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
    fields["related"] = tuple((Span(*span), word) for span, word in fields["related"])
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
