"""A text in structured English as a whole, with its settings (docs/language.md).

A statement ends where the keyword of the next one is, so a line break is like a space. Declarations are read first,
wherever they are, and NEVER and ASSUME last: the kind of a name in them depends on its use in the rules.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

from sleec_runtime.errors import LanguageError, Problem
from sleec_runtime.language.common.gc_pause import gc_paused
from sleec_runtime.language.common.problems import first_problems, quoted
from sleec_runtime.language.common.token_cursor import ClauseError
from sleec_runtime.language.english.always import Always, EnglishAlwaysParser, instances
from sleec_runtime.language.english.keyword_correction import near_keyword
from sleec_runtime.language.english.keywords import CLAIMS, DECLARATIONS, OPENINGS, RULE_STARTS, STATEMENTS
from sleec_runtime.language.english.name_resolution import EnglishNames
from sleec_runtime.language.english.scanner import scan
from sleec_runtime.model import (
    READINGS,
    Assume,
    Constant,
    Never,
    Reading,
    Rule,
    Ruleset,
    Source,
    Span,
    Statement,
)
from sleec_runtime.support.suggestions import did_you_mean, nearest

EVERYWHERE = "everywhere"
DEFAULT_READING: Reading = "cascade"

_Read = TypeVar("_Read")


def parse_english(source: Source) -> Ruleset:
    """Parses a text.

    Raises:
        LanguageError: with every problem, in the order of the text.
    """
    problems: list[Problem] = []
    with gc_paused():
        tokens = scan(source.text)
        parser = EnglishParser(source, tokens, problems, EnglishNames(source, problems))
        statements = parser.statements()
    if problems:
        raise LanguageError(source, first_problems(problems))
    return Ruleset(
        statements=tuple(statements),
        reading=parser.reading or DEFAULT_READING,
        syntax="english",
        inferred=tuple(measure for _, measure in sorted(parser.names.inferred.items())),
        reading_stated=parser.reading is not None,
        source=source,
        closing_comments=tokens.closing,
    )


class EnglishParser(EnglishAlwaysParser):
    """Reads a whole text, once."""

    def statements(self) -> list[Statement]:
        """All statements in text order. What cannot be parsed is reported as a problem."""
        self.domains = None
        self.reading: Reading | None = None
        self.rules_so_far = 0
        self.numbered = {}
        self.constants = {}
        self._reading_span: Span | None = None
        self._found: list[Statement | Always | None] = []
        self._postponed: list[tuple[int, int, tuple[str, ...] | None]] = []
        declared = self._declarations()
        self._in_order(declared)
        # Assumptions first: their conditions are also conditions in NEVER.
        for keyword in ("ASSUME", "NEVER"):
            for index, token, domains in self._postponed:
                if self.kinds[token] == keyword:
                    self.at = token
                    self.domains = domains
                    read: Callable[[], Assume | Never] = self.assume if keyword == "ASSUME" else self.never
                    self._found[index] = self._read(read)
        statements = list(self._expanded())
        self.names.numbered(self.numbered)
        self.names.finish()
        if not self.rules_so_far and not self.problems:
            self.problems.append(
                Problem(
                    "there are no rules in this text",
                    Span(0, 0),
                    "a rule looks like this: WHEN CurtainOpenRequest THEN OpenCurtains",
                )
            )
        return statements

    def _expanded(self) -> Iterator[Statement]:
        """The statements in text order, with the instances of each ALWAYS in its place."""
        rules = (statement for statement in self._found if isinstance(statement, Rule))
        triggers = dict.fromkeys([*(rule.trigger for rule in rules), *self.names.declared_triggers()])
        number = 0
        for statement in self._found:
            if isinstance(statement, Always):
                number += 1
                for rule in instances(statement, f"always_{number}", triggers):
                    self.numbered[rule.label] = statement.keyword
                    yield rule
            elif statement is not None:
                yield statement

    def _declarations(self) -> dict[int, tuple[Statement | None, int]]:
        """The declarations by the token they start at, each with the token after it."""
        declared: dict[int, tuple[Statement | None, int]] = {}
        for token in [token for token, kind in enumerate(self.kinds) if kind in DECLARATIONS]:
            self.at = token
            declared[token] = (self._declaration(), self.at)
        # An exception may name the trigger of a later rule.
        openings = [token for token, kind in enumerate(self.kinds) if kind in OPENINGS]
        self.names.triggers.update(self.name_at(token + 1) for token in openings)
        self.names.define_constants(self.constants)
        self.names.check_scales()
        return declared

    def _declaration(self) -> Statement | None:
        statement = self._read(self.declaration)
        if statement is None:
            self.names.complete = False
        return statement

    def _in_order(self, declared: dict[int, tuple[Statement | None, int]]) -> None:
        found, kinds = self._found, self.kinds
        self.at = 0
        while True:
            token = self.at = self._next_statement()
            kind = kinds[token]
            if kind in RULE_STARTS:
                found.append(self.rule())
            elif kind in DECLARATIONS:
                statement, self.at = declared.get(token) or (self._declaration(), self.at)
                if isinstance(statement, Constant):
                    statement = self.names.constants.get(statement.name)
                found.append(statement)
            elif kind in ("NEVER", "ASSUME"):
                self._postponed.append((len(found), token, self.domains))
                found.append(None)
                self.at += 1
                self.skip(STATEMENTS)
            elif kind == "ALWAYS":
                found.append(self._read(self.always))
            elif kind == "EXCLUSIVE":
                found.append(self._read(self.exclusive))
            elif kind == "DOMAIN":
                self._read(self._domain)
            elif kind == "READING":
                self._read(self._reading)
            elif kind == "end":
                return
            else:
                found.append(self._read(self.claim if kind in CLAIMS else self.relation))

    def _next_statement(self) -> int:
        """The current token if a statement starts there; else reports it, and moves to the next one that starts one."""
        if self.at == 0 and self.kinds[0] not in STATEMENTS and self.kinds[0] != "end":
            self.begin_clause()
            try:
                self._refuse_statement()
            except ClauseError:
                self.names.complete = False
                self.skip(STATEMENTS)
        return self.at

    def _refuse_statement(self) -> None:
        if self.kinds[0] == "word":
            written = self.token_text(0).upper()
            keyword = written if written in STATEMENTS else near_keyword(written)
            if keyword in STATEMENTS:
                self.correct_keyword(0, keyword)
                return
        if self.kinds[1] == ":":
            self.at = 1
        if self.kinds[0] == "UNLESS":
            self.expected(
                "a rule before this UNLESS",
                "an exception (UNLESS) is part of a rule: WHEN trigger THEN response UNLESS ...",
            )
        self.expected("a statement, such as RULE or WHEN", "a rule looks like this: WHEN trigger THEN response")

    def _read(self, read: Callable[[], _Read]) -> _Read | None:
        """What `read` reads, to the end of the statement; None if there was a problem."""
        self.begin_clause()
        try:
            found = read()
            self.end_of_statement("the next statement")
        except ClauseError:
            self.skip(STATEMENTS)
            return None
        return None if self.has_failed else found

    # Settings -------------------------------------------------------------------------------------------------

    def _domain(self) -> None:
        self.at += 1
        first = self.at
        if self.kinds[first] != "word":
            self.refuse_name("the name of a domain", "for example: DOMAIN hospital")
        names, _ = self.names_in_list("the name of a domain")
        if EVERYWHERE in names and len(names) > 1:
            self.fail(
                f"{quoted(EVERYWHERE)} means all domains, so it cannot be in a list with others",
                self.span(first),
                "write DOMAIN everywhere, or the names of the domains",
            )
        self.domains = None if EVERYWHERE in names else tuple(dict.fromkeys(names))

    def _reading(self) -> None:
        first = self.at
        self.at += 1
        at_name = self.at
        name = self.name("cascade or priority") or self.expected("cascade or priority")
        if name not in READINGS:
            near = nearest(name, READINGS)
            self.fail(
                f"no reading is called {quoted(name)}",
                self.span(at_name),
                did_you_mean(near) or "write READING cascade or READING priority",
            )
        if self._reading_span is not None:
            place = self.source.place(self._reading_span)
            self.fail(
                f"the reading is set twice; the first time in line {place.line}",
                self.span(first),
                "a text has one reading; delete one of them",
            )
        self._reading_span = self.span(first)
        self.reading = "cascade" if name == "cascade" else "priority"
