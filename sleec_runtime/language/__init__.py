"""Text to `Ruleset` and back (docs/language.md).

ruleset = load("rulesets/household.sleec")
print_ruleset(ruleset)
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from sleec_runtime.language.common.formula_printer import print_formula
from sleec_runtime.language.common.source import normalize_line_breaks, read_source
from sleec_runtime.language.english.parser import parse_english
from sleec_runtime.language.english.printer import print_english, print_rule
from sleec_runtime.model import Ruleset, Source

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["load", "parse", "parse_source", "print_formula", "print_rule", "print_ruleset", "read_source"]

_DSL_BLOCK = re.compile(r"^[ \t]*(?:def|rule|concern|purpose|relation)_(?:start|end)\b", re.MULTILINE | re.IGNORECASE)
_BLOCK_ENDINGS = ("_start", "_START", "_Start")
"""Every text in the DSL contains one of these. Capitals are a mistake, which the DSL parser reports."""


def parse(text: str, path: str = "<memory>", sha256: str | None = None) -> Ruleset:
    """Parses a text in structured English or the DSL; messages call it `path`.

    Raises:
        LanguageError: with every problem of the text, its place and a hint.
    """
    return parse_source(Source(path, normalize_line_breaks(text), sha256))


def load(path: str | Path) -> Ruleset:
    """Reads and parses the file at `path`; ``-`` is standard input.

    Raises:
        UnreadableFile: the file cannot be read as text.
        LanguageError: the text is not a ruleset.
    """
    return parse_source(read_source(path))


def parse_source(source: Source) -> Ruleset:
    """Parses a text that has been read already."""
    # In structured English no statement begins with a word in lowercase.
    if any(mark in source.text for mark in _BLOCK_ENDINGS) and _DSL_BLOCK.search(source.text):
        from sleec_runtime.language.dsl import parse_dsl

        return parse_dsl(source)
    return parse_english(source)


def print_ruleset(ruleset: Ruleset) -> str:
    """`ruleset` as a text in its own syntax, with its comments, ending in a line break (or empty).

    Raises:
        Unsayable: that syntax cannot express something in it.
    """
    if ruleset.syntax == "dsl":
        from sleec_runtime.language.dsl.printer import print_dsl

        return print_dsl(ruleset)
    return print_english(ruleset)
