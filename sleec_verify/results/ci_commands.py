"""Commands that CI services obey in an output."""

from __future__ import annotations

import re

_COMMAND = re.compile(r"#(?=#[A-Za-z]*\[)|^(?P<indent>[^\S\n]*):(?=:)", re.MULTILINE)
"""``##[command]`` (GitHub, Azure, TeamCity) anywhere, and ``::command::``
(GitHub) where a line begins."""


def without_commands(text: str, escape: str) -> str:
    """`text` in which no service finds a command: its first character is escaped, by `escape` with its code point."""
    return _COMMAND.sub(lambda found: f"{found['indent'] or ''}{escape.format(ord(found[0][-1]))}", text)
