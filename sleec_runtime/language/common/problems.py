"""Wording and number of the problems that a parser reports."""

from __future__ import annotations

from sleec_runtime.errors import Problem

MAX_PROBLEMS = 100
"""The number of problems that are shown of one text. Of the others, only their number is shown."""


def first_problems(problems: list[Problem]) -> list[Problem]:
    """The first problems in the order of the text, and how many more there are."""
    problems.sort(key=lambda problem: problem.span)
    more = len(problems) - MAX_PROBLEMS
    if more > 0:
        span = problems[MAX_PROBLEMS].span
        problems[MAX_PROBLEMS:] = [Problem(f"and {more:,} more problems", span, "fix the first ones and try again")]
    return problems


def quoted(text: str) -> str:
    """`text` on one line, cut short, for a message."""
    text = " ".join(text[:200].split())
    return f"`{text[:37]}...`" if len(text) > 40 else f"`{text}`"
