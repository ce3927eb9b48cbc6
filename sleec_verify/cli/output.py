"""Writing to the two streams."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError


def write(parts: Iterable[str]) -> None:
    """Write to standard output as is."""
    sys.stdout.writelines(parts)


def complain(error: SleecError) -> None:
    """Tell of an error of the input on standard error, with its places in the text."""
    from sleec_verify.report.full import error_lines
    from sleec_verify.report.palette import Palette

    sys.stdout.flush()
    for line in error_lines(error, Palette.of(sys.stderr)):
        print(line, file=sys.stderr)
