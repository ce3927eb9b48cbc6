"""A place in the tokens of structured English: reading names and phrases, and telling misspelt keywords from them."""

from __future__ import annotations

import re
from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import MAX_DEPTH, MAX_NAME, Abandon, TokenCursor, composed
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.english.keyword_correction import near_keyword
from sleec_runtime.language.english.keywords import IN_WHICH_CASE, KEYWORDS, PHRASE, STATEMENTS
from sleec_runtime.model import Source, Span

_INNER_CAPITAL = re.compile(r"[^\W\d_][^\s]*?(?<=[^\W\d_A-Z])[A-Z]|_")
_CAPITALISED = {word.capitalize(): word for word in ("WHEN", "IF", "THEN", "UNLESS", "AND", "OR", "NOT", "RULE")}
_JOINERS = frozenset({"and", "or", "not"})

OBLIGATION = "an obligation"
"""What a response is made of, as messages say it; words for times may stand behind it."""

_MISPLACED = {
    **dict.fromkeys(("WITHIN", "EVENTUALLY"), "a time stands behind one obligation: THEN Alarm WITHIN 5 minutes"),
    **dict.fromkeys(
        ("OTHERWISE", "ELSE"), "it stands behind one obligation, or its time: THEN Alarm OTHERWISE CallForHelp"
    ),
    **dict.fromkeys(("WHILE", "MEANWHILE", "EXISTS"), "it belongs into a CONCERN or PURPOSE"),
    "UNTIL": "it belongs into a RELATION",
}
"""What to try where one of these keywords is not expected, and nothing better is known."""

_INSTEAD = {
    "&": "write AND",
    "&&": "write AND",
    "|": "write OR",
    "||": "write OR",
    "!": "write NOT",
    "{": "use round parentheses ( )",
    "}": "use round parentheses ( )",
    "[": "use round parentheses ( )",
    "]": "use round parentheses ( )",
    ";": "rules need no punctuation between them; leave it out",
    '"': "write names, phrases and numbers without quotation marks",
    "'": "write names, phrases and numbers without quotation marks",
    "\u201c": "write names, phrases and numbers without quotation marks",
    "\u201d": "write names, phrases and numbers without quotation marks",
    "\u2018": "write names, phrases and numbers without quotation marks",
    "\u2019": "write names, phrases and numbers without quotation marks",
    "=>": "write >= for 'at least', or THEN before a response",
    "=<": "write <=",
    ":=": "write =",
    "->": "write THEN",
    "-->": "write THEN",
    "\u2192": "write THEN",
    "%": "write the number alone, and the unit in the measure's name",
    "/": "comments start with // or #",
}


class Cursor(TokenCursor):
    """Where the parser of structured English stands, and what it does with names, keywords and mistakes."""

    def __init__(self, source: Source, tokens: Tokens, problems: list[Problem]) -> None:
        super().__init__(source, tokens, problems)
        self.deepest = 0

    # Places ---------------------------------------------------------------------------------------------------

    def starts_line(self, token: int) -> bool:
        return token == 0 or "\n" in self.text[self.ends[token - 1] : self.starts[token]]

    # Problems -------------------------------------------------------------------------------------------------

    def expected(self, what: str, hint: str | None = None) -> NoReturn:
        """Gives up because the token at hand is not `what`. The cause may stand just before it: a keyword that is
        not in capitals, and was taken for a word of a phrase."""
        self._blame_word_before()
        at = self.at
        kind = self.kinds[at]
        if kind == "word":
            meant = near_keyword(self.token_text(at).upper())
            if meant is not None and (meant in what or self.token_text(at).isupper()):
                self.misspelt(at, meant)
                raise Abandon
        if kind == "strange":
            self._strange(at, what, hint)
        if kind == ":" and self.kinds[at + 1] == "WHEN" and self.kinds[at - 1] == "word":
            hint = f"a label stands behind RULE and without a colon: RULE {self.token_text(at - 1)} WHEN ..."
        elif kind == ":" and self.kinds[at - 1] == "word" and hint is None:
            hint = f"a measure is declared so: MEASURE {self.token_text(at - 1)}: ..."
        if kind == "end" or (kind in STATEMENTS and self.starts_line(at)):
            end = self.ends[at - 1] if at else 0
            self.fail(
                f"expected {what}, but the {'text' if kind == 'end' else 'statement'} ends here", Span(end, end), hint
            )
        self.fail(f"expected {what}, but found {self.found(at)}", self.token_span(at), hint or _MISPLACED.get(kind))

    def _strange(self, token: int, what: str, hint: str | None) -> NoReturn:
        """Gives up because of a character that the language has no use for."""
        written = self.token_text(token)
        span = self.token_span(token)
        if written in _INSTEAD:
            self.fail(f"unexpected {quoted(written)}", span, _INSTEAD[written])
        import unicodedata

        if unicodedata.category(written) in ("Cf", "Cc", "Zs", "Co", "Cn", "Cs"):
            name = unicodedata.name(written, "a control character").lower()
            self.fail(f"unexpected invisible character U+{ord(written):04X} ({name})", span, "delete it")
        self.fail(f"unexpected {quoted(written)}; expected {what}", span, hint)

    def found(self, token: int) -> str:
        """The token as a message quotes it."""
        return quoted(self.token_text(token))

    def misspelt(self, token: int, keyword: str) -> None:
        """Reports a misspelt keyword and goes on as if it were right: it never hurts the clause."""
        last = token + 2 if keyword == IN_WHICH_CASE else token
        span = Span(self.starts[token], self.ends[last])
        written = self.text[span.start : span.end]
        if keyword == IN_WHICH_CASE or written.upper() == keyword:
            message = f"keywords are written in capitals: {keyword} instead of {quoted(written)}"
            hint = "if it is part of a phrase, choose another word there"
        else:
            message = f"{quoted(written)} is no keyword; did you mean {keyword}?"
            hint = "words in capitals are taken for keywords; if it is a word of a phrase, write it in small letters"
        self.problems.append(Problem(message, span, hint))
        self.kinds[token : last + 1] = keyword.split()

    def deeper(self, levels: int = 1) -> None:
        """One parenthesis or NOT further in, or `levels` of them."""
        self.depth += levels
        if self.depth > self.deepest:
            self.deepest = self.depth
            if self.depth > MAX_DEPTH:
                self.too_deep()

    def too_deep(self) -> NoReturn:
        self.fail(
            f"nested too deeply: more than {MAX_DEPTH} levels of parentheses or NOT",
            self.token_span(self.at),
            "name a part of the condition, or split the rule in two",
        )

    def missing_parenthesis(self, opened: int) -> NoReturn:
        place = self.source.place(self.token_span(opened))
        self.expected(
            f"a closing parenthesis for the one opened in line {place.line}, column {place.column}",
            "close it, or delete the opening one",
        )

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
            self.expected(what, "UNLESS belongs to a rule")
        if kind == ",":
            self.expected(what, "AND joins conditions and obligations; commas stand in lists of declarations only")
        self.expected(what)

    def _blame_word_before(self) -> None:
        token = self.at - 1
        if token >= 0 and self.kinds[token] == "word" and self.token_text(token).upper() in KEYWORDS:
            self.at = token
            self.misspelt(token, self.token_text(token).upper())
            self.hurt = True
            raise Abandon

    # Names ----------------------------------------------------------------------------------------------------

    def name(self, what: str, hint: str | None = None) -> str:
        """Reads a name, or a phrase of plain words that stands for one.

        An empty string: its first word was a misspelt keyword. It has been reported and mended; look again.
        """
        at = self.at
        kinds = self.kinds
        if kinds[at] != "word":
            self.no_name(what, hint)
        if kinds[at + 1] in PHRASE:
            return self._phrase_of_words(what)
        self.at = at + 1
        start, end = self.starts[at], self.ends[at]
        word = self.text[start:end]
        if end - start > MAX_NAME:
            self.fail(
                f"this name has {end - start:,} characters, more than {MAX_NAME}",
                Span(start, start + MAX_NAME),
                "is a blank missing?",
            )
        if word in ("true", "false"):
            self.fail(f"{word} is a truth value; expected {what}", Span(start, end), "choose another name")
        return word if word.isascii() else composed(word)

    def name_at(self, token: int) -> str:
        """The name or phrase that starts at `token`, unchecked. It stays to be read."""
        last = token
        while self.kinds[last] in PHRASE:
            last += 1
        name = " ".join(map(self.token_text, range(token, last)))
        return name if name.isascii() else composed(name)

    def no_name(self, what: str, hint: str | None) -> NoReturn:
        """Gives up because `what` cannot start with the token at hand."""
        kind = self.kinds[self.at]
        if kind in ("number", "digits"):
            self.fail(
                f"expected {what}, but found {self.found(self.at)}: a name begins with a letter",
                self.token_span(self.at),
                "begin it with a letter, as in: Limit3"
                if what in ("the name of a measure", "the name of a constant")
                else "put a word before the number, as in: at least 3 people",
            )
        if kind == "dotted":
            self.fail(
                f"expected {what}, but {self.found(self.at)} has a dot in it",
                self.token_span(self.at),
                "only labels of rules may have dots; a full stop is followed by a blank",
            )
        self.expected(what, hint)

    def _phrase_of_words(self, what: str) -> str:
        first = self.at
        kinds = self.kinds
        words: list[str] = []
        camel = False
        length = 0
        while kinds[self.at] in PHRASE:
            token = self.at
            word = self.token_text(token)
            length += len(word) + 1
            if length > MAX_NAME:
                self.fail(
                    f"this phrase is longer than {MAX_NAME} characters",
                    Span(self.starts[first], self.ends[token]),
                    "is a keyword such as AND, THEN or UNLESS missing?",
                )
            keyword = self.keyword_meant(token, word, first)
            if keyword is None and what == OBLIGATION:
                keyword = self._time_meant(token, word)
                if keyword is not None and token == first:
                    self.fail(f"expected {what}, but found {quoted(word)}", self.token_span(token), _MISPLACED[keyword])
            if keyword is not None:
                self.misspelt(token, keyword)
                break
            camel = camel or _INNER_CAPITAL.match(word) is not None or "_" in word
            words.append(word)
            self.at += 1
        if not words:
            return ""
        if what == OBLIGATION and len(words) > 2:
            self._no_time(first, words, camel)
        if camel and len(words) > 1:
            self._two_names(first, words)
        name = " ".join(words)
        return name if name.isascii() else composed(name)

    def keyword_meant(self, token: int, word: str, first: int) -> str | None:
        """The keyword that this word, of a phrase that starts at `first`, was surely meant to be."""
        if word.isupper():
            return near_keyword(word, self.starts_line(token)) if len(word) > 1 else None
        if token == first:
            return None
        if word in _CAPITALISED:
            return _CAPITALISED[word]
        small = word.casefold()
        if small in ("then", "unless") or (small.upper() in STATEMENTS and self.starts_line(token)):
            return small.upper()
        if small == "in" and self._says("which case", token + 1):
            return IN_WHICH_CASE
        return None

    def _time_meant(self, token: int, word: str) -> str | None:
        """The keyword for a time that this word of an obligation was surely meant to be. `within reach` is none."""
        small = word.casefold()
        if small == "otherwise" or (small == "eventually" and self.kinds[token + 1] not in PHRASE):
            return small.upper()
        if small == "within" and (self.kinds[token + 1] in ("number", "digits") or self._has_unit_behind(token)):
            return "WITHIN"
        return None

    def _has_unit_behind(self, token: int) -> bool:
        """Whether the phrase goes on with a unit of time, or with a bracket."""
        at = token + 1
        while self.kinds[at] in PHRASE and at < token + MAX_NAME:
            if self.token_text(at) in UNITS:
                return True
            at += 1
        return self.token_text(at) == "["

    def _no_time(self, first: int, words: list[str], camel: bool) -> None:
        """Refuses `SoundAlarm after 5 minutes` and `alarm BEFORE 5 minutes`; `wait 5 minutes` is something to do."""
        for unit in range(2, len(words)):
            if words[unit].casefold() not in UNITS or not words[unit - 1].isdecimal():
                continue
            # The preposition before the number belongs to it; the first word is the name.
            begin = max(1, unit - 2)
            if camel or (begin == unit - 2 and words[begin].isupper() and len(words[begin]) > 1):
                self.fail(
                    f"a time stands behind WITHIN, but here is {quoted(' '.join(words[begin:]))}",
                    Span(self.starts[first + begin], self.ends[first + len(words) - 1]),
                    "WITHIN 5 minutes is no later than that, and WITHIN 5 TO 10 minutes no sooner either",
                )

    def _says(self, words: str, token: int) -> bool:
        return [self.token_text(token).casefold(), self.token_text(token + 1).casefold()] == words.split()

    def _two_names(self, first: int, words: list[str]) -> None:
        for offset, word in enumerate(words):
            if word in _JOINERS:
                self.problem(
                    f"keywords are written in capitals: {word.upper()} instead of `{word}`",
                    self.token_span(first + offset),
                    "or write the whole condition as a phrase of plain words",
                )
                return
        if any(word[-1].isdecimal() and not word[0].isalpha() for word in words):
            self.problem(
                f"a name and a number side by side: {quoted(' '.join(words))}",
                self.span(first),
                "is a comparison such as < or >= missing between them?",
            )
        self.problem(
            f"two names side by side: {quoted(' '.join(words))}",
            self.span(first),
            "is AND, or another keyword, missing between them? A single name is written without blanks, "
            "and a phrase in plain words",
        )
