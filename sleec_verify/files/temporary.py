"""Temporary files and folders that are gone at the end, whenever Ctrl-C comes."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

_T = TypeVar("_T")


def with_temporary(beside: str, use: Callable[[str], _T]) -> _T:
    """What `use` returns. It is given a new path in the folder of `beside`, at which it may make a file or a folder;
    what is there at the end is removed."""
    # The path is known before there is anything at it, so that no moment is without the clean-up.
    path = os.path.join(os.path.dirname(beside), f".sleec-{os.urandom(8).hex()}.tmp")
    try:
        try:
            return use(path)
        finally:
            _remove(path)
    finally:  # if Ctrl-C came in the first removal
        _remove(path)


def put_in_place(target: str, content: bytes, new: bool = False) -> None:
    """Make `content` that of the file at `target`, in one step, with the rights that a file there has. A `new` file
    replaces none.

    Raises:
        OSError: it cannot be written, and is as it was. FileExistsError where a `new` file is not new.
    """

    def use(path: str) -> None:
        with open(path, "xb") as file:
            file.write(content)
        if new:
            _link(path, target)
            return
        if os.path.isfile(target):
            os.chmod(path, stat.S_IMODE(os.stat(target).st_mode))
        os.replace(path, target)

    with_temporary(target, use)


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
    # shutil.rmtree makes an OSError of an interruption.
    for parent, folders, files in os.walk(path, topdown=False):
        with suppress(OSError):
            for name in files:
                os.unlink(os.path.join(parent, name))
            for name in folders:
                os.rmdir(os.path.join(parent, name))
    with suppress(OSError):
        os.rmdir(path) if os.path.isdir(path) else os.unlink(path)
