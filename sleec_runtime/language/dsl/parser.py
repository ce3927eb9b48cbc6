"""A text in the DSL as a whole: its blocks, and the rules, concerns, purposes and relations in them.

Definitions are read first, wherever their block stands; then everything in the order of the text.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeVar, cast

from sleec_runtime.errors import LanguageError, Problem
from sleec_runtime.language.common.gc_pause import uncollected
from sleec_runtime.language.common.problems import first_problems, quoted
from sleec_runtime.language.common.token_cursor import Abandon
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.blocks import misspelt_marks
from sleec_runtime.language.dsl.comparisons import Terms
from sleec_runtime.language.dsl.dialects import dialect_of
from sleec_runtime.language.dsl.keywords import BLOCKS, DEFINITIONS, EFFECTS, EVENT_RELATIONS, ITEM_STARTS, UNNAMED
from sleec_runtime.language.dsl.misspelt import misspelt, misspelt_whens
from sleec_runtime.language.dsl.relations import OF_MEASURES, RelationParser
from sleec_runtime.language.dsl.scanner import mark_relations, scan
from sleec_runtime.model import ClaimKind, Clause, Constant, Formula, Rule, Ruleset, Source, Span, Statement
from sleec_runtime.support.suggestions import nearest

_Read = TypeVar("_Read")
_WHAT = {
    "def": "definitions",
    "rule": "rules",
    "concern": "concerns",
    "purpose": "purposes",
    "relation": "relations",
}
_BELONGS = {
    "def_start": ("an event, a measure or a constant", "define something, as in: event SmokeDetected"),
    "rule_start": ("a rule", "a rule looks like this: R1 when Event then Response"),
    "concern_start": ("a concern", "a concern looks like this: c1 when Event and {condition} then not Response"),
    "purpose_start": ("a purpose", "a purpose looks like this: p1 exists Event and {condition}"),
    "relation_start": ("a relation", "a relation looks like this: mutualExclusive A B"),
}


def parse_dsl(source: Source) -> Ruleset:
    """The ruleset that `source` spells out, in either dialect.

    Raises:
        LanguageError: with every problem, in the order of the text.
    """
    problems: list[Problem] = []
    with uncollected():
        tokens = scan(source.text)
        _read_misspelt_marks(source, tokens, problems)
        dialect = dialect_of(tokens)
        names = Terms(source, problems, "def_start" in tokens.kinds)
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


def _read_misspelt_marks(source: Source, tokens: Tokens, problems: list[Problem]) -> None:
    """Reports the misspelt keywords of blocks, and makes of them in `tokens` what they are meant to be."""
    for token, mark in misspelt_marks(source.text, tokens):
        span = Span(tokens.starts[token], tokens.ends[token])
        written = quoted(source.text[span.start : span.end])
        problems.append(Problem(f"{written} is no keyword; did you mean {mark}?", span, f"write {mark}"))
        tokens.kinds[token] = mark
    if problems:
        mark_relations(source.text, tokens.kinds, tokens.starts, tokens.ends)


class DslParser(RelationParser):
    """Reads a whole text, once."""

    _hedges_of_rules: set[int] | None = None
    """Every `unless` that begins a hedge of a rule, once a problem makes it worth knowing."""

    def statements(self) -> list[Statement]:
        """Everything in the text, in its order; what could not be read is among the problems instead."""
        self.constants = {}
        defined = self._definitions()
        self._read_misspelt_whens()
        found: list[Statement] = []
        self.at = 0
        rules = 0
        while self.kinds[self.at] != "end":
            opened = self._open()
            if opened is None:
                break
            block = self.kinds[opened]
            before = len(found)
            while True:
                kind = self.kinds[self.at]
                if block == "def_start" and self.at in defined:
                    statement, self.at = defined[self.at]
                    if isinstance(statement, Constant):
                        known = self.names.constants.get(statement.name, statement)
                        statement = replace(statement, value=known.value)
                elif kind in BLOCKS.values() or kind in BLOCKS or kind == "end":
                    break
                else:
                    statement = self._item(block)
                if statement is not None:
                    found.append(statement)
            rules += sum(isinstance(s, Rule) for s in found[before:]) if block == "rule_start" else 0
            self.end_of_block(opened)
        if not rules and not self.problems:
            self.problems.append(
                Problem("there are no rules in this text", Span(0, 0), "write them between rule_start and rule_end")
            )
        return found

    def _definitions(self) -> dict[int, tuple[Statement | None, int]]:
        """The definitions by the token they start at, each with the token behind it."""
        defined: dict[int, tuple[Statement | None, int]] = {}
        wrong = {one.token: one for one in misspelt(self.source.text, self.tokens)}
        for token, one in wrong.items():
            self.kinds[token] = one.keyword
            self.problems.append(Problem(one.message, self.token_span(token), one.hint))
        inside = False
        for token, kind in enumerate(self.kinds):
            if kind in BLOCKS or kind in BLOCKS.values():
                inside = kind == "def_start"
            elif inside and kind in DEFINITIONS:
                self.at = token
                has_keyword = token not in wrong or wrong[token].has_keyword
                statement = self._read(partial(self.definition, has_keyword), "the next definition")
                self.names.complete = self.names.complete and statement is not None
                defined[token] = statement, self.at
        self.names.check_values()
        self.names.define_constants(self.constants)
        return defined

    def _read_misspelt_whens(self) -> None:
        for token in misspelt_whens(self.text, self.tokens):
            self.kinds[token - 1], self.kinds[token] = "label", "when"
            said = f"{quoted(self.token_text(token))} is no keyword; did you mean when?"
            hint = "a rule looks like this: R1 when Event then Response"
            self.problems.append(Problem(said, self.token_span(token), hint))

    def _open(self) -> int | None:
        """Reads the keyword that opens a block; None at the end."""
        if self.kinds[self.at] not in BLOCKS:
            self.begin_clause()
            try:
                if self.kinds[self.at] in BLOCKS.values():
                    self.fail(f"this {self.token_text(self.at)} closes no block", self.token_span(self.at), "delete it")
                block, what = next(
                    ((name, what) for name, what in _WHAT.items() if self.token_text(self.at).lower().startswith(name)),
                    ("def", "definitions") if self.kinds[self.at] in DEFINITIONS else ("rule", "rules"),
                )
                hint = f"{what} stand between {block}_start and {block}_end"
                self.expected(f"the start of a block, such as {block}_start", hint)
            except Abandon:
                self.names.complete = False
                self.at += 1
                self.skip(BLOCKS)
        if self.kinds[self.at] == "end":
            return None
        self.at += 1
        return self.at - 1

    def _item(self, block: str) -> Statement | None:
        kind = self.kinds[self.at]
        self.item = block[:7] if block in ("concern_start", "purpose_start") else "rule"
        if block == "relation_start" and kind == "relation":
            return self._read(self.relation, "the next relation")
        begins = kind in ("label", UNNAMED)
        keyword = self._keyword() if begins else self.at
        if block == "rule_start" and begins and (self.kinds[keyword] == "when" or self.token_text(keyword) == "when"):
            return self._rule()
        if block in ("concern_start", "purpose_start") and begins:
            of = cast("ClaimKind", self.item)
            return self._read(lambda: self.claim(of), f"the next {of}")
        what, hint = _BELONGS[block]
        self.begin_clause()
        try:
            if block == "rule_start" and kind in ("when", "word") and self.kinds[self.at - 1] not in BLOCKS:
                hint = "every rule begins with its name: R1 when Event then Response"
            if begins and block == "rule_start":
                self.fail(
                    f"exists asks whether something can be, and {what} says what must be",
                    self.token_span(keyword),
                    "write when, or move it to the concerns or purposes",
                )
            if block == "rule_start":
                self.refuse_begin_of_rule()
            self.expected(f"{what}", self._hint_at_claim(block) or hint)
        except Abandon:
            self.at += 1
            self.skip(ITEM_STARTS)
            return None

    def _hint_at_claim(self, block: str) -> str | None:
        """What a claim or relation that begins with the token at hand may be meant to be."""
        word, second = self.token_text(self.at), self.token_text(self.at + 1)
        if block == "relation_start":
            if word in OF_MEASURES:
                return f"as in: measure {word} ..."
            near = nearest(word, sorted(EVENT_RELATIONS | EFFECTS))
            return f"did you mean {near}?" if near is not None else None
        if block in ("concern_start", "purpose_start") and self.kinds[self.at + 1] == "word":
            near = nearest(second, ("when", "exists"))
            return f"did you mean {near} for {quoted(second)}?" if near is not None else None
        return None

    def _keyword(self) -> int:
        """The ``when`` or ``exists`` of the rule or claim that begins here."""
        at = self.at
        if self.kinds[at] == "label":
            at += 2 if self.kinds[at + 1] == ":" else 1
        return at

    def _read(self, read: Callable[[], _Read], what: str) -> _Read | None:
        """What `read` reads, to the end of the item; None if there was a problem."""
        self.begin_clause()
        try:
            found = read()
            self.end_of(what)
        except Abandon:
            self.skip(ITEM_STARTS)
            return None
        return None if self.hurt else found

    def recover(self) -> None:
        """On to the next hedge of the rule, or behind the rule. What brackets hold is no hedge of the rule."""
        if self._hedges_of_rules is None:
            self._hedges_of_rules = self._outside_brackets()
        while self.kinds[self.at] not in ITEM_STARTS and self.at not in self._hedges_of_rules:
            self.at += 1

    def _outside_brackets(self) -> set[int]:
        """Every `unless` that neither braces nor parentheses hold; what is not closed before the next rule begins holds
        nothing."""
        outside: list[int] = []
        opened: dict[str, list[int]] = {"}": [], ")": []}
        for token, kind in enumerate(self.kinds):
            if kind == "unless":
                outside.append(token)
            elif kind in ("{", "("):
                opened["}" if kind == "{" else ")"].append(token)
            elif kind in opened:
                opening = opened[kind].pop() if opened[kind] else token
                while outside and outside[-1] > opening:
                    outside.pop()
            elif kind in ITEM_STARTS:
                for openings in opened.values():
                    openings.clear()
        return set(outside)

    # Rules ----------------------------------------------------------------------------------------------------

    def _rule(self) -> Rule | None:
        first = self.at
        self.names_events = True
        label, label_span = self.label("rule")
        self.at += 1
        opening: tuple[str, Span, Formula | None, Clause] | None = None
        self.begin_clause()
        try:
            trigger, trigger_span, guard = self.occasion("a trigger")
            at_then = self.at
            several = self.kinds[self.at] == "or"
            self.require(
                "then",
                "then and a response",
                "one event triggers a rule: write a rule for each"
                if several
                else "every rule says what is to be done: R1 when Event then Response",
            )
            opening = trigger, trigger_span, guard, self.chain(None, at_then)
            end = self.at
            if self.kinds[self.at] != "unless":
                self.end_of("unless or the next rule")
        except Abandon:
            self.recover()
        hedges: list[Clause] = []
        self.hedges(hedges, "unless or the next rule")
        if opening is None:
            return None
        trigger, trigger_span, guard, default = opening
        end_of_rule = hedges[-1].span.end if hedges else self.ends[end - 1] if not self.hurt else default.span.end
        return Rule(
            label,
            trigger,
            guard,
            default,
            tuple(hedges),
            None,
            True,
            Span(label_span.start, end_of_rule),
            label_span,
            trigger_span,
            self.comments_of(first),
        )
