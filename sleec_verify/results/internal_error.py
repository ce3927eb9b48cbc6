"""Internal errors: a failure of sleec-verify itself on one file is an error of that file, and the others go on."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from sleec_runtime.errors import SleecError


class InternalError(SleecError):
    """A failure of sleec-verify itself, not of its input. `path` is the file it worked on, or empty; the cause is the
    exception that it failed with."""

    def __init__(self, path: str, cause: Exception) -> None:
        place = f" in {path}" if path else ""
        super().__init__(
            f"internal error{place}: {type(cause).__name__}: {cause}",
            "this is a fault in sleec-verify, not in your rules; report it with the ruleset and the command. "
            "`sleec-verify --traceback …` shows the place",
        )
        self.path = path
        self.__cause__ = cause


@contextmanager
def internal_errors_of(path: str) -> Iterator[None]:
    """Attribute every internal error to the file at `path`: raises `InternalError` for what is not a `SleecError`.

    A closed output, to which progress is written meanwhile, is not an error of the file.
    """
    try:
        yield
    except (SleecError, BrokenPipeError):
        raise
    except Exception as error:
        raise InternalError(path, error) from error
