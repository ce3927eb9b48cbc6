"""The windows of rules, each to be met, and missed if it has an alternative."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from sleec_runtime.model import Obligation, Rule, in_text_order, obligation_text


class WindowRef(NamedTuple):
    """A window that is met, or `missed` so that an alternative is due: of the response with this text in a clause."""

    rule: str
    clause: int
    response: str
    missed: bool = False

    def __str__(self) -> str:
        clause = f"{self.rule}.hc{self.clause}" if self.clause else f"{self.rule} (default)"
        response = self.response.partition(", ")[0]
        return f"{clause}: {response} {'missed' if self.missed else 'met'}"


def windows_of(rule: Rule) -> Iterator[WindowRef]:
    """Every window of a rule, also of alternatives. It can be missed if it has an alternative."""
    for number, clause in enumerate(rule.clauses()):
        for obligation in _responses(clause.obligations):
            timing = obligation.timing
            if timing is not None and timing.window is not None:
                ref = WindowRef(rule.label, number, obligation_text(obligation))
                yield ref
                if any(True for _ in timing.alternatives()):
                    yield ref._replace(missed=True)


def _responses(obligations: Iterable[Obligation]) -> Iterator[Obligation]:
    for obligation in obligations:
        yield obligation
        if obligation.timing is not None:
            for alternative in obligation.timing.alternatives():
                for member in in_text_order(alternative):
                    yield from _responses(member.obligations)
