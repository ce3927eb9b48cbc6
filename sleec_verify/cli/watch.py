"""``sleec-verify check --watch``: check again after each change of a file."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Sequence

import click

from sleec_runtime.errors import SleecError
from sleec_verify.cli import exits
from sleec_verify.cli.inputs import files
from sleec_verify.cli.output import complain, tell
from sleec_verify.report.outcome import UnusableInput

PAUSE = 0.3
"""Seconds between two polls of the modification times and sizes of the files."""

CLEAR = "\033[2J\033[3J\033[H"


def watch(paths: Sequence[str], once: Callable[[], int]) -> int:
    """Call `once`, and again after each change, creation or deletion of a file of `paths`, until Ctrl-C.

    Errors of the input are shown, and do not end the loop.
    """
    if "-" in paths:
        raise click.UsageError("standard input cannot be watched; name files or folders")
    seen = None
    try:
        while True:
            # Taken before the check, so that changes during the check start another one.
            now = _state(paths)
            if now != seen:
                seen = now
                _tell(once)
            time.sleep(PAUSE)
    except KeyboardInterrupt:
        print(file=sys.stderr)  # ends the line in which a terminal shows ^C
        return exits.HOLDS


def _tell(once: Callable[[], int]) -> None:
    if sys.stdout.isatty():
        sys.stdout.write(CLEAR)
    try:
        once()
    except SleecError as error:
        complain(error)
    tell(f"{time.strftime('%H:%M:%S')}, waiting for changes; press Ctrl-C to stop")


def _state(paths: Sequence[str]) -> list[tuple[object, ...]]:
    """The data that show whether a file has changed."""
    return [
        (path.path, "unusable") if isinstance(path, UnusableInput) else (path, *_stamp(path)) for path in files(paths)
    ]


def _stamp(path: str) -> tuple[object, ...]:
    try:
        known = os.stat(path)
    except OSError as error:
        return (error.errno,)
    return known.st_mtime_ns, known.st_size, known.st_ino
