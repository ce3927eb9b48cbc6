"""From characters to tokens: one regular expression over the whole text.

Tokens live in parallel sequences, not in objects, so that a text of 100,000 rules stays small. Comments are attached
here: every line that the printer writes starts with a keyword, so a comment belongs to the token of such a keyword.
"""

from __future__ import annotations

import re
from array import array
from dataclasses import dataclass

from sleec_runtime.model import NO_COMMENTS, Comments

DECLARATIONS = frozenset({"MEASURE", "CONSTANT", "TRIGGER", "CONDITION", "OBLIGATION"})
RULE_STARTS = frozenset({"RULE", "WHEN", "IF"})
STATEMENTS = DECLARATIONS | RULE_STARTS | {"DOMAIN", "READING", "EXCLUSIVE", "NEVER", "ASSUME", "CONCERN", "PURPOSE"}
TIMES = frozenset({"WITHIN", "OTHERWISE", "EVENTUALLY"})
KEYWORDS = STATEMENTS | TIMES | {"THEN", "UNLESS", "IN", "WHICH", "CASE", "AND", "OR", "NOT"}

PHRASE = frozenset({"word", "number", "digits"})
"""The kinds of token that may follow the first word of a phrase."""

_LINE_STARTS = STATEMENTS | {"UNLESS"}
_SETTINGS = frozenset({"DOMAIN", "READING"})

# Letters with marks of their own (accents typed apart, Hebrew, Arabic, Indic and Thai vowels): \w leaves them out.
_MARKS = "\u0300-\u036f\u0591-\u05bd\u064b-\u065f\u0900-\u0963\u0966-\u0dff\u0e31-\u0eff"
_REST = rf"[\w{_MARKS}'\u2019-]"

_TOKEN = re.compile(
    r"\s*(?:"
    rf"([^\W\d]{_REST}*)(\.\w[\w.{_MARKS}'\u2019-]*)?"  # 1 word, 2 its tail if it has dots
    r"|([(),:.](?!=))"  # 3 punctuation
    r"|(<=|>=|<>|!=|==|=(?![<>])|[<>\u2264\u2265\u2260])"  # 4 operator
    rf"|(-?[0-9]+(?:\.[0-9]+)?(?!{_REST}|\.[0-9]))"  # 5 number
    r"|((?://|\#)[^\n]*)"  # 6 comment
    rf"|(\d{_REST}*)"  # 7 digits with letters: 3rd, 12-lead
    r"|(&&|\|\||=[<>]|-+>|:=|.)"  # 8 anything else
    r")"
)
_WORD, _DOTTED, _MARK, _OPERATOR, _NUMBER, _COMMENT, _DIGITS, _STRANGE = range(1, 9)
_KIND_OF_GROUP = {
    _DOTTED: "dotted",
    _OPERATOR: "operator",
    _NUMBER: "number",
    _DIGITS: "digits",
    _STRANGE: "strange",
}
_KEYWORD = {word: word for word in KEYWORDS}


@dataclass
class Tokens:
    """The tokens of a text: `kinds[i]` is a keyword, a punctuation mark or a kind in lower case, and the token is
    ``text[starts[i]:ends[i]]``. Three tokens of kind ``end`` close the sequence, so that one may look ahead.

    `comments` holds the comments of the token that starts a line of rules; `closing` those after all of them.
    """

    kinds: list[str]
    starts: array[int]
    ends: array[int]
    comments: dict[int, Comments]
    closing: tuple[str, ...]


def scan(text: str) -> Tokens:
    """The tokens of `text`, in time linear in its length. Nothing is refused here; the parser says what is wrong."""
    kinds: list[str] = []
    starts = array("q")
    ends = array("q")
    remarks = _Remarks(text, kinds, ends)
    keyword = _KEYWORD.get
    add_kind, add_start, add_end = kinds.append, starts.append, ends.append
    line_starts, phrase_word = _LINE_STARTS, "word"
    # Without the trailing blanks: each of them would be tried as the start of a token.
    for match in _TOKEN.finditer(text, 0, len(text.rstrip())):
        group = match.lastindex
        if group == _WORD:
            kind = keyword(match[1], phrase_word)
            if kind in line_starts:
                remarks.line_starts(len(kinds), kind, match.start(1))
            elif remarks.pending:
                remarks.line_goes_on()
        elif group == _COMMENT:
            remarks.comment(match.start(_COMMENT), match.end())
            continue
        else:
            assert group is not None
            kind = match[_MARK] if group == _MARK else _KIND_OF_GROUP[group]
            if remarks.pending:
                remarks.line_goes_on()
        add_kind(kind)
        add_start(match.start(_WORD if group == _DOTTED else group))
        add_end(match.end())
    for _ in range(3):
        add_kind("end")
        add_start(len(text))
        add_end(len(text))
    return Tokens(kinds, starts, ends, remarks.attached, remarks.left_over())


class _Remarks:
    """Attaches each comment to the token whose line of rules it speaks of.

    A comment on a line of its own belongs to the next line of rules, one behind rules to theirs. An empty string
    among the comments above stands for an empty line, so that a file's heading stays apart from its first rule.
    """

    def __init__(self, text: str, kinds: list[str], ends: array[int]) -> None:
        self.attached: dict[int, Comments] = {}
        self.pending: list[str] = []
        self._text = text
        self._kinds = kinds
        self._ends = ends
        self._last = -1
        self._end_of_comment = 0

    def line_starts(self, token: int, kind: str, start: int) -> None:
        if self.pending:
            if kind in _SETTINGS or self._is_gap(start):
                self._leave_gap()
            if kind not in _SETTINGS:
                self._attach(token, Comments(above=tuple(self.pending)))
                self.pending.clear()
        self._last = -1 if kind in _SETTINGS else token

    def line_goes_on(self) -> None:
        """The pending comments stand inside a line of rules: they are kept above it."""
        if self._last >= 0:
            before = self.attached.get(self._last, NO_COMMENTS)
            inside = tuple(text for text in self.pending if text)
            self._attach(self._last, Comments(before.above + inside, before.behind))
            self.pending.clear()

    def comment(self, start: int, end: int) -> None:
        text = self._text[start:end]
        words = text[1 if text[0] == "#" else 2 :].strip()
        before_it = max(self._ends[-1] if self._ends else 0, self._end_of_comment)
        is_behind = bool(self._ends) and "\n" not in self._text[before_it:start]
        if is_behind and self._last >= 0:
            before = self.attached.get(self._last, NO_COMMENTS)
            if before.behind is None:
                self._attach(self._last, Comments(before.above, words))
            else:
                self._attach(self._last, Comments((*before.above, words), before.behind))
        else:
            if self.pending and self._is_gap(start):
                self._leave_gap()
            self.pending.append(words)
            if is_behind:
                self._leave_gap()
        self._end_of_comment = end

    def left_over(self) -> tuple[str, ...]:
        return tuple(self.pending)

    def _attach(self, token: int, comments: Comments) -> None:
        self.attached[token] = comments

    def _is_gap(self, start: int) -> bool:
        return self._text.count("\n", self._end_of_comment, start) > 1

    def _leave_gap(self) -> None:
        if self.pending[-1]:
            self.pending.append("")
