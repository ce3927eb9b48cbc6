"""Splits a text in the DSL into tokens."""

from __future__ import annotations

import re
from array import array

from sleec_runtime.language.common.comments import RawComment, attach_comments
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.dsl.blank_lines import keep_blank_lines
from sleec_runtime.language.dsl.keywords import (
    BLOCK_MARKS,
    BLOCKS,
    EFFECTS,
    EVENT_RELATIONS,
    KEYWORDS,
    LINE_STARTS,
    STATEMENTS,
    UNFINISHED,
    UNNAMED,
)

_TOKEN = re.compile(
    r"\s+|//[^\n]*|/\*(?s:.*?)\*/|[^\W\d]\w*|[0-9]+(?:\.[0-9]+)?(?!\w)|\d\w*"
    r"|->|<=|>=|<>|!=|==|=<|=>|&&|\|\||/\*|\S"
)
_MARKS = {
    **{word: word for word in KEYWORDS},
    **dict.fromkeys(["<", "<=", ">", ">=", "=", "==", "!=", "<>", "\u2264", "\u2265", "\u2260"], "operator"),
    **{mark: mark for mark in ("(", ")", "{", "}", "[", "]", ",", ":", "->", "-", "+", "*", "/*")},
}


def scan(text: str) -> Tokens:
    """The tokens of `text`, in time linear in its length. The parser reports what is wrong.

    A name before ``when`` or ``exists`` is a ``label``, unless it belongs to what is before it; without a label, the
    ``when`` is `UNNAMED`. The first token of a relation is a ``relation``.
    """
    kinds: list[str] = []
    starts = array("q")
    ends = array("q")
    raw_comments: list[RawComment] = []
    for match in _TOKEN.finditer(text):
        token = match[0]
        kind = _MARKS.get(token)
        if kind is None:
            first = token[0]
            if first.isspace():
                continue
            if first == "/" and len(token) > 1:
                raw_comments += _raw_comments(token, match.start(), len(kinds))
                continue
            kind = _kind(token, first)
        elif kind in ("when", "exists"):
            kind = _mark_label(kind, text, match.start(), kinds, starts, ends)
        kinds.append(kind)
        starts.append(match.start())
        ends.append(match.end())
    for _ in range(3):
        kinds.append("end")
        starts.append(len(text))
        ends.append(len(text))
    _mark_relations(text, kinds, starts, ends)
    comments, closing = attach_comments(raw_comments, text, kinds, starts, ends, LINE_STARTS, BLOCK_MARKS, BLOCKS)
    keep_blank_lines(text, kinds, starts, ends, comments, STATEMENTS, BLOCK_MARKS)
    return Tokens(text, kinds, starts, ends, comments, closing)


def _mark_label(kind: str, text: str, start: int, kinds: list[str], starts: array[int], ends: array[int]) -> str:
    """Marks the label before the ``when`` or ``exists`` that begins at `start`; the kind of that token itself."""
    before = kinds[-1] if kinds else "end"
    colon = before == ":"
    at = len(kinds) - (2 if colon else 1)
    if at >= 0 and kinds[at] == "word" and not _ends_response(at, text, start, kinds, starts, ends):
        kinds[at] = "label"
        return kind
    begins_line = "\n" in text[ends[-1] : start] if kinds else True
    begins_rule = before in BLOCK_MARKS or before == "word" or begins_line
    return UNNAMED if begins_rule and before not in ("(", "meanwhile", "when", "exists", UNNAMED) else kind


def _ends_response(at: int, text: str, start: int, kinds: list[str], starts: array[int], ends: array[int]) -> bool:
    """Whether the name in token `at`, before a ``when`` that begins at `start`, belongs to what is before it, such as
    an event after ``then`` or a unit after a number. A name at the start of the line of ``when`` is always a label.
    """
    if at == 0:
        return False
    before = kinds[at - 1]
    unit = before in ("number", "word", "}", ")", "]") and text[starts[at] : ends[at]] in UNITS
    if before not in UNFINISHED and not unit:
        return False
    return "\n" not in text[ends[at - 1] : starts[at]] or "\n" in text[ends[at] : start]


def _kind(token: str, first: str) -> str:
    if first.isalpha() or first == "_":
        return "word"
    if first.isdecimal():
        return "number" if token.isascii() and token.replace(".", "").isdecimal() else "digits"
    return "strange"


def _raw_comments(comment: str, start: int, token: int) -> list[RawComment]:
    """A comment to the end of the line, or the lines of a comment between ``/*`` and ``*/`` that are not empty."""
    if comment.startswith("//"):
        return [RawComment(start, start + len(comment), token)]
    found = []
    at = start + 2
    for line in comment[2:-2].split("\n"):
        said = line.strip().strip("*").strip()
        if said:
            begin = at + line.index(said)
            found.append(RawComment(begin, begin + len(said), token))
        at += len(line) + 1
    return found


def _mark_relations(text: str, kinds: list[str], starts: array[int], ends: array[int]) -> None:
    """Marks the first token of each relation. Its keywords are keywords only in a block of relations."""
    try:
        at = kinds.index("relation_start")
    except ValueError:
        return
    inside = False
    for token in range(at, len(kinds)):
        kind = kinds[token]
        if kind in BLOCK_MARKS:
            inside = kind == "relation_start"
        elif inside:
            if kind == "label":
                kinds[token] = kind = "word"
            elif kind == UNNAMED:
                kinds[token] = kind = text[starts[token] : ends[token]]
            of_measures = kinds[token - 1] == "relation" and text[starts[token - 1] : ends[token - 1]] == "measure"
            if kind in ("when", "measure") or (
                kind == "word" and not of_measures and text[starts[token] : ends[token]] in EVENT_RELATIONS | EFFECTS
            ):
                kinds[token] = "relation"
