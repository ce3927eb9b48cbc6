"""Escapes for all text for people: names, paths and reasons in it cannot control the terminal or a CI service.

A renderer for people yields lines without line ends, with the unescaped text of users. `as_text` escapes them.
Renderers for programs use the escapes of their formats.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import wraps
from typing import TypeVar

from sleec_runtime.support.messages import escaped
from sleec_verify.report.palette import Palette, painted
from sleec_verify.results.ci_commands import without_commands
from sleec_verify.wording.translation import Language, translated

_Arguments = TypeVar("_Arguments", bound=Callable[..., Iterator[str]])


def as_line(text: str) -> str:
    """One line of output without its line end: escaped, with the colours of the palette."""
    return painted(without_commands(escaped(text), "\\x{:02x}"))


def as_text(render: _Arguments) -> _Arguments:
    """Turn a renderer of unescaped lines into a renderer of text, in the language of its palette."""

    @wraps(render)
    def text(*arguments: object) -> Iterator[str]:
        language: Language = next((one.language for one in arguments if isinstance(one, Palette)), "en")
        return (f"{as_line(translated(line, language))}\n" for line in render(*arguments))

    return text  # type: ignore[return-value]


def in_one_column(text: str) -> str:
    """`text` with a printable character for each character, so that marks below it are aligned."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else " " if c == "\t" else "\ufffd" for c in text)
