"""Constraints on what the rules require: EXCLUSIVE, NEVER, ASSUME."""

from __future__ import annotations

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.english.relations import EnglishRelationParser
from sleec_runtime.model import Assume, Atom, Exclusive, Never, leaves


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
        span = self.span(first)
        if not any(isinstance(leaf, Atom) and leaf.kind == "obligation" for leaf in leaves(formula)):
            self.problem(
                "this NEVER contains no obligation, so the robot cannot avoid it",
                span,
                "if this situation cannot occur, write ASSUME NOT (...)",
            )
        return Never(formula, self.domains, span, self.comments_of(first))

    def assume(self) -> Assume:
        first = self.at
        self.at += 1
        self.resolve = self.names.assumed
        formula = self.formula()
        return Assume(formula, self.domains, self.span(first), self.comments_of(first))
