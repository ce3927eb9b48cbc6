"""Text to `Ruleset` and back (docs/language.md).

ruleset = load("rulesets/household.sleec")
print_ruleset(ruleset)
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from sleec_runtime.errors import LanguageError, Problem
from sleec_runtime.language.english import parse_english
from sleec_runtime.language.printer import print_formula, print_rule, print_ruleset
from sleec_runtime.language.source import read_source, tidy
from sleec_runtime.model import Ruleset, Source, Span

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["load", "parse", "parse_source", "print_formula", "print_rule", "print_ruleset", "read_source"]

_COMMENT = re.compile(r"\s*(?://|#)[^\n]*")
_WORD = re.compile(r"\s*(\w+)")
_DSL_STARTS = frozenset({"def_start", "rule_start", "concern_start", "purpose_start", "relation_start"})


def parse(text: str, path: str = "<memory>", sha256: str | None = None) -> Ruleset:
    """The ruleset that `text` spells out; `path` is what messages call the text.

    Raises:
        LanguageError: with every problem of the text, each with its place and what to try.
    """
    return parse_source(Source(path, tidy(text), sha256))


def load(path: str | Path) -> Ruleset:
    """The ruleset in the file at `path`; ``-`` is standard input.

    Raises:
        UnreadableFile: the file cannot be read as text.
        LanguageError: the text is not a ruleset.
    """
    return parse_source(read_source(path))


def parse_source(source: Source) -> Ruleset:
    """As `parse`, of a text that has been read already."""
    word = _first_word(source.text)
    if source.text[word.start : word.end] in _DSL_STARTS:
        raise LanguageError(
            source,
            [
                Problem(
                    "this is a text in the .sleec DSL (def_start ... rule_end), which is not supported yet",
                    word,
                    "write the rules in structured English: WHEN trigger THEN response",
                )
            ],
        )
    return parse_english(source)


def _first_word(text: str) -> Span:
    at = 0
    while comment := _COMMENT.match(text, at):
        at = comment.end()
    word = _WORD.match(text, at)
    return Span(*word.span(1)) if word else Span(at, at)
