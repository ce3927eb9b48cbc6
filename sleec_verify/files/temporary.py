"""Temporary files and folders that are always removed, even after Ctrl-C."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

_T = TypeVar("_T")


def with_temporary(beside: str, use: Callable[[str], _T]) -> _T:
    """The result of `use`, which gets a new path in the folder of `beside` for a file or folder. Whatever exists at
    that path at the end is removed."""
    # Know the path before creating anything, so that the clean-up always covers it.
    path = os.path.join(os.path.dirname(beside), f".sleec-{os.urandom(8).hex()}.tmp")
    try:
        try:
            return use(path)
        finally:
            _remove(path)
    finally:  # if Ctrl-C interrupted the first removal
        _remove(path)


def put_in_place(target: str, content: bytes, new: bool = False, private: bool = False) -> None:
    """Replace the content of the file at `target` by `content`, atomically, with the permissions of the existing file.
    A `new` file replaces nothing. A `private` file can be read by its owner only.

    Raises:
        OSError: it cannot be written, and is unchanged. FileExistsError if a `new` file already exists.
    """

    def use(path: str) -> None:
        with open(path, "xb", opener=_open_private if private else None) as file:
            file.write(content)
        if new:
            _link(path, target)
            return
        if os.path.isfile(target) and not private:
            os.chmod(path, stat.S_IMODE(os.stat(target).st_mode))
        os.replace(path, target)

    with_temporary(target, use)


def _open_private(path: str, flags: int) -> int:
    return os.open(path, flags, 0o600)


def _link(path: str, target: str) -> None:
    try:
        os.link(path, target)
    except FileExistsError:
        raise
    except OSError:  # a file system without links
        if os.path.lexists(target):
            raise
        os.rename(path, target)


def _remove(path: str) -> None:
    # shutil.rmtree turns an interruption into an OSError.
    for parent, folders, files in os.walk(path, topdown=False):
        with suppress(OSError):
            for name in files:
                os.unlink(os.path.join(parent, name))
            for name in folders:
                os.rmdir(os.path.join(parent, name))
    with suppress(OSError):
        os.rmdir(path) if os.path.isdir(path) else os.unlink(path)
