"""Colours for terminals."""

from __future__ import annotations

import os
from typing import TextIO

from sleec_verify.wording.sentence import joined
from sleec_verify.wording.translation import Language

_CODES = {
    "error": "1;31",
    "warning": "1;33",
    "note": "1;36",
    "unknown": "1;35",
    "good": "32",
    "strong": "1",
    "faint": "2",
    "help": "36",
}


_MARK = os.urandom(8).hex()
"""A placeholder for the start of a colour until the line is escaped. It is random, so no user text contains it."""


def painted(line: str) -> str:
    """`line` with terminal colours in place of the placeholders."""
    return line.replace(_MARK, "\033[") if _MARK in line else line


class Palette:
    """Colours words by their role, or leaves them plain."""

    def __init__(self, coloured: bool, language: Language = "en") -> None:
        """`language` is the language of the text that is shown."""
        self._coloured = coloured
        self.language = language

    @classmethod
    def of(cls, stream: TextIO, language: Language = "en") -> Palette:
        """Colours if `stream` is a terminal that can show them. NO_COLOR (https://no-color.org) switches them off, and
        FORCE_COLOR (https://force-color.org) switches them on for every stream."""
        if os.environ.get("NO_COLOR"):
            return cls(False, language)
        shows = os.environ.get("TERM") != "dumb" and stream.isatty()
        return cls(shows or bool(os.environ.get("FORCE_COLOR")), language)

    def __call__(self, role: str, text: str) -> str:
        """`text` in the colour of `role` (a severity, or good, strong, faint, help, unknown), for `painted`."""
        return joined("", [f"{_MARK}{_CODES[role]}m", text, f"{_MARK}0m"]) if self._coloured and text else text


PLAIN = Palette(coloured=False)
