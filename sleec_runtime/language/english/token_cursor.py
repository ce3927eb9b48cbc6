"""A position in the tokens of structured English, with its error reports."""

from __future__ import annotations

from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import ClauseError, TokenCursor
from sleec_runtime.language.english.keyword_correction import near_keyword
from sleec_runtime.language.english.keywords import IN_WHICH_CASE, KEYWORDS, STATEMENTS
from sleec_runtime.model import Span

_USAGE = {
    **dict.fromkeys(("WITHIN", "EVENTUALLY"), "a time follows one obligation: THEN Alarm WITHIN 5 minutes"),
    **dict.fromkeys(("OTHERWISE", "ELSE"), "it follows one obligation, or its time: THEN Alarm OTHERWISE CallForHelp"),
    **dict.fromkeys(("WHILE", "MEANWHILE", "EXISTS"), "use it in a CONCERN or PURPOSE"),
    "UNTIL": "use it in a RELATION",
}
"""Where each of these keywords belongs, for a hint at one out of place."""

_REPLACEMENTS = {
    "&": "write AND",
    "&&": "write AND",
    "|": "write OR",
    "||": "write OR",
    "!": "write NOT",
    **dict.fromkeys("{}[]", "use round parentheses ( )"),
    ";": "rules need no punctuation between them; delete it",
    **dict.fromkeys("\"'\u201c\u201d\u2018\u2019", "write names, phrases and numbers without quotation marks"),
    "=>": "write >= for 'at least', or THEN before a response",
    "=<": "write <=",
    ":=": "write =",
    **dict.fromkeys(("->", "-->", "\u2192"), "write THEN"),
    "%": "write the number alone, and the unit in the measure's name",
    "NEVER": "inside a sentence, write NOT before what is forbidden or false; a NEVER statement begins a line",
    "ALWAYS": "inside a sentence, leave it out; an ALWAYS statement begins a line",
    "/": "comments start with // or #",
}
"""What to write instead of characters that the language does not use, and of keywords inside a sentence."""


class EnglishCursor(TokenCursor):
    """A position in structured English."""

    def expected(self, what: str, hint: str | None = None) -> NoReturn:
        """Gives up because the token at hand is not `what`. The cause may be the word before it: a keyword in
        lowercase, which was read as a word of a phrase."""
        self._blame_word_before()
        at = self.at
        kind = self.kinds[at]
        if kind == "word":
            meant = near_keyword(self.token_text(at).upper())
            if meant is not None and (meant in what or self.token_text(at).isupper()):
                self.correct_keyword(at, meant)
                raise ClauseError
        if kind == "strange":
            self._refuse_character(at, what, hint)
        if kind == ":" and self.kinds[at + 1] == "WHEN" and self.kinds[at - 1] == "word":
            hint = f"a label follows RULE, without a colon: RULE {self.token_text(at - 1)} WHEN ..."
        elif kind == ":" and self.kinds[at - 1] == "word" and hint is None:
            hint = f"to declare a measure, write MEASURE {self.token_text(at - 1)}: ..."
        if kind == "end" or (kind in STATEMENTS and self.starts_line(at)):
            end = self.ends[at - 1] if at else 0
            unit = "text" if kind == "end" else "statement"
            self.fail(f"expected {what}, but the {unit} ends here", Span(end, end), hint)
        self.fail(f"expected {what}, but found {self.found(at)}", self.token_span(at), hint or _USAGE.get(kind))

    def found(self, token: int) -> str:
        """The token, quoted for a message."""
        return quoted(self.token_text(token))

    def correct_keyword(self, token: int, keyword: str) -> None:
        """Reports a misspelling of `keyword` and goes on as if it were right: the clause can still be read."""
        last = token + 2 if keyword == IN_WHICH_CASE else token
        span = Span(self.starts[token], self.ends[last])
        written = self.text[span.start : span.end]
        if keyword == IN_WHICH_CASE or written.upper() == keyword:
            message = f"keywords are in capital letters: write `{keyword}` instead of {quoted(written)}"
            hint = "if it is part of a phrase, use another word"
        else:
            message = f"{quoted(written)} is not a keyword; did you mean `{keyword}`?"
            hint = "words in capital letters are read as keywords; write phrases in lowercase"
        self.problems.append(Problem(message, span, hint))
        self.kinds[token : last + 1] = keyword.split()

    def end_of_statement(self, what: str) -> None:
        """Makes sure that the next token starts something new. A full stop before it is allowed."""
        if self.kinds[self.at] == "." and (self.kinds[self.at + 1] in STATEMENTS or self.kinds[self.at + 1] == "end"):
            self.at += 1
        kind = self.kinds[self.at]
        if kind in STATEMENTS or kind == "end":
            return
        if kind == ")":
            self.fail("this closing parenthesis has no opening one", self.token_span(self.at), "delete it")
        if kind == "UNLESS":
            self.expected(what, "only a rule can have an exception (UNLESS)")
        if kind == ",":
            self.expected(what, "join conditions and obligations with AND; only declarations are lists with commas")
        self.expected(what)

    def _refuse_character(self, token: int, what: str, hint: str | None) -> NoReturn:
        written = self.token_text(token)
        span = self.token_span(token)
        if written in _REPLACEMENTS:
            self.fail(f"unexpected {quoted(written)}", span, _REPLACEMENTS[written])
        import unicodedata

        if unicodedata.category(written) in ("Cf", "Cc", "Zs", "Co", "Cn", "Cs"):
            name = unicodedata.name(written, "a control character").lower()
            self.fail(f"unexpected invisible character U+{ord(written):04X} ({name})", span, "delete it")
        self.fail(f"unexpected {quoted(written)}; expected {what}", span, hint)

    def _blame_word_before(self) -> None:
        token = self.at - 1
        if token >= 0 and self.kinds[token] == "word" and self.token_text(token).upper() in KEYWORDS:
            self.at = token
            self.correct_keyword(token, self.token_text(token).upper())
            self.has_failed = True
            raise ClauseError
