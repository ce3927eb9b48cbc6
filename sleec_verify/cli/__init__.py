"""The command ``sleec-verify``.

Exit codes: 0 all holds; 1 findings at or above ``--fail-level``; 2 unusable input or usage; 3 some verdict is unknown.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from io import TextIOWrapper
from typing import NoReturn

INTERRUPTED = 130
BROKEN_PIPE = 141


def main() -> NoReturn:
    """Run the command line and exit. No error of a user's, and no closed pipe, shows a traceback."""
    # Almost all that a run makes lives until its end; looking for garbage in it is 5 % of a short run.
    gc.set_threshold(100_000, 50, 50)
    for stream in (sys.stdout, sys.stderr):
        # A file's name, or a terminal, may be of an encoding that cannot say what is to be written.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        code = run(sys.argv[1:])
    except KeyboardInterrupt:  # before there was anything to interrupt
        code = INTERRUPTED
    # Nothing is left to do, and taking 100,000 rules apart one by one before the end would take its time.
    os._exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run the command line with these arguments; the exit code."""
    from click.exceptions import Abort, ClickException

    from sleec_verify.cli import exits
    from sleec_verify.cli.commands import sleec_verify

    try:
        code = sleec_verify.main(list(arguments), prog_name="sleec-verify", standalone_mode=False) or 0
        sys.stdout.flush()
    except ClickException as error:
        error.show()
        code = error.exit_code
    except (KeyboardInterrupt, Abort):
        code = INTERRUPTED
    except BrokenPipeError:
        code = BROKEN_PIPE  # whoever read this has seen enough
    except OSError as error:
        _tell(f"the output cannot be written: {error.strerror}")
        code = exits.UNUSABLE
    except Exception as error:  # noqa: BLE001
        code = _unexpected(error, "--traceback" in arguments)
    return int(code)


def _unexpected(error: Exception, traceback: bool) -> int:
    from sleec_runtime.errors import SleecError
    from sleec_verify.cli import exits

    if traceback:
        from traceback import print_exc

        print_exc()
    elif isinstance(error, SleecError):
        from sleec_verify.cli.output import complain
        from sleec_verify.solver import Undecided

        complain(error)
        if isinstance(error, Undecided):
            return exits.UNKNOWN
    else:
        _tell(
            f"sleec-verify failed: {type(error).__name__}: {error}\n"
            "This is a mistake in sleec-verify, not in your rules. Please report it with the ruleset and the command;\n"
            "`sleec-verify --traceback …` shows where it happened."
        )
    return exits.UNUSABLE


def _tell(message: str) -> None:
    print(message, file=sys.stderr, flush=True)
