"""Syntax highlighting for rules: Pygments lexers for both languages."""

from __future__ import annotations

from typing import ClassVar

import pygments.lexers
from pygments.lexer import RegexLexer, bygroups, words
from pygments.token import Comment, Generic, Keyword, Name, Number, Operator, Punctuation, Whitespace

from sleec_runtime.language.dsl import keywords as dsl
from sleec_runtime.language.english.keywords import KEYWORDS, RELATION_WORDS

__all__ = ["DslLexer", "SessionLexer", "SleecLexer"]  # where Pygments looks for them

_COMMON = [
    (r"\s+", Whitespace),
    (r"//.*?$", Comment.Single),
    (r"\d+(\.\d+)?", Number),
    (r"[<>=!]=?|<>|[≤≥≠∧∨¬]|->", Operator),
    (r"[(){}\[\],.:]", Punctuation),
    (r"\w[\w.'’-]*", Name),
    (r".", Punctuation),
]


class SleecLexer(RegexLexer):  # type: ignore[misc, unused-ignore]
    """Structured English. A block of the language `sleec-bad` is rejected by the parser."""

    name = "SLEEC"
    aliases: ClassVar = ["sleec", "sleec-bad"]
    tokens: ClassVar = {
        "root": [
            (r"#.*?$", Comment.Single),
            (words(sorted(KEYWORDS | RELATION_WORDS | {"BY", "TO", "READING"}), r"\b", r"\b"), Keyword),
            *_COMMON,
        ]
    }


class DslLexer(RegexLexer):  # type: ignore[misc, unused-ignore]
    """The `.sleec` DSL."""

    name = "SLEEC DSL"
    aliases: ClassVar = ["dsl", "dsl-bad"]
    tokens: ClassVar = {
        "root": [
            (r"(?s)/\*.*?\*/", Comment.Multiline),
            (words(sorted(dsl.KEYWORDS | dsl.BLOCK_MARKS), r"\b", r"\b"), Keyword),
            *_COMMON,
        ]
    }


class SessionLexer(RegexLexer):  # type: ignore[misc, unused-ignore]
    """Commands after "$ ", and their output. The lexer of Pygments reads output that starts with # as a command."""

    name = "Session"
    aliases: ClassVar = ["console"]
    tokens: ClassVar = {
        "root": [
            (r"^(\$ )(.*\n)", bygroups(Generic.Prompt, Name)),
            (r".*\n", Generic.Output),
        ]
    }


def register() -> None:
    """Register the lexers with Pygments."""
    pygments.lexers.LEXERS.pop("BashSessionLexer", None)
    for lexer in (SleecLexer, DslLexer, SessionLexer):
        pygments.lexers.LEXERS[lexer.__name__] = (__name__, lexer.name, tuple(lexer.aliases), (), ())
