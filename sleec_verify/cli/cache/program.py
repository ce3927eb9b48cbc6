"""The identity of the installed program, for the keys of the cache."""

from __future__ import annotations

import os
from contextlib import suppress
from hashlib import sha256

import sleec_runtime
import sleec_verify
from sleec_verify import __version__


def program_identity() -> str:
    """The hashes of the installed files. If the program runs from its sources, their times of change and sizes."""
    return ascii([_installed(package) or sorted(_stamps(package)) for package in _packages()])


def _packages() -> list[str]:
    """The folders of both packages. They are two distributions, and may be in different places."""
    return [os.path.dirname(os.path.abspath(file)) for file in (sleec_runtime.__file__, sleec_verify.__file__)]


def _installed(package: str) -> str | None:
    """The hash of the record of an installed package. None if it was not installed."""
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
