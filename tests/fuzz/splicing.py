"""Changing an input word by word: a change of single bytes seldom leaves a text that parses."""

from __future__ import annotations

import re
from collections.abc import Iterable
from random import Random

_TOKENS = re.compile(rb"\s+|\w+|[^\w\s]")


class Splicer:
    """Takes words out of an input, and puts in `words`, or stretches of `inputs`."""

    def __init__(self, inputs: Iterable[bytes], words: Iterable[str]) -> None:
        self._inputs = [tokens for tokens in map(_TOKENS.findall, inputs) if tokens]
        self._words = [word.encode() for word in words] or [b" "]

    def splice(self, data: bytes, random: Random) -> bytes:
        """`data` with one stretch of it replaced."""
        tokens = _TOKENS.findall(data)
        start = random.randint(0, len(tokens))
        end = start + random.choice((0, 1, 1, 2, 5, 10))
        return b"".join((*tokens[:start], *self._new(random), *tokens[end:]))

    def _new(self, random: Random) -> list[bytes]:
        kind = random.randrange(4)
        if kind == 0:
            return []
        if kind == 1:
            return [random.choice(self._words)]
        other = random.choice(self._inputs)
        start = random.randrange(len(other))
        return other[start : start + random.choice((1, 2, 5, 20))]
