"""Rules: ``WHEN trigger AND guard THEN response UNLESS condition IN WHICH CASE response …``."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import NoReturn

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import ClauseError
from sleec_runtime.language.english.keywords import IN_WHICH_CASE, PHRASE, STATEMENTS
from sleec_runtime.language.english.responses import RULE_STOPS, EnglishResponseParser
from sleec_runtime.model import NO_COMMENTS, NOWHERE, Clause, Formula, Or, Rule, Span

_LABEL = re.compile(r"\w(?:[\w.'\u2019-]*\w)?")


class EnglishRuleParser(EnglishResponseParser):
    """Reads rules. A problem in one clause leaves the others readable."""

    domains: tuple[str, ...] | None
    rules_so_far: int
    numbered: dict[str, Span]

    def rule(self) -> Rule | None:
        """The rule at hand, or None if a part of it could not be read."""
        first = self.at
        self.rules_so_far += 1
        label, label_span = self._label() if self.kinds[first] == "RULE" else ("", NOWHERE)
        at_when = self.at
        if self.kinds[at_when] not in ("WHEN", "IF"):
            return None
        self._unbalanced = False
        opening: tuple[str, Span, Formula | None, Clause] | None = None
        self.begin_clause()
        try:
            opening = self._opening(first != at_when)
            end = self.at
            self._end_of_clause("AND, UNLESS or the next rule")
        except ClauseError:
            self._recover()
        hedges: list[Clause] = []
        while self.kinds[self.at] == "UNLESS":
            self.begin_clause()
            try:
                hedge = self.hedge()
                hedges.append(hedge)
                end = self.at
                self._end_of_clause("AND, UNLESS or the next rule" if hedge.obligations else "AND, OR or IN WHICH CASE")
            except ClauseError:
                self._recover()
        if opening is None:
            return None
        if not label:
            label = f"rule_{self.rules_so_far}"
            self.numbered[label] = self.token_span(first)
        trigger, trigger_span, guard, default = opening
        return Rule(
            label,
            trigger,
            guard,
            default,
            tuple(hedges),
            self.domains,
            label_span is not NOWHERE,
            Span(self.starts[first], self.ends[end - 1]),
            label_span,
            trigger_span,
            self.comments_of(first),
        )

    def _recover(self) -> None:
        self._unbalanced = True
        self.skip(RULE_STOPS)

    # Parts of a rule ------------------------------------------------------------------------------------------

    def _label(self) -> tuple[str, Span]:
        self.begin_clause()
        self.at += 1
        try:
            label, span = self.label_word("RULE", "dress_assist", ("WHEN", "IF"))
            self.names.label(label, span, "rule")
            if self.kinds[self.at] not in ("WHEN", "IF"):
                self.expected(
                    "WHEN after the label of the rule", "for example: RULE dress_assist WHEN trigger THEN response"
                )
            return label, span
        except ClauseError:
            self.skip(STATEMENTS)
            return "", NOWHERE

    def label_word(self, keyword: str, example: str, following: Collection[str]) -> tuple[str, Span]:
        """Reads the label after `keyword`; one of the keywords `following` comes next."""
        at = self.at
        match = (
            _LABEL.match(self.text, self.starts[at]) if self.kinds[at] in PHRASE or self.kinds[at] == "dotted" else None
        )
        if match is None:
            self.expected(f"a label after {keyword}", f"a label is one word, for example: {keyword} {example}")
        span = Span(*match.span())
        while self.starts[self.at] < span.end:
            self.at += 1
        if self.kinds[self.at] in PHRASE:
            meant = self.keyword_meant(self.at, self.token_text(self.at), at)
            if meant is None or meant not in following:
                self._refuse_label(at, keyword)
            self.correct_keyword(self.at, meant)
        return match[0], span

    def _refuse_label(self, first: int, keyword: str) -> NoReturn:
        while self.kinds[self.at] in PHRASE:
            self.at += 1
        label = self.text[self.starts[first] : self.ends[self.at - 1]]
        self.fail(
            f"a label is one word, but found {quoted(label)}",
            self.span(first),
            f"write {keyword} {'_'.join(label.split())[:60]}",
        )

    def _opening(self, labelled: bool) -> tuple[str, Span, Formula | None, Clause]:
        first = self.at
        self.at += 1
        at_trigger = self.at
        if self.kinds[at_trigger] != "word":
            self.refuse_name("a trigger", self._hint_at_trigger())
        trigger = self.name("a trigger") or self.expected("a trigger")
        trigger_span = self.span(at_trigger)
        if not self.has_failed:
            self.names.use("trigger", trigger, trigger_span)
        guard = None
        if self.kinds[self.at] == "AND":
            self.at += 1
            self.resolve = self.names.condition
            guard = self.formula()
            if isinstance(guard, Or):
                self.check_room(self.deepest)
        self.comma_before("THEN")
        if self.kinds[self.at] != "THEN":
            self._refuse_then(guard is not None)
        self.at += 1
        obligations, hedges = self.response()
        comments = self.comments_of(first) if labelled else NO_COMMENTS
        return trigger, trigger_span, guard, Clause(None, obligations, hedges, self.span(first), comments)

    def _end_of_clause(self, what: str) -> None:
        self.comma_before("UNLESS")
        if self.kinds[self.at] == "." and self.kinds[self.at + 1] in (*RULE_STOPS, "end"):
            self.at += 1
        kind = self.kinds[self.at]
        while kind == ")" and self._unbalanced:
            self.at += 1
            kind = self.kinds[self.at]
        if kind in RULE_STOPS or kind == "end":
            return
        if kind == "OR":
            self.refuse_choice()
        if kind == "(":
            self.expected(what, "write AND or OR before the parenthesis")
        if kind == "THEN":
            self.expected(what, "a rule has one THEN; write each exception as UNLESS condition IN WHICH CASE response")
        if kind in ("IN", IN_WHICH_CASE):
            self.expected(what, "IN WHICH CASE follows the condition of an UNLESS; is UNLESS missing?")
        self.end_of_statement(what)

    # Explanations ---------------------------------------------------------------------------------------------

    def _refuse_then(self, guarded: bool) -> None:
        kind = self.kinds[self.at]
        if kind == "OR" and not guarded:
            self.expected("AND or THEN after the trigger", "a rule has one trigger; write one rule for each")
        if kind == "operator" and not guarded:
            self.expected(
                "AND or THEN after the trigger",
                "a rule starts with an event: WHEN Trigger AND UserAge < 18 THEN ...",
            )
        if kind == "end" or kind in RULE_STOPS:
            self.expected("THEN and a response", "a rule needs a response: WHEN trigger THEN response")
        self.expected("THEN after the condition" if guarded else "THEN after the trigger")

    def _hint_at_trigger(self) -> str | None:
        kind = self.kinds[self.at]
        if kind == "(":
            return "the trigger is a single name; write parentheses only after AND"
        if kind == "NOT":
            return "a trigger is an event; write WHEN Trigger AND NOT condition THEN ..."
        if kind == "THEN":
            return "a rule needs a trigger: WHEN trigger THEN response"
        return None
