"""Text to `Ruleset` and back (docs/language.md).

ruleset = load("rulesets/household.sleec")
print_ruleset(ruleset)
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from sleec_runtime.language.common.formula_printer import print_formula
from sleec_runtime.language.common.source import read_source, tidy
from sleec_runtime.language.english.parser import parse_english
from sleec_runtime.language.english.printer import print_rule, print_ruleset
from sleec_runtime.model import Ruleset, Source

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["load", "parse", "parse_source", "print_formula", "print_rule", "print_ruleset", "read_source"]

_DSL_BLOCK = re.compile(r"^[ \t]*(?:def|rule|concern|purpose|relation)_(?:start|end)\b", re.MULTILINE | re.IGNORECASE)
_OPENS = ("_start", "_START", "_Start")
"""What a text in the DSL has somewhere; in capitals it is a slip, which is told."""


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
    # In structured English no statement begins with a word in small letters.
    if any(mark in source.text for mark in _OPENS) and _DSL_BLOCK.search(source.text):
        from sleec_runtime.language.dsl import parse_dsl

        return parse_dsl(source)
    return parse_english(source)
