"""Lines of text with the comments above and behind them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence


def split_heading(above: Sequence[str], has_settings: bool) -> tuple[Sequence[str], Sequence[str]]:
    """The comments above a statement: those above the DOMAIN or READING line before it, and those below that.

    An empty string is an empty line; the last one divides the two.
    """
    above = _without_leading(above)
    if not has_settings or "" not in above:
        return (), above
    gap = len(above) - 1 - above[::-1].index("")
    return above[:gap], above[gap + 1 :]


def _without_leading(comments: Sequence[str]) -> list[str]:
    found: list[str] = []
    for comment in comments:
        text = " ".join(comment.splitlines()).strip()
        if text or (found and found[-1]):
            found.append(text)
    return found


def trimmed(comments: Sequence[str]) -> list[str]:
    """Comments without empty ones at the beginning and at the end."""
    found = _without_leading(comments)
    return found[:-1] if found and not found[-1] else found


def comment_lines(comments: Sequence[str]) -> Iterator[str]:
    """Comments as lines; an empty one is an empty line."""
    for comment in comments:
        yield _comment(comment) if comment else ""


def _comment(text: str) -> str:
    return f"// {text}".rstrip()


def behind(line: str, comment: str | None) -> str:
    """A line with the comment behind it, if there is one."""
    if comment is None:
        return line
    return f"{line}  {_comment(' '.join(comment.splitlines()).strip())}"
