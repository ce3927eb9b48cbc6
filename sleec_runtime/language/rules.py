"""Rules: ``WHEN trigger AND guard THEN response UNLESS condition IN WHICH CASE response …``."""

from __future__ import annotations

import re

from sleec_runtime.language.cursor import MAX_DEPTH, Abandon, quoted
from sleec_runtime.language.declarations import DeclarationParser
from sleec_runtime.language.keywords import IN_WHICH_CASE, PHRASE, STATEMENTS
from sleec_runtime.language.suggest import edits
from sleec_runtime.model import NO_COMMENTS, NOWHERE, Clause, Formula, Obligation, Or, Rule, Span

_LABEL = re.compile(r"\w(?:[\w.'\u2019-]*\w)?")
_RULE_STOPS = STATEMENTS | {"UNLESS"}
_Response = tuple[tuple[Obligation, ...], tuple[Clause, ...]]


class RuleParser(DeclarationParser):
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
        except Abandon:
            self._recover()
        hedges: list[Clause] = []
        while self.kinds[self.at] == "UNLESS":
            self.begin_clause()
            try:
                hedge = self._hedge()
                hedges.append(hedge)
                end = self.at
                self._end_of_clause("AND, UNLESS or the next rule" if hedge.obligations else "AND, OR or IN WHICH CASE")
            except Abandon:
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

    def begin_clause(self) -> None:
        """From here on a problem is a new one."""
        self.hurt = False
        self.depth = 0
        self.deepest = 0

    def _recover(self) -> None:
        self._unbalanced = True
        self.skip(_RULE_STOPS)

    # Parts of a rule ------------------------------------------------------------------------------------------

    def _label(self) -> tuple[str, Span]:
        self.begin_clause()
        self.at += 1
        at = self.at
        try:
            match = (
                _LABEL.match(self.text, self.starts[at])
                if self.kinds[at] in PHRASE or self.kinds[at] == "dotted"
                else None
            )
            if match is None:
                self.expected("a label after RULE", "a label is one word, as in: RULE dress_assist")
            span = Span(*match.span())
            while self.starts[self.at] < span.end:
                self.at += 1
            if self.kinds[self.at] in PHRASE:
                keyword = self.keyword_meant(self.at, self.token_text(self.at), at)
                if keyword in ("WHEN", "IF"):
                    self.misspelt(self.at, keyword)
                else:
                    self._long_label(at)
            self.names.label(match[0], span)
            if self.kinds[self.at] not in ("WHEN", "IF"):
                self.expected("WHEN after the label of the rule", "as in: RULE dress_assist WHEN trigger THEN response")
            return match[0], span
        except Abandon:
            self.skip(STATEMENTS)
            return "", NOWHERE

    def _long_label(self, first: int) -> None:
        while self.kinds[self.at] in PHRASE:
            self.at += 1
        label = self.text[self.starts[first] : self.ends[self.at - 1]]
        self.fail(
            f"a label is one word, but found {quoted(label)}",
            self.span(first),
            f"write RULE {'_'.join(label.split())[:60]}",
        )

    def _opening(self, labelled: bool) -> tuple[str, Span, Formula | None, Clause]:
        first = self.at
        self.at += 1
        at_trigger = self.at
        if self.kinds[at_trigger] != "word":
            self.no_name("a trigger", self._hint_at_trigger())
        trigger = self.name("a trigger") or self.expected("a trigger")
        trigger_span = self.span(at_trigger)
        if not self.hurt:
            self.names.use("trigger", trigger, trigger_span)
        guard = None
        if self.kinds[self.at] == "AND":
            self.at += 1
            self.leaf = self.names.condition
            guard = self.formula()
            if isinstance(guard, Or):
                self._leave_room(self.deepest)
        self._comma_before("THEN")
        if self.kinds[self.at] != "THEN":
            self._no_then(guard is not None)
        self.at += 1
        obligations, hedges = self._response()
        comments = self.comments_of(first) if labelled else NO_COMMENTS
        return trigger, trigger_span, guard, Clause(None, obligations, hedges, self.span(first), comments)

    def _hedge(self) -> Clause:
        first = self.at
        self.at += 1
        self.leaf = self.names.condition
        condition = self.formula()
        self._comma_before(IN_WHICH_CASE)
        obligations: tuple[Obligation, ...] = ()
        hedges: tuple[Clause, ...] = ()
        kind = self.kinds[self.at]
        if kind == IN_WHICH_CASE or kind == "IN":
            self._in_which_case()
            obligations, hedges = self._response(may_be_empty=True)
            if len(obligations) > 1 and not hedges:
                self._leave_room(self.depth)
        elif kind in ("WHICH", "CASE", "THEN"):
            self.expected(
                "IN WHICH CASE after the condition", "as in: UNLESS UserUndressed IN WHICH CASE RefuseRequest"
            )
        return Clause(condition, obligations, hedges, self.span(first), self.comments_of(first))

    def _in_which_case(self) -> None:
        self.at += 1
        if self.kinds[self.at - 1] == IN_WHICH_CASE:
            return
        for keyword in ("WHICH", "CASE"):
            at = self.at
            if self.kinds[at] == keyword:
                self.at += 1
            elif self.kinds[at] == "word" and edits(self.token_text(at)[:20].upper(), keyword, 3) < 3:
                self.misspelt(at, keyword)
                self.at += 1
            else:
                self.problem(
                    f"expected {keyword}, but found {self.found(at)}",
                    self.token_span(at),
                    "the three words IN WHICH CASE stand before what is to be done",
                )

    # Responses ------------------------------------------------------------------------------------------------

    def _response(self, may_be_empty: bool = False) -> _Response:
        """Obligations, or a whole chain in parentheses, which may start with UNLESS if `may_be_empty`."""
        if self.kinds[self.at] != "(":
            return self._obligations([]), ()
        opened = self.at
        self.deeper()
        self.at += 1
        obligations: tuple[Obligation, ...] = ()
        inner: tuple[Clause, ...] = ()
        if not may_be_empty or self.kinds[self.at] != "UNLESS":
            obligations, inner = self._response(may_be_empty)
        hedges = list(inner)
        while self.kinds[self.at] == "UNLESS":
            if inner:
                self.expected(
                    "a closing parenthesis", "a chain in parentheses has its exceptions inside the same parentheses"
                )
            hedges.append(self._hedge())
        self._close(opened)
        if self.kinds[self.at] == "AND":
            if hedges:
                self.expected(
                    "the end of the response", "UNLESS in parentheses is the whole response: write a rule for the rest"
                )
            self.at += 1
            obligations = self._obligations(list(obligations))
        return obligations, tuple(hedges)

    def _obligations(self, found: list[Obligation]) -> tuple[Obligation, ...]:
        self._literal(found)
        while self.kinds[self.at] == "AND":
            self.at += 1
            self._literal(found)
        return tuple(found)

    def _literal(self, found: list[Obligation]) -> None:
        first = self.at
        if self.kinds[first] == "(":
            self.deeper()
            self.at += 1
            self._obligations(found)
            if self.kinds[self.at] == "UNLESS":
                self.expected("a closing parenthesis", "a chain in parentheses must be the whole response")
            self._close(first)
            return
        negated = self.kinds[first] == "NOT"
        if negated:
            self.at += 1
            if self.kinds[self.at] in ("(", "NOT"):
                self.expected(
                    "the name of an obligation after NOT",
                    "NOT forbids one obligation: write NOT A AND NOT B, or forbid both together with NEVER A AND B",
                )
        at_name = self.at
        if self.kinds[at_name] != "word":
            self.no_name("an obligation", self._hint_at_obligation())
        name = self.name("an obligation")
        if not name:
            self._literal(found)
            return
        span = self.span(at_name)
        if not self.hurt:
            self.names.use("obligation", name, span)
        found.append(Obligation(name, negated, self.span(first) if negated else span))

    def _close(self, opened: int) -> None:
        if self.kinds[self.at] == "OR":
            self._no_choice()
        if self.kinds[self.at] != ")":
            self.missing_parenthesis(opened)
        self.at += 1
        self.depth -= 1

    def _leave_room(self, depth: int) -> None:
        """The printer adds parentheses here, and what it prints must be readable again."""
        if depth >= MAX_DEPTH:
            self.too_deep()

    def _comma_before(self, keyword: str) -> None:
        """Prose has commas before its clauses; they do no harm."""
        if self.kinds[self.at] == "," and self.kinds[self.at + 1] in (keyword, keyword[:2]):
            self.at += 1

    def _end_of_clause(self, what: str) -> None:
        self._comma_before("UNLESS")
        if self.kinds[self.at] == "." and self.kinds[self.at + 1] in (*_RULE_STOPS, "end"):
            self.at += 1
        kind = self.kinds[self.at]
        while kind == ")" and self._unbalanced:
            self.at += 1
            kind = self.kinds[self.at]
        if kind in _RULE_STOPS or kind == "end":
            return
        if kind == "OR":
            self._no_choice()
        if kind == "THEN":
            self.expected(what, "a rule has one THEN; each exception is UNLESS condition IN WHICH CASE response")
        if kind in ("IN", IN_WHICH_CASE):
            self.expected(what, "IN WHICH CASE follows the condition of an UNLESS; is UNLESS missing?")
        self.end_of_statement(what)

    # Explanations ---------------------------------------------------------------------------------------------

    def _no_choice(self) -> None:
        self.expected(
            "the end of the response",
            "a response is not a choice: join obligations with AND, or say with UNLESS when another one is due",
        )

    def _no_then(self, guarded: bool) -> None:
        kind = self.kinds[self.at]
        if kind == "OR" and not guarded:
            self.expected("AND or THEN after the trigger", "a rule has one trigger: write one rule for each")
        if kind == "operator" and not guarded:
            self.expected(
                "AND or THEN after the trigger",
                "a rule begins with something that happens: WHEN Trigger AND UserAge < 18 THEN ...",
            )
        if kind == "end" or kind in _RULE_STOPS:
            self.expected("THEN and a response", "every rule says what is to be done: WHEN trigger THEN response")
        self.expected("THEN after the condition" if guarded else "THEN after the trigger")

    def _hint_at_trigger(self) -> str | None:
        kind = self.kinds[self.at]
        if kind == "(":
            return "the trigger is a single name, without parentheses; what follows it after AND may have them"
        if kind == "NOT":
            return "a trigger is something that happens; write WHEN Trigger AND NOT condition THEN ..."
        if kind == "THEN":
            return "every rule says what sets it off: WHEN trigger THEN response"
        return None

    def _hint_at_obligation(self) -> str | None:
        kind = self.kinds[self.at]
        if kind in ("AND", "OR", ")"):
            return f"there is nothing before {kind}" if kind != ")" else "there is nothing in the parentheses"
        if kind == "end" or kind in _RULE_STOPS:
            return "say what is to be done"
        return None
