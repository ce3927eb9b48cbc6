"""A cache of check results, by everything on which they depend.

An entry is a file whose name is a hash of the bytes of the rules, how they are read, what is asked, and the program
itself. It also holds a hash of its content. An entry that does not match is recomputed. Inconclusive results are not
stored, because another run may decide them.

Entries are trusted like the program, so they belong in a folder that only their user can write to. The default is the
user's cache folder, never the project's, where a pull request could add results of its own.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cached_property
from hashlib import sha256
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError
from sleec_verify import __version__
from sleec_verify.cli.cache import entry
from sleec_verify.cli.cache.program import program_identity
from sleec_verify.files.temporary import put_in_place
from sleec_verify.results.finding import CheckResult, Unknown

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.encoding.scope import Scope

VARIABLE = "SLEEC_VERIFY_CACHE"
OFF = "off"
MOST_ENTRIES = 64
"""Entries in one of the 256 folders; of more, the oldest are deleted."""


class Cache:
    """Results in a folder. `tell` reports problems."""

    def __init__(self, folder: str, tell: Callable[[str], None], chosen: bool = True) -> None:
        self._folder = folder
        self._tell = tell
        self._chosen = chosen

    @cached_property
    def _program(self) -> str:
        return program_identity()

    @classmethod
    def of_environment(cls, tell: Callable[[str], None]) -> Cache | None:
        """The cache in the folder that SLEEC_VERIFY_CACHE names, or in the user's cache folder; None if it is ``off``,
        or there is no such folder.

        Raises:
            SleecError: SLEEC_VERIFY_CACHE is not a folder.
        """
        named = os.environ.get(VARIABLE, "")
        if named == OFF:
            return None
        if named and os.path.lexists(named) and not os.path.isdir(named):
            raise SleecError(f"{VARIABLE} is {named}, which is not a folder", f"name a folder, or set {VARIABLE}={OFF}")
        folder = named or _users()
        return None if folder is None else cls(folder, tell, chosen=bool(named))

    def kept(self, ruleset: Ruleset, scope: Scope) -> tuple[CheckResult, ...] | None:
        """The results for a ruleset, if they are kept. O(their size)."""
        path = self.path(ruleset, scope)
        # What is no file is no entry, and reading it might never end.
        if path is None or not os.path.isfile(path):
            return None
        try:
            with open(path, "rb") as file:
                head, _, body = file.read().partition(b"\n")
        except OSError:
            return None
        if head == entry.head(path, body):
            with suppress(Exception):  # what a decoder may raise at what it does not expect is of every kind
                return entry.decode(body)
        self._tell(f"the cache entry {path} is damaged; its results are recomputed")
        return None

    def keep(self, ruleset: Ruleset, scope: Scope, results: tuple[CheckResult, ...]) -> None:
        """Store the results for a ruleset, unless one of them is unknown. A failure to store them is ignored."""
        path = self.path(ruleset, scope)
        if path is None or any(isinstance(result.verdict, Unknown) for result in results):
            return
        body = entry.encode(results)
        try:
            self._put(path, entry.head(path, body) + b"\n" + body)
        except OSError as error:
            if self._chosen:
                self._tell(f"the cache folder {self._folder} cannot be written: {error.strerror}")

    def path(self, ruleset: Ruleset, scope: Scope) -> str | None:
        """Where the results for a ruleset are kept. None for one that was made without a text."""
        text = ruleset.source.sha256
        if text is None:
            return None
        asked = (scope.domain, scope.untimed, scope.chains)
        read = (ruleset.syntax, ruleset.dialect, ruleset.reading)
        key = sha256(ascii((entry.FORMAT, __version__, self._program, text, read, asked)).encode()).hexdigest()
        return os.path.join(self._folder, key[:2], key[2:])

    def _put(self, path: str, content: bytes) -> None:
        folder = os.path.dirname(path)
        if not os.path.isdir(folder):
            self._make(folder)
        put_in_place(path, content)
        names = os.listdir(folder)
        if len(names) > MOST_ENTRIES:
            with suppress(FileNotFoundError):  # another process tidies up, too
                paths = sorted((os.path.join(folder, name) for name in names), key=os.path.getmtime)
                for old in paths[: len(paths) - MOST_ENTRIES]:
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
