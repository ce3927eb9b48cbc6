"""What holds of every input: a result or a typed error, soon."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

from sleec_runtime.errors import LanguageError, SleecError

if TYPE_CHECKING:
    from types import FrameType

MAX_CPU_SECONDS = 5.0
"""For one input. The slowest in the corpus takes a tenth of it."""

_Result = TypeVar("_Result")


class TooSlow(BaseException):
    """An input took longer than `MAX_CPU_SECONDS`. No handler of the code under test catches it."""


@contextmanager
def cpu_limit(seconds: float = MAX_CPU_SECONDS) -> Iterator[None]:
    """Raises TooSlow where the code within has used this much CPU time, so that a busy machine makes no difference."""

    def stop(signal_number: int, frame: FrameType | None) -> None:
        raise TooSlow(f"more than {seconds:g} seconds of CPU time")

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def unless_refused(read: Callable[..., _Result], *arguments: object) -> _Result | None:
    """What `read` gives, or None where it raises a typed error. Any other exception is a failure."""
    try:
        return read(*arguments)
    except SleecError as error:
        check_error(error)
        return None


def check_error(error: SleecError) -> None:
    """A user can work with the error: it says something, and every place that it names is in the text."""
    assert error.message.strip()
    assert error.hint is None or error.hint.strip()
    if isinstance(error, LanguageError):
        assert error.problems
        for problem in error.problems:
            assert problem.message.strip()
            assert len(problem.message) < 1000
            assert 0 <= problem.span.start <= problem.span.end <= len(error.source.text)
