"""Coverage: how often each rule was triggered in a mission, and how often each clause decided."""

from __future__ import annotations

from collections import Counter

from sleec_runtime.evaluation.hedge_chain import Decision, Outcome
from sleec_runtime.model import Rule


class Coverage:
    """Counts of triggered rules. `clauses` counts by rule and number of the clause that decided."""

    def __init__(self) -> None:
        self.triggered: Counter[str] = Counter()
        self.clauses: Counter[tuple[str, int]] = Counter()
        self.undetermined: Counter[str] = Counter()

    def count(self, rule: Rule, outcome: Outcome) -> None:
        """Counts a triggered rule. Its guard may be false, which makes the outcome None."""
        self.triggered[rule.label] += 1
        if isinstance(outcome, Decision):
            self.clauses[rule.label, outcome.clause] += 1
        elif outcome is not None:
            self.undetermined[rule.label] += 1

    def add(self, other: Coverage) -> None:
        """Adds the counts of another mission."""
        self.triggered += other.triggered
        self.clauses += other.clauses
        self.undetermined += other.undetermined
