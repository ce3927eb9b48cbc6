"""Names and phrases of plain words, and the keywords that are misspelled or missing in them."""

from __future__ import annotations

import re
from functools import cached_property
from typing import NoReturn

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import MAX_NAME, composed
from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.english.keyword_correction import near_keyword
from sleec_runtime.language.english.keywords import IN_WHICH_CASE, PHRASE, STATEMENTS
from sleec_runtime.language.english.modal_verbs import small_word
from sleec_runtime.language.english.phrase_positions import PhrasePositions, phrase_positions
from sleec_runtime.language.english.token_cursor import EnglishCursor
from sleec_runtime.model import Span

_INNER_CAPITAL = re.compile(r"[^\W\d_][^\s]*?(?<=[^\W\d_A-Z])[A-Z]|_")
_CAPITALISED = {word.capitalize(): word for word in ("WHEN", "IF", "THEN", "UNLESS", "AND", "OR", "NOT", "RULE")}
_CONNECTIVES = frozenset({"and", "or", "not"})

OBLIGATION = "an obligation"
"""What a response consists of, for messages. A time may follow it."""


class EnglishPhraseParser(EnglishCursor):
    """Reads names and phrases."""

    def name(self, what: str, hint: str | None = None) -> str:
        """Reads a name, or a phrase of plain words that stands for one.

        An empty string: its first word was a misspelled keyword, which has been reported and corrected; look again.
        """
        at = self.at
        if self.kinds[at] != "word":
            self.refuse_name(what, hint)
        if self.kinds[at + 1] in PHRASE:
            return self._phrase(what)
        self.at = at + 1
        name = self.checked_name(at)
        if name in ("true", "false"):
            self.fail(f"`{name}` is a truth value; expected {what}", self.token_span(at), "choose another name")
        return name

    def name_at(self, token: int) -> str:
        """The name or phrase that starts at `token`, without checks. The position does not change."""
        last = token
        while self.kinds[last] in PHRASE:
            last += 1
        return self.joined_name(token, last)

    @cached_property
    def positions(self) -> PhrasePositions:
        """Where the names and phrases of the text are."""
        return phrase_positions(self.tokens)

    def small_word(self, token: int) -> str:
        """The token, to compare it with words of English."""
        return small_word(self.token_text(token))

    def refuse_name(self, what: str, hint: str | None) -> NoReturn:
        """Gives up because `what` cannot start with the token at hand."""
        kind = self.kinds[self.at]
        if kind in ("number", "digits"):
            self.fail(
                f"expected {what}, but found {self.found(self.at)}: a name begins with a letter",
                self.token_span(self.at),
                "begin it with a letter, for example: Limit3"
                if what in ("the name of a measure", "the name of a constant")
                else "put a word before the number, for example: ring 3 times",
            )
        if kind == "dotted":
            self.fail(
                f"expected {what}, but {self.found(self.at)} contains a dot",
                self.token_span(self.at),
                "only labels of rules may have dots; write a space after a full stop",
            )
        self.expected(what, hint)

    def keyword_meant(self, token: int, word: str, first: int) -> str | None:
        """The keyword that this word, of a phrase that starts at `first`, almost certainly stands for."""
        if word.isupper():
            return near_keyword(word, self.starts_line(token)) if len(word) > 1 else None
        if token == first:
            return None
        if word in _CAPITALISED:
            return _CAPITALISED[word]
        small = word.casefold()
        if small in ("then", "unless") or (small.upper() in STATEMENTS and self.starts_line(token)):
            return small.upper()
        if small == "in" and [self.token_text(token + n).casefold() for n in (1, 2)] == ["which", "case"]:
            return IN_WHICH_CASE
        return None

    def _phrase(self, what: str) -> str:
        first = self.at
        kinds = self.kinds
        words: list[str] = []
        is_camel_case = False
        length = 0
        while kinds[self.at] in PHRASE:
            token = self.at
            word = self.token_text(token)
            length += len(word) + 1
            if length > MAX_NAME:
                self.fail(
                    f"this phrase has more than {MAX_NAME} characters",
                    Span(self.starts[first], self.ends[token]),
                    "is a keyword such as AND, THEN or UNLESS missing?",
                )
            keyword = self.keyword_meant(token, word, first)
            if keyword is None and what == OBLIGATION:
                keyword = self._time_keyword_meant(token, word)
                if keyword is not None and token == first:
                    self.kinds[token] = keyword
                    self.expected(what)
            if keyword is not None:
                self.correct_keyword(token, keyword)
                break
            is_camel_case = is_camel_case or _INNER_CAPITAL.match(word) is not None or "_" in word
            words.append(word)
            self.at += 1
        if not words:
            return ""
        if what == OBLIGATION and len(words) > 2:
            self._refuse_time_without_keyword(first, words, is_camel_case)
        if is_camel_case and len(words) > 1:
            self._report_two_names(first, words)
        return composed(" ".join(words))

    def _time_keyword_meant(self, token: int, word: str) -> str | None:
        """The keyword for a time that this word of an obligation stands for. In `within reach` it is a plain word."""
        small = word.casefold()
        if small == "otherwise" or (small == "eventually" and self.kinds[token + 1] not in PHRASE):
            return small.upper()
        if small == "within" and (self.kinds[token + 1] in ("number", "digits") or self._is_before_unit(token)):
            return "WITHIN"
        return None

    def _is_before_unit(self, token: int) -> bool:
        """Whether the phrase goes on with a unit of time, or with a bracket."""
        at = token + 1
        while self.kinds[at] in PHRASE and at < token + MAX_NAME:
            if self.token_text(at) in UNITS:
                return True
            at += 1
        return self.token_text(at) == "["

    def _refuse_time_without_keyword(self, first: int, words: list[str], is_camel_case: bool) -> None:
        """Refuses `SoundAlarm after 5 minutes` and `alarm BEFORE 5 minutes`; `wait 5 minutes` is an obligation."""
        for unit in range(2, len(words)):
            if words[unit].casefold() not in UNITS or not words[unit - 1].isdecimal():
                continue
            # The preposition before the number belongs to it; the first word is the name.
            begin = max(1, unit - 2)
            if is_camel_case or (begin == unit - 2 and words[begin].isupper() and len(words[begin]) > 1):
                self.fail(
                    f"use WITHIN to give a time, instead of {quoted(' '.join(words[begin:]))}",
                    Span(self.starts[first + begin], self.ends[first + len(words) - 1]),
                    "WITHIN 5 minutes sets a deadline; WITHIN 5 TO 10 minutes also sets the earliest time",
                )

    def _report_two_names(self, first: int, words: list[str]) -> None:
        for offset, word in enumerate(words):
            if word in _CONNECTIVES:
                self.problem(
                    f"keywords are in capital letters: write `{word.upper()}` instead of `{word}`",
                    self.token_span(first + offset),
                    "or write the whole condition as a phrase of plain words",
                )
                return
        written = quoted(" ".join(words))
        if any(word[-1].isdecimal() and not word[0].isalpha() for word in words):
            self.problem(
                f"a name and a number side by side: {written}",
                self.span(first),
                "is a comparison such as < or >= missing between them?",
            )
        self.problem(
            f"two names side by side: {written}",
            self.span(first),
            "is AND, or another keyword, missing between them? Write a single name without spaces",
        )
