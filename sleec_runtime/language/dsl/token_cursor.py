"""A position in the tokens of a text in the DSL: names and marks, the ends of items and blocks, and error reports."""

from __future__ import annotations

from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import ClauseError, TokenCursor
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.hints import (
    DEFINITION_END,
    REPLACEMENTS,
    RULE_EXAMPLE,
    RULE_START,
    SYNONYMS,
    example_of,
    hint_for,
)
from sleec_runtime.language.dsl.keywords import BLOCKS, DEFINITIONS, ITEM_STARTS, KEYWORDS
from sleec_runtime.model import Dialect, Source, Span
from sleec_runtime.support.suggestions import nearest

_SUGGESTED = sorted(KEYWORDS)
_RESUMED = DEFINITIONS | frozenset(BLOCKS.values())
"""The keywords at which parsing goes on when they are corrected."""


class DslCursor(TokenCursor):
    """A position in a text in the DSL."""

    operators = "not"

    item = "rule"
    """What a name at the start of a line is the name of."""

    def __init__(self, source: Source, tokens: Tokens, dialect: Dialect, problems: list[Problem]) -> None:
        super().__init__(source, tokens, problems)
        self.dialect = dialect

    # Problems -------------------------------------------------------------------------------------------------

    def expected(self, what: str, hint: str | None = None) -> NoReturn:
        """Gives up because the token at hand is not `what`."""
        at = self.at
        kind = self.kinds[at]
        written = self.token_text(at)
        if kind in ("strange", "/*") and written in REPLACEMENTS:
            self.fail(f"unexpected {quoted(written)}", self.token_span(at), REPLACEMENTS[written])
        if kind == "word":
            self._correct_keyword(what, written)
        if kind in ITEM_STARTS:
            end = self.ends[at - 1] if at else 0
            starts = f"the {self.item} {quoted(written)} starts here"
            here = {"end": "the text ends here", "label": starts}.get(kind, f"found {quoted(written)}")
            self.fail(f"expected {what}, but {here}", Span(end, end), hint or example_of(what))
        hint = hint_for(what, written, self.kinds[at - 1]) or hint or example_of(what)
        self.fail(f"expected {what}, but found {quoted(written)}", self.token_span(at), hint)

    def precedes_mistake(self) -> bool:
        """Whether the token at hand cannot follow a name in a rule or claim. The problem is then reported there."""
        return self.item != "relation" and self.kinds[self.at] in ("word", "number", "digits", "strange", ":")

    def _correct_keyword(self, what: str, written: str) -> None:
        """Gives up at a misspelling of a keyword that may stand here."""
        word = written.lower()
        keyword = word if word in KEYWORDS else SYNONYMS.get(word) or nearest(word, _SUGGESTED)
        starts_line = self.starts_line(self.at)
        if keyword is None or not (
            f"`{keyword}`" in what or (keyword in _RESUMED and (starts_line or what == DEFINITION_END))
        ):
            return
        hint = "write keywords in lowercase" if word == keyword else f"replace it with {keyword}"
        self.problem(f"{quoted(written)} is not a keyword; did you mean `{keyword}`?", self.token_span(self.at), hint)
        if keyword in _RESUMED:
            self.kinds[self.at] = keyword
        raise ClauseError

    # Marks and names ------------------------------------------------------------------------------------------

    def accept(self, kind: str) -> bool:
        """Reads the token at hand if it is of this kind."""
        if self.kinds[self.at] != kind:
            return False
        self.at += 1
        return True

    def require(self, kind: str, what: str, hint: str | None = None) -> None:
        if not self.accept(kind):
            self.expected(what, hint)

    def name(self, what: str, hint: str | None = None) -> str:
        """Reads a name."""
        at = self.at
        kind = self.kinds[at]
        if kind == "digits" or kind == "number":
            message = f"expected {what}, but found {quoted(self.token_text(at))}: a name begins with a letter"
            self.fail(message, self.token_span(at), hint or example_of(what))
        if kind in KEYWORDS and kind not in ITEM_STARTS:
            message = f"expected {what}, but found the keyword `{kind}`"
            is_example = hint is None or hint.startswith("for example")
            self.fail(message, self.token_span(at), "a keyword cannot be a name" if is_example else hint)
        if kind != "word":
            self.expected(what, hint)
        self.at = at + 1
        return self.checked_name(at)

    # Ends -----------------------------------------------------------------------------------------------------

    def end_of_item(self, what: str) -> None:
        """Makes sure that the next token starts something new."""
        kind = self.kinds[self.at]
        if kind in ITEM_STARTS:
            return
        if kind in (")", "}", "]"):
            self.fail(f"this closing {quoted(kind)} has no opening one", self.token_span(self.at), "delete it")
        if self.starts_line(self.at):
            self.refuse_item(what)
        self.expected(what)

    def refuse_item(self, what: str, hint: str | None = None) -> NoReturn:
        """Gives up because no item starts with the line at hand."""
        if self.item != "definition":
            self._correct_when()
        self.expected(what, hint or (RULE_START if self.item == "rule" else None))

    def _correct_when(self) -> None:
        """Gives up where a rule or claim has another word for `when`, or none."""
        at = self.at
        kinds = self.kinds[at : at + 3]
        words = [self.token_text(token).lower() for token in range(at, at + 3) if self.kinds[token] == "word"]
        for token, word in zip((at, at + 1), words if kinds[0] == "word" else ()):
            if SYNONYMS.get(word) == "when" or word == "when" or nearest(word, ("when",)) is not None:
                message = f"{quoted(self.token_text(token))} is not a keyword; did you mean `when`?"
                self.problem(message, self.token_span(token), "replace it with when")
                if token > at:
                    self.kinds[at], self.kinds[token] = "label", "when"
                raise ClauseError
        if kinds[:2] == ["word", "word"] and kinds[2] in ("then", "and"):
            message = f"`when` is missing before {quoted(self.token_text(at + 1))}"
            self.fail(message, self.token_span(at + 1), RULE_EXAMPLE)

    def end_of_block(self, opened: int) -> None:
        """Reads the keyword that closes the block of token `opened`, or reports that it is missing."""
        closing = BLOCKS[self.kinds[opened]]
        if self.accept(closing):
            return
        self.begin_clause()
        end = self.ends[self.at - 1]
        where = "before the text ends" if self.kinds[self.at] == "end" else f"before `{self.token_text(self.at)}`"
        self.problem(
            f"`{closing}` is missing {where}: `{self.kinds[opened]}` is in line {self.line_of(opened)}",
            Span(end, end),
            f"write {closing} at the end of the block",
        )
        if self.kinds[self.at] in BLOCKS.values():
            self.at += 1
