"""The command ``sleec-verify``.

Exit codes: 0 no findings at or above ``--fail-level``; 1 findings at or above ``--fail-level``; 2 invalid input or
usage; 3 a check was inconclusive; 130 interrupted by Ctrl-C; 141 the reader closed the output, for example ``| head``.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from io import TextIOWrapper
from typing import TYPE_CHECKING, NoReturn, TextIO

if TYPE_CHECKING:
    from click.exceptions import ClickException

INTERRUPTED = 130
BROKEN_PIPE = 141
COMPLETION = "_SLEEC_VERIFY_COMPLETE"


def main() -> NoReturn:
    """Run the command line and exit. Errors of the user and closed pipes show no traceback."""
    # Collect more rarely than by default, which would be 5 % of a short run, but before garbage fills the memory: each
    # change that a search of repairs tries makes solvers and questions.
    gc.set_threshold(10_000, 10, 10)
    for stream in (sys.stdout, sys.stderr):
        # The encoding of the terminal may not contain all characters of the output.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        code = run(sys.argv[1:])
    except KeyboardInterrupt:  # before there was anything to interrupt
        code = INTERRUPTED
    # Exit without freeing memory: for 100,000 rules that would take time.
    os._exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run the command line with these arguments, and return the exit code."""
    from sleec_verify.cli import exits

    # A program may be started without one of its streams: Python then has None in its place.
    for stream, name, other in ((sys.stdout, "output", sys.stderr), (sys.stderr, "error", sys.stdout)):
        if stream is None:
            _tell(f"error: standard {name} is closed", other)
            return exits.UNUSABLE
    try:
        code = _told(arguments)
        sys.stdout.flush()
        sys.stderr.flush()
    except BrokenPipeError:
        code = BROKEN_PIPE  # whoever read this has seen enough
    except OSError as error:
        _tell(f"the output cannot be written: {error.strerror}")
        code = exits.UNUSABLE
    return code


def _told(arguments: Sequence[str]) -> int:
    """Run the command line and report errors. Raises only OSError, if a report cannot be written."""
    from click.exceptions import Abort, ClickException

    from sleec_verify.cli import output

    output.tracebacks = "--traceback" in arguments
    try:
        return _invoke(list(arguments))
    except ClickException as error:
        _show(error)
        return int(error.exit_code)
    except (KeyboardInterrupt, Abort):
        print(file=sys.stderr)  # ends the line in which a terminal shows ^C
        return INTERRUPTED
    except OSError:
        raise
    except Exception as error:  # noqa: BLE001
        return _failed(error)


def _invoke(arguments: list[str]) -> int:
    """Do the same as the main function of click, except for a closed pipe: there, click exits with 1, which means
    findings."""
    from click.exceptions import Exit

    from sleec_verify.cli.commands import sleec_verify

    if COMPLETION in os.environ:  # a shell asks how a command line may go on
        return int(sleec_verify.main(arguments, prog_name="sleec-verify", standalone_mode=False) or 0)
    try:
        with sleec_verify.make_context("sleec-verify", arguments) as context:
            return int(sleec_verify.invoke(context) or 0)
    except Exit as error:  # after --help and --version
        return error.exit_code


def _show(error: ClickException) -> None:
    """Show a click error in one line, with the arguments escaped. Click itself shows a missing parameter."""
    from click.exceptions import ClickException, MissingParameter, UsageError

    from sleec_verify.report.escape import as_line

    if isinstance(error, MissingParameter):
        error.show()
        return
    message = as_line(error.format_message())
    shown = UsageError(message, error.ctx) if isinstance(error, UsageError) else ClickException(message)
    shown.show()


def _failed(error: Exception) -> int:
    from sleec_runtime.errors import SleecError
    from sleec_verify.cli import exits
    from sleec_verify.cli.output import complain

    if not isinstance(error, SleecError):
        from sleec_verify.results.internal_error import InternalError

        error = InternalError("", error)
    complain(error)
    from sleec_verify.encoding.solver import Undecided

    return exits.UNKNOWN if isinstance(error, Undecided) else exits.UNUSABLE


def _tell(message: str, stream: TextIO | None = None) -> None:
    """Write a message. If it cannot be written, do nothing: the exit code still reports the error."""
    with suppress(OSError):
        print(message, file=stream or sys.stderr, flush=True)
