"""Splits a text into tokens with one regular expression.

Tokens are made one block of lines at a time, so that a text of 100,000 rules needs little memory and most of the
work is done inside Python's own loops.
"""

from __future__ import annotations

import re
from array import array
from itertools import accumulate, compress
from operator import sub

from sleec_runtime.language.common.comments import RawComment, attach_comments
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.english.keywords import (
    CLAIMS,
    IN_WHICH_CASE,
    KEYWORDS,
    LINE_STARTS,
    OCCASION,
    PHRASE,
    SETTINGS,
)

_BLOCK = 1 << 16

# Combining marks (separate accents; Hebrew, Arabic, Indic and Thai vowels), which \w does not match.
_MARKS = "\u0300-\u036f\u0591-\u05bd\u064b-\u065f\u0900-\u0963\u0966-\u0dff\u0e31-\u0eff"
_REST = rf"[\w{_MARKS}'\u2019-]"

# Every match begins where the previous one ended, spaces first, so that offsets are sums of lengths.
_TOKEN = re.compile(
    r"\s*(?:"
    rf"IN\s+WHICH\s+CASE(?!{_REST})"
    rf"|[^\W\d]{_REST}*(?:\.\w[\w.{_MARKS}'\u2019-]*)?"
    r"|[(),.]|:(?!=)"
    r"|<=|>=|<>|!=|==|=(?![<>])|[<>\u2264\u2265\u2260]"
    rf"|-?[0-9]+(?:\.[0-9]+)?(?!{_REST}|\.[0-9])"
    r"|(?://|\#)[^\n]*"
    rf"|\d{_REST}*"
    r"|&&|\|\||=[<>]|-+>|:=|\S"
    r")|\s+"
)
_NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]+)?")


class _Kinds(dict[str, str]):
    """The kind of each token by its text: keywords and marks are entries, other kinds depend on the first character."""

    def __missing__(self, token: str) -> str:
        first = token[:1]
        if not first.isdecimal() and (first.isalnum() or first == "_"):
            if "." in token:
                return "dotted"
            return IN_WHICH_CASE if token.startswith("IN") and token[2:3].isspace() else "word"
        if first == "#" or token.startswith("//"):
            return "comment"
        if _NUMBER.fullmatch(token):
            return "number"
        return "digits" if first.isdecimal() else "strange"


_KINDS = _Kinds(
    {
        **{word: word for word in KEYWORDS},
        **dict.fromkeys(["<", "<=", ">", ">=", "=", "==", "!=", "<>", "≤", "≥", "≠"], "operator"),
        **{mark: mark for mark in "(),:."},
        IN_WHICH_CASE: IN_WHICH_CASE,
        "": "blank",
    }
)


def scan(text: str) -> Tokens:
    """The tokens of `text`, in time linear in its length. The parser reports what is wrong."""
    kinds: list[str] = []
    starts = array("q")
    ends = array("q")
    raw_comments: list[RawComment] = []
    at = 0
    while at < len(text):
        # No token contains a line break; an IN WHICH CASE on two lines is three tokens.
        stop = text.find("\n", at + _BLOCK) + 1 or len(text)
        pieces = _TOKEN.findall(text, at, stop)
        tokens = list(map(str.lstrip, pieces))
        new_kinds = list(map(_KINDS.__getitem__, tokens))
        new_ends = array("q", accumulate(map(len, pieces), initial=at))[1:]
        new_starts = array("q", map(sub, new_ends, map(len, tokens)))
        if new_kinds[-1] == "blank":
            new_kinds.pop()
            new_starts.pop()
            new_ends.pop()
        if "comment" in new_kinds:
            keep = [kind != "comment" for kind in new_kinds]
            token = len(kinds)
            for kept, start, end in zip(keep, new_starts, new_ends):
                token += kept
                if not kept:
                    raw_comments.append(RawComment(start, end, token))
            new_kinds = list(compress(new_kinds, keep))
            new_starts = array("q", compress(new_starts, keep))
            new_ends = array("q", compress(new_ends, keep))
        kinds += new_kinds
        starts += new_starts
        ends += new_ends
        at = stop
    for _ in range(3):
        kinds.append("end")
        starts.append(len(text))
        ends.append(len(text))
    _mark_occasions(kinds)
    _mark_inside_sentences(text, kinds, starts, ends)
    comments, closing = attach_comments(raw_comments, text, kinds, starts, ends, LINE_STARTS, SETTINGS)
    return Tokens(text, kinds, starts, ends, comments, closing)


def _mark_occasions(kinds: list[str]) -> None:
    """Marks each WHEN in a concern, purpose or relation. The ALWAYS of a relation starts no statement."""
    for keyword in (*CLAIMS, "RELATION", "MEANWHILE"):
        at = -1
        for _ in range(kinds.count(keyword)):
            at = kinds.index(keyword, at + 1)
            behind = at + 1
            while keyword in CLAIMS and (kinds[behind] in PHRASE or kinds[behind] == "dotted"):
                behind += 1
            if keyword == "MEANWHILE" and kinds[behind] == "(":
                behind += 1
            if kinds[behind] in ("WHEN", "IF"):
                kinds[behind] = OCCASION
            elif keyword == "RELATION" and kinds[behind] == "ALWAYS":
                kinds[behind] = "word"


def _mark_inside_sentences(text: str, kinds: list[str], starts: array[int], ends: array[int]) -> None:
    """Marks each NEVER and ALWAYS that would divide a sentence in two, as in ``the robot NEVER leaves``: those that
    follow a plain word, a phrase or a parenthesis in the same line."""
    for keyword in ("NEVER", "ALWAYS"):
        at = -1
        for _ in range(kinds.count(keyword)):
            at = kinds.index(keyword, at + 1)
            if at == 0 or "\n" in text[ends[at - 1] : starts[at]]:
                continue
            before = kinds[at - 1]
            is_phrase = before in PHRASE and kinds[at - 2] in PHRASE
            if is_phrase or before == ")" or (before == "word" and _is_plain(text[starts[at - 1] : ends[at - 1]])):
                kinds[at] = "strange"


def _is_plain(word: str) -> bool:
    """Whether this is a plain word, and no name such as `OpenCurtains`, `open_curtains` or `B`."""
    return "_" not in word and (word.islower() or word[1:].islower())
