"""Writing to the two streams."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError


def write(parts: Iterable[str]) -> None:
    """Write to standard output as is: what people read, and JSON, which is ASCII."""
    sys.stdout.writelines(parts)


def write_data(parts: Iterable[str]) -> None:
    """Write a text for other programs to standard output: in UTF-8 whatever the locale, line breaks as they are.

    Names of files are written with the bytes that they have.
    """
    sys.stdout.flush()
    sys.stdout.buffer.writelines(part.encode("utf-8", "surrogateescape") for part in parts)


def note(message: str) -> None:
    """Tell of what may not be as expected on standard error; it changes neither the output nor the exit code."""
    from sleec_verify.report.palette import Palette

    sys.stdout.flush()
    print(f"{Palette.of(sys.stderr)('note', 'note')}: {message}", file=sys.stderr)


def complain(error: SleecError) -> None:
    """Tell of an error of the input on standard error, with its places in the text."""
    from sleec_verify.report.full import error_lines
    from sleec_verify.report.palette import Palette

    sys.stdout.flush()
    for line in error_lines(error, Palette.of(sys.stderr)):
        print(line, file=sys.stderr)
