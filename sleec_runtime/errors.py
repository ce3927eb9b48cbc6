"""The errors that a user can cause. Each says what is wrong and what to do; none needs a traceback."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Source, Span


class SleecError(Exception):
    """Base of every error that a user of sleec can cause.

    `message` says what is wrong, `hint` what to do about it (or None).
    """

    def __init__(self, message: str, hint: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message} ({self.hint})" if self.hint else self.message


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong with a text of rules: where, what, and what to try."""

    message: str
    span: Span
    hint: str | None = None


class LanguageError(SleecError):
    """A text that is not a ruleset. It holds every problem that was found, in the order of the text."""

    def __init__(self, source: Source, problems: Sequence[Problem]) -> None:
        self.source = source
        self.problems = tuple(problems)
        super().__init__("\n".join(self._lines()))

    def _lines(self) -> list[str]:
        lines = []
        for problem in self.problems:
            place = self.source.place(problem.span)
            hint = f" ({problem.hint})" if problem.hint else ""
            lines.append(f"{self.source.path}:{place.line}:{place.column}: {problem.message}{hint}")
        return lines


class UnreadableFile(SleecError):
    """A file that cannot be read as text: missing, forbidden, not UTF-8, or holding a NUL byte."""
