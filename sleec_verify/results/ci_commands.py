"""Commands that CI services execute in an output."""

from __future__ import annotations

import re

_COMMAND = re.compile(r"#(?=#[A-Za-z]*\[)|^(?P<indent>[^\S\n]*):(?=:)", re.MULTILINE)
"""``##[command]`` (GitHub, Azure, TeamCity) anywhere, and ``::command::``
(GitHub) at the start of a line."""


def without_commands(text: str, escape: str) -> str:
    """`text` without commands: the first character of each is replaced by `escape`, formatted with its code point."""
    return _COMMAND.sub(lambda found: f"{found['indent'] or ''}{escape.format(ord(found[0][-1]))}", text)
