"""A place in the tokens of a text in the DSL: reading names and marks, and the ends of items and blocks."""

from __future__ import annotations

from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import MAX_DEPTH, MAX_NAME, TokenCursor, composed
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.keywords import BLOCKS, DEFINITIONS, ITEM_STARTS, KEYWORDS
from sleec_runtime.language.dsl.slips import MEANT, Found, help_with, means_when
from sleec_runtime.model import Dialect, Source, Span
from sleec_runtime.support.suggestions import nearest

_SUGGESTED = sorted(KEYWORDS)
_INSTEAD = {
    "&": "write and",
    "&&": "write and",
    "|": "write or",
    "||": "write or",
    "!": "write not, or <> between two values",
    "=>": "write >= to compare, or then before a response",
    "=<": "write <=",
    ";": "there is no punctuation between rules or definitions; leave it out",
    ".": "there is no punctuation between rules or definitions, and no dot in a name; leave it out",
    "#": "comments start with //",
    "/": "comments start with //",
    "/*": "close this comment with */",
    '"': "write names without quotation marks",
    **dict.fromkeys("'`\u2018\u2019\u201c\u201d\u00ab\u00bb", "write names without quotation marks"),
}
_DEFINE = "a definition begins with event, measure or constant, as in: event SmokeDetected"


class Cursor(TokenCursor):
    """Where the parser of the DSL stands, and what it does with names, keywords and mistakes."""

    item = "rule"
    """What a name at the begin of a line is that of."""

    def __init__(self, source: Source, tokens: Tokens, dialect: Dialect, problems: list[Problem]) -> None:
        super().__init__(source, tokens, problems)
        self.dialect = dialect

    # Problems -------------------------------------------------------------------------------------------------

    def begin_clause(self) -> None:
        """From here on a problem is a new one."""
        self.hurt = False
        self.depth = 0

    def expected(self, what: str, hint: str | None = None) -> NoReturn:
        """Gives up because the token at hand is not `what`."""
        at = self.at
        kind = self.kinds[at]
        written = self.token_text(at)
        if kind in ("strange", "/*") and written in _INSTEAD:
            self.fail(f"unexpected {quoted(written)}", self.token_span(at), _INSTEAD[written])
        hint = self._help_with(what) or hint
        if kind == "word":
            meant = written.lower() if written.lower() in KEYWORDS else nearest(written, _SUGGESTED)
            if meant is not None and meant in MEANT.get(what, what.split()):
                self.fail(
                    f"{quoted(written)} is no keyword; did you mean {meant}?",
                    self.token_span(at),
                    "keywords are written in small letters" if written.lower() == meant else f"write {meant}",
                )
        if kind in ITEM_STARTS:
            end = self.ends[at - 1] if at else 0
            ends = {"end": "the text ends here", "label": f"here the {self.item} {quoted(written)} begins"}
            self.fail(
                f"expected {what}, but {ends.get(kind, f'{written} comes next')}",
                Span(end, end),
                hint or self._unsaid(kind),
            )
        self.fail(f"expected {what}, but found {quoted(written)}", self.token_span(at), hint)

    def _help_with(self, what: str) -> str | None:
        """What to do about the token at hand where `what` is expected, if that can be told."""
        at = self.at
        if at == 0 or self.kinds[at] == "end":
            return None
        begins_line = "\n" in self.text[self.ends[at - 1] : self.starts[at]]
        return help_with(
            what, Found(begins_line, self.kinds[at - 1], self.kinds[at], self.token_text(at), self.token_text(at + 1))
        )

    def _unsaid(self, kind: str) -> str | None:
        name = "R1" if self.item == "rule" else f"{self.item[0]}1"
        return f"a {self.item} looks like this: {name} when Event then Response" if kind == "label" else None

    # Small things ---------------------------------------------------------------------------------------------

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
            self.fail(
                f"expected {what}, but found {quoted(self.token_text(at))}: a name begins with a letter",
                self.token_span(at),
                self._help_with(what) or hint,
            )
        if kind in KEYWORDS and kind not in ITEM_STARTS:
            self.fail(
                f"expected {what}, but found the keyword {kind}",
                self.token_span(at),
                hint if hint and not hint.startswith("as in") else "a keyword cannot be a name",
            )
        if kind != "word":
            self.expected(what, hint)
        self.at = at + 1
        word = self.token_text(at)
        if len(word) > MAX_NAME:
            self.fail(
                f"this name has {len(word):,} characters, more than {MAX_NAME}",
                Span(self.starts[at], self.starts[at] + MAX_NAME),
                "is a blank missing?",
            )
        return word if word.isascii() else composed(word)

    def close(self, mark: str, opened: int) -> None:
        """Reads the `mark` that closes what token `opened` opened."""
        if not self.accept(mark):
            place = self.source.place(self.token_span(opened))
            what = "brace" if mark == "}" else "bracket" if mark == "]" else "parenthesis"
            self.expected(
                f"a closing {what} for the one opened in line {place.line}, column {place.column}",
                "close it, or delete the opening one",
            )

    def deeper(self, levels: int = 1) -> None:
        """One parenthesis, brace or `not` further in, or `levels` of them."""
        self.depth += levels
        if self.depth > MAX_DEPTH:
            self.fail(
                f"nested too deeply: more than {MAX_DEPTH} levels of parentheses, braces or not",
                self.token_span(self.at),
                "name a part of the condition, or split the rule in two",
            )

    def end_of(self, what: str) -> None:
        """Makes sure that the next token starts something new."""
        kind = self.kinds[self.at]
        if kind in ITEM_STARTS:
            return
        if kind in (")", "}", "]"):
            self.fail(f"this closing {quoted(kind)} has no opening one", self.token_span(self.at), "delete it")
        if what in MEANT and "\n" in self.text[self.ends[self.at - 1] : self.starts[self.at]]:
            self.refuse_begin_of_rule()
        self.expected(what, self._begins_wrong(what))

    def refuse_begin_of_rule(self) -> None:
        """Gives up where the line at hand begins nearly as a rule does."""
        at = self.at
        first, second = self.token_text(at), self.token_text(at + 1)
        example = "a rule looks like this: R1 when Event then Response"
        if self.kinds[at] in ("number", "digits"):
            self.fail("the name of a rule begins with a letter", self.token_span(at), example)
        if self.kinds[at] != "word":
            return
        if first.lower() in ("rule", "rules"):
            self.fail(f"{quoted(first)} does not stand before the name of a rule", self.token_span(at), example)
        for token in (at, at + 1):
            word = self.token_text(token)
            if self.kinds[token] == "word" and means_when(word):
                said = f"{quoted(word)} is no keyword; did you mean when?"
                self.fail(said, self.token_span(token), example)
        if self.kinds[at + 1] == "word" and self.kinds[at + 2] in ("then", "and"):
            self.fail(f"when is missing before {quoted(second)}", self.token_span(at + 1), example)
        if self.kinds[at + 1] in ("number", "strange", ",", ")", "-") and "\n" not in second:
            said = f"the name of a rule has letters, digits and _ only, and here comes {quoted(second)}"
            self.fail(said, self.token_span(at + 1), example)

    def _begins_wrong(self, what: str) -> str | None:
        """What to do about a word, or a line of them, that begins nothing."""
        at = self.at
        begins_line = "\n" in self.text[self.ends[at - 1] : self.starts[at]]
        if "definition" in what:
            meant = nearest(self.token_text(at).lower(), sorted(DEFINITIONS)) if begins_line else None
            return f"did you mean {meant}?" if meant is not None else _DEFINE
        if "rule" not in what:
            return None
        if begins_line and self.kinds[at] == "word":
            return "a rule begins with its name and when: R1 when Event then Response"
        return "behind a response comes within, otherwise, else, unless or the next rule"

    def end_of_block(self, opened: int) -> None:
        """Reads the keyword that closes the block of token `opened`, or says that it is missing."""
        closing = BLOCKS[self.kinds[opened]]
        if self.accept(closing):
            return
        self.begin_clause()
        end = self.ends[self.at - 1]
        where = "before the text ends" if self.kinds[self.at] == "end" else f"before {self.token_text(self.at)}"
        self.problem(
            f"{closing} is missing {where}: {self.kinds[opened]} is in line {self.line_of(opened)}",
            Span(end, end),
            f"write {closing} behind what belongs to the block",
        )
        if self.kinds[self.at] in BLOCKS.values():
            self.at += 1
