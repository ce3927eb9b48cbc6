"""Responses: ``[not] Event [within … | eventually] [otherwise …] [else …]``, and chains of exceptions.

What follows `otherwise`, `else` and the `then` of an exception has exceptions of its own only inside braces: an
`unless` without braces belongs to the rule.
"""

from __future__ import annotations

from sleec_runtime.language.common.token_cursor import ALTERNATIVE_LEVELS, ClauseError
from sleec_runtime.language.dsl.hints import CONDITION_END
from sleec_runtime.language.dsl.keywords import ITEM_STARTS
from sleec_runtime.language.dsl.windows import DslTimeParser
from sleec_runtime.model import NO_COMMENTS, Clause, Formula, Obligation, Timing


class DslResponseParser(DslTimeParser):
    """Reads responses."""

    def chain(self, condition: Formula | None, first: int) -> Clause:
        """A response as a clause that begins with token `first`: one event, or a chain in braces."""
        comments = NO_COMMENTS if condition is None else self.comments_of(first)
        if self.kinds[self.at] != "{":
            obligation = self._occurrence()
            return Clause(condition, (obligation,), (), self.span(first), comments)
        opened = self.at
        self.descend()
        self.at += 1
        obligation = self._occurrence()
        hedges: list[Clause] = []
        while self.kinds[self.at] == "unless":
            hedges.append(self.hedge())
        self.close("}", opened)
        self.depth -= 1
        return Clause(condition, (obligation,), tuple(hedges), self.span(first), comments)

    def hedge(self) -> Clause:
        """``unless condition [then response]``."""
        first = self.at
        self.at += 1
        condition = self.formula()
        if self.kinds[self.at] != "then":
            return Clause(condition, (), (), self.span(first), self.comments_of(first))
        self.at += 1
        return self.chain(condition, first)

    def hedges(self, found: list[Clause], what: str) -> None:
        """The hedges at hand; a problem in one leaves the others readable."""
        while self.kinds[self.at] == "unless":
            self.begin_clause()
            try:
                found.append(self.hedge())
                if self.kinds[self.at] != "unless":
                    self.end_of_item(what if found[-1].obligations else CONDITION_END)
            except ClauseError:
                self.recover()

    def recover(self) -> None:
        """On to the next hedge of the rule, or past the rule."""
        raise NotImplementedError

    def _occurrence(self) -> Obligation:
        first = self.at
        negated = self.accept("not")
        if negated and self.kinds[self.at] == "not":
            self.expected("the name of an event", "write not once")
        at_name = self.at
        if self.kinds[at_name] == "{":
            self.expected("the name of an event", "a response is an event; braces hold a measure or a whole chain")
        name = self.name("the name of an event", self._hint_at_response())
        if not (self.has_failed or self.precedes_mistake()):
            self.names.event(name, self.token_span(at_name), "a response")
        kind = self.kinds[self.at]
        if kind in ("and", "or"):
            self.fail(
                f"a response is one event, so `{kind}` cannot follow it",
                self.token_span(self.at),
                "write one rule for each event" if kind == "and" else "write else between the two",
            )
        window = self.window()
        alternatives: dict[str, Clause] = {}
        for word in ("otherwise", "else"):
            if self.accept(word):
                self.descend(ALTERNATIVE_LEVELS)
                alternatives[word] = self.chain(None, self.at)
                self.depth -= ALTERNATIVE_LEVELS
        if self.kinds[self.at] == "otherwise":
            self.expected("the end of the response", "a response has one otherwise; put the second one in braces")
        span = self.span(first)
        if window is None and not alternatives:
            return Obligation(name, negated, span)

        return Obligation(name, negated, span, Timing(window, alternatives.get("otherwise"), alternatives.get("else")))

    def _hint_at_response(self) -> str | None:
        kind = self.kinds[self.at]
        if kind in ("within", "eventually"):
            return f"the event comes first: Response {kind}{' 5 minutes' if kind == 'within' else ''}"
        if kind in ITEM_STARTS | {"unless", "otherwise"}:
            return "write what the robot must do, for example: then Response"
        return None
