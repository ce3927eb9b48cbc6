"""Definitions whose keyword is misspelt, or left out, and rules whose `when` is misspelt: what was meant can be told by
the shape of the line.

They are read as what they are meant to be, so that the problem is told once, and nothing else is hidden by it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.keywords import BLOCK_MARKS, DEFINITIONS
from sleec_runtime.language.dsl.slips import means_when
from sleec_runtime.support.suggestions import nearest

_KEYWORDS = sorted(DEFINITIONS)
_MEANT = {
    **dict.fromkeys(("trigger", "action", "obligation", "response", "evt"), "event"),
    **dict.fromkeys(("condition", "variable", "var", "sensor", "state"), "measure"),
    **dict.fromkeys(("const", "let", "define"), "constant"),
}
_TYPES = ("boolean", "numeric", "scale", "bool", "integer", "int", "number")
_ENDINGS = frozenset({"word", "number", ")", "def_start"})
"""The kinds of token behind which a definition can be complete."""


class Misspelt(NamedTuple):
    """A definition that has no right keyword in front."""

    token: int
    """The first of it: what stands for the keyword or, without one, the name."""
    keyword: str
    """What it is read as."""
    has_keyword: bool
    message: str
    hint: str


def misspelt(text: str, tokens: Tokens) -> Iterator[Misspelt]:
    """The definitions in the blocks of definitions that have no right keyword in front, in their order."""
    inside = False
    for token, kind in enumerate(tokens.kinds):
        if kind in BLOCK_MARKS:
            inside = kind == "def_start"
        elif inside and kind == "word" and tokens.kinds[token - 1] in _ENDINGS:
            found = _at(token, text, tokens)
            if found is not None:
                yield found


def misspelt_whens(text: str, tokens: Tokens) -> Iterator[int]:
    """The words between the name of a rule, at the begin of a line, and its event that stand for `when`."""
    kinds = tokens.kinds
    inside = False
    for token, kind in enumerate(kinds):
        if kind in BLOCK_MARKS:
            inside = kind == "rule_start"
        elif inside and kind == "word" and kinds[token + 1] == "word" == kinds[token + 2]:
            line = text[tokens.ends[token - 1] : tokens.starts[token]]
            one_line = "\n" in line and "\n" not in text[tokens.ends[token] : tokens.starts[token + 1]]
            name, word = _text(token, text, tokens), _text(token + 1, text, tokens)
            if one_line and means_when(word) and not means_when(name):
                yield token + 1


def _at(token: int, text: str, tokens: Tokens) -> Misspelt | None:
    word, before = _text(token, text, tokens), _text(token - 1, text, tokens)
    if before == "as":
        return None
    begins_line = "\n" in text[tokens.ends[token - 1] : tokens.starts[token]] or before == "def_start"
    following = tokens.kinds[token + 1]
    if following != "word" or "\n" in text[tokens.ends[token] : tokens.starts[token + 1]]:
        shape = _shape(token + 1, text, tokens)
        if not begins_line or shape is None:
            return None
        return Misspelt(token, shape, False, f"{quoted(word)} is defined without a keyword", f"write {shape} before it")
    if word in ("as", *_TYPES):
        return None
    near = _MEANT.get(word.lower()) or nearest(word, _KEYWORDS)
    shape = _shape(token + 2, text, tokens) or near
    if near is None and not begins_line:
        return None
    if shape is None:
        if not _ends_line(token + 1, text, tokens):
            return None
        shape = "event"
    name = _text(token + 1, text, tokens)
    hint = f"did you mean {near}?" if near == shape else _example(shape, name)
    return Misspelt(token, shape, True, f"no definition begins with {quoted(word)}", hint)


def _shape(token: int, text: str, tokens: Tokens) -> str | None:
    """What is defined, going by what follows its name: a measure by its type, a constant by its value."""
    kind = tokens.kinds[token]
    if kind == ":" and tokens.kinds[token + 1] == "word":
        its = _text(token + 1, text, tokens)
        return "measure" if its in _TYPES or nearest(its, _TYPES) is not None else None
    if kind == "operator" and _text(token, text, tokens) == "=":
        return "constant"
    return None


def _ends_line(token: int, text: str, tokens: Tokens) -> bool:
    """Whether nothing but whose event it is stands behind a name in its line."""
    return "\n" in text[tokens.ends[token] : tokens.starts[token + 1]] or (
        tokens.kinds[token + 1] == "end" or _text(token + 1, text, tokens) == "as"
    )


def _example(keyword: str, name: str) -> str:
    written = {"event": f"event {name}", "measure": f"measure {name}: boolean", "constant": f"constant {name} = 18"}
    return f"a definition begins with event, measure or constant, as in: {written[keyword]}"


def _text(token: int, text: str, tokens: Tokens) -> str:
    return text[tokens.starts[token] : tokens.ends[token]]
