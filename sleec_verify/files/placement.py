"""Writing files atomically."""

from __future__ import annotations

import os
from collections.abc import Iterable

import click

from sleec_runtime.errors import SleecError
from sleec_verify.files.temporary import put_in_place


def write_whole(path: str, content: bytes) -> None:
    """Replace the content of the file by `content`, atomically: readers see the old or the new content, and an error
    keeps the old one. A link stays a link, and the permissions do not change. Content for anything but a regular file
    is written to it directly.

    Raises:
        SleecError: the file cannot be written.
    """
    target = os.path.realpath(path)
    try:
        if os.path.exists(path) and not os.path.isfile(path):  # a terminal, a pipe, /dev/null
            with open(path, "wb") as stream:
                stream.write(content)
        else:
            put_in_place(target, content)
    except OSError as error:
        raise SleecError(f"{path} cannot be written: {error.strerror}", "the file was not changed") from None


def write_new(path: str, content: bytes) -> None:
    """Create a file with `content`, atomically.

    Raises:
        SleecError: it cannot be written, or exists, even if it was created after the caller's own check.
    """
    try:
        put_in_place(path, content, new=True)
    except OSError as error:
        raise SleecError(f"{path} cannot be written: {error.strerror}") from None


def require_writable(output: str, inputs: Iterable[str]) -> None:
    """Reject an output path before any work is done for it, if it is also an input, or a folder.

    Raises:
        click.UsageError: with advice.
    """
    if os.path.isdir(output):
        raise click.UsageError(f"{output} is a folder; name a file")
    folder = os.path.dirname(output) or "."
    if not os.path.isdir(folder):
        raise click.UsageError(f"the folder {folder} for {os.path.basename(output)} does not exist")
    for path in inputs:
        if os.path.exists(output) and os.path.exists(path) and os.path.samefile(output, path):
            raise click.UsageError(f"{output} is an input; name another file for the output")
