"""Which code each rule needs, and which of it is missing."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from sleec_runtime.errors import NotBound
from sleec_runtime.model import Clause, Obligation, Rule, literals
from sleec_runtime.support.messages import listed


class Code(Protocol):
    """The code that is bound to rules and obligations: an `Instance`."""

    def has_method(self, label: str) -> bool:
        """Whether the rule has a method."""
        ...

    def given(self, name: str) -> object | None:
        """The callable of an obligation."""
        ...

    def variant(self, rule: Rule, number: int, clause: Clause) -> object | None:
        """The variant of clause `number`. Raises NotBound."""
        ...


def missing(rules: Iterable[Rule], code: Code) -> dict[str, NotBound]:
    """The rules that cannot run in some context, by label, with the reason. O(clauses)."""
    problems = ((rule.label, _problem(rule, code)) for rule in rules)
    return {label: problem for label, problem in problems if problem is not None}


def _problem(rule: Rule, code: Code) -> NotBound | None:
    try:
        for number, clause in enumerate(rule.clauses()):
            code.variant(rule, number, clause)
            if any(obligation.timing is not None for obligation in clause.obligations):
                if code.has_method(rule.label):
                    require_one_start(rule, clause)
                for obligation in clause.obligations:
                    require_alternatives(rule, obligation, code)
    except NotBound as problem:
        return problem
    return None


def require_one_start(rule: Rule, clause: Clause) -> None:
    """Raises NotBound for the method of a clause whose windows open at different times: it is called only once."""
    starts = {_start(obligation) for obligation in clause.obligations if not obligation.negated}
    if len(starts) > 1:
        raise NotBound(
            f"a clause of rule `{rule.label}` has obligations with different start times, for one method",
            [rule.label],
            "unbind() its method, and implement() each obligation; or write two rules",
        )


def _start(obligation: Obligation) -> object:
    window = None if obligation.timing is None else obligation.timing.window
    if window is None or window.start is None:
        return 0
    return str(window.start) if window.start.measures else window.start.seconds


def require_alternatives(rule: Rule, obligation: Obligation, code: Code) -> None:
    """Raises NotBound if an obligation of an alternative has no callable. Alternatives have no variants."""
    if obligation.timing is None:
        return
    names = [
        literal.name
        for alternative in obligation.timing.alternatives()
        for literal in literals(alternative)
        if not literal.negated and code.given(literal.name) is None
    ]
    if names:
        raise NotBound(
            f"rule `{rule.label}` may require {listed(dict.fromkeys(names))} in place of {obligation}, "
            "but there is no callable for it",
            [rule.label],
            "implement() it: alternatives have no variants",
        )


def is_silent(clause: Clause) -> bool:
    """Whether a clause has no obligations, so that it may have no variant."""
    return all(literal.negated for literal in clause.obligations)


def clause_name(rule: Rule, number: int) -> str:
    """The name of a clause in messages: its layer, or "its default"."""
    return rule.layer(number) or "its default"
