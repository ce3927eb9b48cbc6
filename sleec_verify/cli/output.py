"""Write to standard output, standard error, and output files."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_verify.report.outcome import Outcome
    from sleec_verify.wording.translation import Language

tracebacks = False
"""Whether `complain` shows where an error was raised, as ``--traceback`` asks for."""


def report(outcomes: Sequence[Outcome], form: str, output: str | None, language: Language = "en") -> None:
    """Write the outcomes in the format `form`: to standard output, or to the file `output`, with a line on it on
    standard error. Formats for people are in this language.

    Raises:
        SleecError: the file cannot be written; what was there before stays.
    """
    from sleec_verify.report import renderer
    from sleec_verify.report.palette import Palette

    if output is None:
        write(renderer(form)(outcomes, Palette.of(sys.stdout, language)))
        return
    from sleec_verify.files.placement import write_whole
    from sleec_verify.report.outcome import in_short

    write_whole(output, "".join(renderer(form)(outcomes, Palette(False, language))).encode("utf-8", "surrogateescape"))
    tell_written(output, in_short(outcomes), language)


def write(parts: Iterable[str]) -> None:
    """Write the output of a renderer, which is already escaped, to standard output."""
    sys.stdout.writelines(parts)


def write_line(text: str) -> None:
    """Write one line to standard output."""
    from sleec_verify.report.escape import as_line

    print(as_line(text))


def write_data(parts: Iterable[str]) -> None:
    """Write a text for other programs to standard output: in UTF-8 for every locale, with unchanged line breaks.

    File names keep their bytes. On a terminal, control characters are escaped.
    """
    if sys.stdout.isatty():
        from sleec_runtime.support.messages import escaped

        parts = (escaped(part, "\t\r\n") for part in parts)
    sys.stdout.flush()
    sys.stdout.buffer.writelines(part.encode("utf-8", "surrogateescape") for part in parts)


def note(message: str) -> None:
    """Write a note to standard error. It changes neither the output nor the exit code."""
    from sleec_verify.report.palette import Palette

    tell(f"{Palette.of(sys.stderr)('note', 'note')}: {message}")


def tell_written(path: str, what: str, language: Language) -> None:
    """Say in a language what was written to a file or folder."""
    from sleec_verify.wording.sentence import joined
    from sleec_verify.wording.translation import translated

    tell(translated(joined(": ", [path, what]), language))


def tell(line: str) -> None:
    """Write one line to standard error, after all that was written to standard output."""
    from sleec_verify.report.escape import as_line

    sys.stdout.flush()
    print(as_line(line), file=sys.stderr, flush=True)


def note_link(path: str) -> None:
    """Write a note about a link that is not followed."""
    note(f"the link {path} is skipped: its target is not a ruleset below the same folder")


def complain(error: SleecError) -> None:
    """Write an error of the input to standard error, with its places in the text."""
    from sleec_verify.report.full import error_lines
    from sleec_verify.report.palette import Palette

    for line in error_lines(error, Palette.of(sys.stderr)):
        tell(line)
    if tracebacks:
        from traceback import format_exception

        for line in "".join(format_exception(type(error), error, error.__traceback__)).splitlines():
            tell(line)
