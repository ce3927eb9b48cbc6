"""Comments as lines of text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.language.common.comments import INNER_GAP


def split_heading(above: Sequence[str], has_settings: bool) -> tuple[Sequence[str], Sequence[str]]:
    """The comments above a statement: those above the DOMAIN or READING line before it, and those below that.

    An empty string is an empty line; the last one divides the two.
    """
    gaps = [n for n, comment in enumerate(above) if not comment.strip() and comment != INNER_GAP]
    if not has_settings or not gaps:
        return (), _without_leading(above)
    return trimmed(above[: gaps[-1]]), _without_leading(above[gaps[-1] + 1 :])


def with_gaps(comments: Sequence[str]) -> list[str]:
    """Comments with one empty line for several, also at the start and at the end."""
    found: list[str] = []
    for comment in comments:
        text = " ".join(comment.splitlines()).strip()
        if text or not found or found[-1]:
            found.append(text)
    return found


def trimmed(comments: Sequence[str]) -> list[str]:
    """Comments without empty lines at the start and at the end."""
    found = _without_leading(comments)
    return found[:-1] if found and not found[-1] else found


def comment_lines(comments: Sequence[str]) -> Iterator[str]:
    """Comments as lines; an empty comment is an empty line."""
    for comment in comments:
        yield _comment(comment) if comment else ""


def with_comment(line: str, comment: str | None) -> str:
    """A line with the comment after it, if there is one."""
    if comment is None:
        return line
    return f"{line}  {_comment(' '.join(comment.splitlines()).strip())}"


def _without_leading(comments: Sequence[str]) -> list[str]:
    found = with_gaps(comments)
    return found[1:] if found and not found[0] else found


def _comment(text: str) -> str:
    return f"// {text}".rstrip()
