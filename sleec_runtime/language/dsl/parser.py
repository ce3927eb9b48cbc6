"""A text in the DSL as a whole: its blocks, and the statements in them.

Definitions are read first, wherever their block stands; then everything in the order of the text.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NoReturn, TypeVar, cast

from sleec_runtime.errors import LanguageError, Problem
from sleec_runtime.language.common.gc_pause import gc_paused
from sleec_runtime.language.common.problems import first_problems, quoted
from sleec_runtime.language.common.token_cursor import ClauseError
from sleec_runtime.language.dsl.comparisons import DslComparisons
from sleec_runtime.language.dsl.dialects import dialect_of
from sleec_runtime.language.dsl.hints import DEFINITION_END, RULE_EXAMPLE, example_of
from sleec_runtime.language.dsl.keywords import (
    BLOCK_MARKS,
    BLOCKS,
    DEFINITIONS,
    EFFECTS,
    EVENT_RELATIONS,
    ITEM_STARTS,
    UNNAMED,
)
from sleec_runtime.language.dsl.rules import DslRuleParser
from sleec_runtime.language.dsl.scanner import scan
from sleec_runtime.model import ClaimKind, Constant, Rule, Ruleset, Source, Span, Statement
from sleec_runtime.support.suggestions import did_you_mean, nearest

_Read = TypeVar("_Read")
_ITEMS = {
    "def_start": ("definition", "an event, a measure or a constant", "for example: event SmokeDetected"),
    "rule_start": ("rule", "a rule", RULE_EXAMPLE),
    "concern_start": ("concern", "a concern", "for example: c1 when Event and {condition} then not Response"),
    "purpose_start": ("purpose", "a purpose", "for example: p1 exists Event and {condition}"),
    "relation_start": ("relation", "a relation", "for example: mutualExclusive A B"),
}
"""What each block holds: its short name, its name in messages, and an example."""


def parse_dsl(source: Source) -> Ruleset:
    """Parses a text, in either dialect.

    Raises:
        LanguageError: with every problem, in the order of the text.
    """
    problems: list[Problem] = []
    with gc_paused():
        tokens = scan(source.text)
        dialect = dialect_of(tokens)
        names = DslComparisons(source, problems, "def_start" in tokens.kinds)
        statements = DslParser(source, tokens, dialect, problems, names).statements()
    if problems:
        names.count_uses()
        raise LanguageError(source, first_problems(problems))
    return Ruleset(
        statements=tuple(statements),
        reading="priority",
        syntax="dsl",
        dialect=dialect,
        calculated_with=frozenset(names.calculated_with),
        defects=tuple(sorted(names.defects, key=lambda defect: defect.span)),
        source=source,
        closing_comments=tokens.closing,
    )


class DslParser(DslRuleParser):
    """Reads a whole text, once."""

    def statements(self) -> list[Statement]:
        """All statements in text order. What cannot be parsed is reported as a problem."""
        self.constants = {}
        defined = self._definitions()
        found: list[Statement] = []
        self.at = 0
        while self.kinds[self.at] != "end":
            opened = self._open()
            if opened is None:
                break
            block = self.kinds[opened]
            while True:
                statement: Statement | None
                if block == "def_start" and self.at in defined:
                    statement, self.at = defined[self.at]
                    if isinstance(statement, Constant):
                        known = self.names.constants.get(statement.name, statement)
                        statement = replace(statement, value=known.value)
                elif self.kinds[self.at] in BLOCK_MARKS or self.kinds[self.at] == "end":
                    break
                else:
                    statement = self._item(block)
                if statement is not None:
                    found.append(statement)
            self.end_of_block(opened)
        if not self.problems and not any(isinstance(statement, Rule) for statement in found):
            hint = "write them between rule_start and rule_end"
            self.problems.append(Problem("there are no rules in this text", Span(0, 0), hint))
        return found

    def _definitions(self) -> dict[int, tuple[Statement | None, int]]:
        """The definitions by the token they start at, each with the token after it."""
        defined: dict[int, tuple[Statement | None, int]] = {}
        self.item = "definition"
        inside = False
        for token, kind in enumerate(self.kinds):
            if kind in BLOCK_MARKS:
                inside = kind == "def_start"
                if inside and self.kinds[token + 1] not in ITEM_STARTS:
                    self.at = token + 1
                    self._read(self._refuse_definition, "")
                    # A keyword that is corrected in place is read as such.
                    if self.at > token + 1:
                        defined[token + 1] = None, self.at
            elif inside and kind in DEFINITIONS:
                self.at = token
                statement = self._read(self.definition, DEFINITION_END)
                self.names.complete = self.names.complete and statement is not None
                defined[token] = statement, self.at
        self.names.check_values()
        self.names.define_constants(self.constants)
        return defined

    def _refuse_definition(self) -> NoReturn:
        self.names.complete = False
        self.expected("an event, a measure or a constant", example_of(DEFINITION_END))

    def _open(self) -> int | None:
        """Reads the keyword that opens a block; None at the end."""
        if self.kinds[self.at] not in BLOCKS:
            self.begin_clause()
            try:
                self._refuse_outside_block()
            except ClauseError:
                self.names.complete = False
                self.at += 1
                self.skip(BLOCKS)
        if self.kinds[self.at] == "end":
            return None
        self.at += 1
        return self.at - 1

    def _refuse_outside_block(self) -> None:
        written = self.token_text(self.at)
        if self.kinds[self.at] in BLOCKS.values():
            self.fail(f"this `{written}` closes no block", self.token_span(self.at), "delete it")
        near = written.lower() if written.lower() in BLOCKS else nearest(written.lower(), sorted(BLOCKS))
        if near is not None:
            self.fail(
                f"{quoted(written)} is not a keyword; did you mean `{near}`?",
                self.token_span(self.at),
                f"replace it with {near}",
            )
        block = "def_start" if self.kinds[self.at] in DEFINITIONS else "rule_start"
        self.expected(
            f"the start of a block, such as {block}",
            f"write {_ITEMS[block][0]}s between {block} and {BLOCKS[block]}",
        )

    def _item(self, block: str) -> Statement | None:
        self.item, what, example = _ITEMS[block]
        kind = self.kinds[self.at]
        if block == "relation_start" and kind == "relation":
            return self._read(self.relation, "the next relation")
        if kind in ("label", UNNAMED):
            if block in ("concern_start", "purpose_start"):
                of = cast("ClaimKind", self.item)
                return self._read(lambda: self.claim(of), f"the next {of}")
            if block == "rule_start":
                return self.rule()
        self.begin_clause()
        at = self.at
        try:
            if block == "relation_start":
                near = nearest(self.token_text(at), sorted(EVENT_RELATIONS | EFFECTS))
                self.expected(what, did_you_mean(near) or example)
            if block in ("concern_start", "purpose_start") and kind == self.kinds[at + 1] == "word":
                self.at += 1
                self.expected("`when` or `exists`", example)
            self.refuse_item(what, example)
        except ClauseError:
            self.names.complete = self.names.complete and block != "def_start"
            if self.kinds[at] == kind:
                self.at = at + 1
            self.skip(ITEM_STARTS)
            return None

    def _read(self, read: Callable[[], _Read], what: str) -> _Read | None:
        """What `read` reads, to the end of the item; None if there was a problem."""
        self.begin_clause()
        try:
            found = read()
            self.end_of_item(what)
        except ClauseError:
            self.skip(ITEM_STARTS)
            return None
        return None if self.has_failed else found
