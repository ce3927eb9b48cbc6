"""Keywords of blocks that are misspelt, in capitals, or of another form: they are read as what is meant."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.keywords import BLOCK_MARKS, BLOCKS, UNFINISHED
from sleec_runtime.support.suggestions import nearest

_MARKS = sorted(BLOCK_MARKS)


def misspelt_marks(text: str, tokens: Tokens) -> Iterator[tuple[int, str]]:
    """The words that stand alone in a line, where a block may begin or end, each with the keyword that it is near."""
    kinds, starts, ends = tokens.kinds, tokens.starts, tokens.ends
    closing: str | None = None
    for token, kind in enumerate(kinds):
        if kind in BLOCKS:
            closing = BLOCKS[kind]
        elif kind in BLOCK_MARKS:
            closing = None
        elif kind == "word" and (token == 0 or kinds[token - 1] not in UNFINISHED):
            before = text[ends[token - 1] : starts[token]] if token else "\n"
            behind = text[ends[token] : starts[token + 1]]
            if "\n" not in before or ("\n" not in behind and kinds[token + 1] != "end"):
                continue
            word = text[starts[token] : ends[token]].lower()
            meant = closing if word == "end" else word if word in BLOCK_MARKS else nearest(word, _MARKS)
            # One opens where none is open, and closes where one is.
            if meant is not None and (meant == closing or (closing is None and meant in BLOCKS)):
                closing = BLOCKS.get(meant)
                yield token, meant
