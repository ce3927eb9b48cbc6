"""Rules: ``label when event [and condition] then response`` and their exceptions."""

from __future__ import annotations

from sleec_runtime.language.common.token_cursor import ClauseError
from sleec_runtime.language.dsl.hints import CONDITION_END, OCCASION_END, RESPONSE_END
from sleec_runtime.language.dsl.keywords import ITEM_STARTS
from sleec_runtime.language.dsl.relations import DslRelationParser
from sleec_runtime.model import Clause, Formula, Rule, Span


class DslRuleParser(DslRelationParser):
    """Reads rules. A problem in one clause leaves the others readable."""

    _hedges_of_rules: set[int] | None = None
    """Every `unless` that begins a hedge of a rule, once a problem makes it worth knowing."""

    def rule(self) -> Rule | None:
        """The rule at hand, or None if a part of it could not be read."""
        first = self.at
        self.allows_events = True
        label, label_span = self.label("rule")
        opening: tuple[str, Span, Formula | None, Clause] | None = None
        self.begin_clause()
        try:
            self.at += 1
            if self.token_text(self.at - 1) == "exists":
                hint = "write when, or move it to the concerns or purposes"
                self.fail("a rule cannot begin with exists", self.token_span(self.at - 1), hint)
            trigger, trigger_span, guard = self.occasion("a trigger")
            at_then = self.at
            self.require(
                "then", OCCASION_END if guard is None else CONDITION_END, "for example: R1 when Event then Response"
            )
            opening = trigger, trigger_span, guard, self.chain(None, at_then)
            end = self.at
            if self.kinds[self.at] != "unless":
                self.end_of_item(RESPONSE_END)
        except ClauseError:
            self.recover()
        hedges: list[Clause] = []
        self.hedges(hedges, RESPONSE_END)
        if opening is None:
            return None
        trigger, trigger_span, guard, default = opening
        end_of_rule = hedges[-1].span.end if hedges else self.ends[end - 1] if not self.has_failed else default.span.end
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

    def recover(self) -> None:
        """On to the next hedge of the rule, or past the rule. What brackets hold is not a hedge of the rule."""
        if self._hedges_of_rules is None:
            self._hedges_of_rules = self._outside_brackets()
        while self.kinds[self.at] not in ITEM_STARTS and self.at not in self._hedges_of_rules:
            self.at += 1

    def _outside_brackets(self) -> set[int]:
        """Every `unless` outside braces and parentheses. A bracket that is not closed before the next rule holds
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
