"""Constraints on what the rules require: EXCLUSIVE, NEVER, ASSUME."""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.english.keywords import IN_WHICH_CASE
from sleec_runtime.language.english.relations import EnglishRelationParser
from sleec_runtime.model import And, Assume, Atom, Comments, Exclusive, Formula, Never, Not, leaves


class EnglishConstraintParser(EnglishRelationParser):
    """Reads constraints. They apply to the domains that are set."""

    def exclusive(self) -> Exclusive:
        first = self.at
        self.at += 1
        names, spans = self.names_in_list("the name of an obligation")
        seen: set[str] = set()
        for name, span in zip(names, spans):
            if name in seen:
                self.fail(
                    f"{quoted(name)} is twice in this EXCLUSIVE",
                    span,
                    f"delete one of them; to forbid it, write NEVER {name}",
                )
            seen.add(name)
            if not self.has_failed:
                self.names.use("obligation", name, span)
        if len(names) < 2:
            self.expected(
                "a comma and another obligation",
                f"EXCLUSIVE needs two or more obligations; to forbid one, write NEVER {names[0]}",
            )
        return Exclusive(names, self.domains, self.span(first), spans, self.comments_of(first))

    def never(self) -> Never:
        first = self.at
        self.at += 1
        self.resolve = self.names.forbidden
        formula = self.formula()
        comments = [self.comments_of(first)]
        exceptions: list[Formula] = []
        while self.kinds[self.at] == "UNLESS":
            comments.append(self.comments_of(self.at))
            exceptions.append(self._exception())
        span = self.span(first)
        if not any(isinstance(leaf, Atom) and leaf.kind == "obligation" for leaf in leaves(formula)):
            self.problem(
                "this NEVER contains no obligation, so the robot cannot avoid it",
                span,
                "if this situation cannot occur, write ASSUME NOT (...)",
            )
        if exceptions:
            operands = formula.operands if isinstance(formula, And) else (formula,)
            formula = And((*operands, *exceptions), span)
        return Never(formula, self.domains, span, _on_one_line(comments), len(exceptions))

    def _exception(self) -> Not:
        """``UNLESS condition`` after NEVER, as the negated condition."""
        first = self.at
        self.at += 1
        self.resolve = self.names.condition
        condition = self.formula()
        if self.kinds[self.at] in (IN_WHICH_CASE, "IN"):
            hint = "a NEVER has no response: write ALWAYS NOT x UNLESS condition IN WHICH CASE response"
            self.expected("the next statement", hint)
        return Not(condition, self.span(first))

    def assume(self) -> Assume:
        first = self.at
        self.at += 1
        self.resolve = self.names.assumed
        formula = self.formula()
        return Assume(formula, self.domains, self.span(first), self.comments_of(first))


def _on_one_line(parts: Sequence[Comments]) -> Comments:
    """The comments of the parts of a statement that is one line in print. The last comment after a part stays there."""
    behind = [part.behind for part in parts if part.behind is not None]
    last = behind.pop() if behind else None
    return Comments((*(comment for part in parts for comment in part.above), *behind), last)
