"""A progress bar for checks that take long, on a terminal."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING

from sleec_runtime.support.messages import escaped

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

PATIENCE = 1.0
"""Seconds before a bar is shown. Shorter runs do not import it."""


class Progress:
    """Shows the progress of the checks, if standard error is a terminal."""

    def __init__(self) -> None:
        self._started = time.monotonic()
        self._silent = not sys.stderr.isatty()
        self._bar: Bar | None = None

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self._bar is not None:
            self._bar.stop()

    def on(self, path: str) -> Callable[[str, int, int], None] | None:
        """What the checks of `path` report to: the check at work, how many are done, and of how many."""
        if self._silent:
            return None

        def report(check: str, done: int, total: int) -> None:
            if self._bar is None:
                if time.monotonic() - self._started < PATIENCE:
                    return
                self._bar = _bar()
            self._bar.update(
                self._bar.task_ids[0], description=escaped(f"{path}: {check}"), completed=done, total=total
            )

        return report


def _bar() -> Bar:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn
    from rich.progress import Progress as Bar

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn())
    bar = Bar(*columns, console=Console(stderr=True), transient=True)
    bar.add_task("")
    bar.start()
    return bar
