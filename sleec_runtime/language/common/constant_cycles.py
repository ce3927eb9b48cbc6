"""Constants that are defined by each other, so that none of them has a value: how that is said, in either syntax."""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.language.common.problems import quoted


def circular(circle: Sequence[str], keyword: str) -> tuple[str, str]:
    """The message and the hint for constants of which each is defined as the next, and the last one as the first."""
    example = f"as in: {keyword} {circle[0]} = 18"
    if len(circle) == 1:
        return (
            f"the constant {quoted(circle[0])} is defined as itself, so it has no value",
            f"a constant is a number, or another constant that has one; {example}",
        )
    links = [quoted(name) for name in circle]
    if len(links) > 5:
        links[4:] = ["..."]
    written = " = ".join((*links, quoted(circle[0])))
    return (
        f"constants that are defined in a circle, {written}, have no value",
        f"give one of them a number, {example}",
    )
