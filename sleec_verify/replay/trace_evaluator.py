"""What a replay of traces asks of an evaluator, and the evaluator of the runtime.

The other one is extracted from the theory in Coq (`sleec_verify.certificates.theory.trace_oracle`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.evaluation.trace import Instant, Trace, Untimed
from sleec_runtime.evaluation.trace_violations import (
    Requirement,
    Violation,
    claim_holds,
    violations,
    violations_so_far,
)
from sleec_runtime.model import Claim, Context, Rule, Ruleset

__all__ = ["RUNTIME", "Instant", "Requirement", "RuntimeEvaluator", "Trace", "TraceEvaluator", "Untimed", "Violation"]


class TraceEvaluator(Protocol):
    """An evaluator of traces. All statements of a ruleset count."""

    def violations(self, ruleset: Ruleset, trace: Trace, untimed: Untimed) -> Sequence[Violation]:
        """What a complete trace violates."""
        ...

    def violations_so_far(self, ruleset: Ruleset, history: Trace, untimed: Untimed) -> Sequence[Violation]:
        """What every continuation of a history violates."""
        ...

    def claim_holds(self, claim: Claim, ruleset: Ruleset, trace: Trace, untimed: Untimed) -> bool:
        """Whether a concern or purpose occurs in a trace."""
        ...

    def decides(self, rule: Rule, number: int, ruleset: Ruleset, trace: Trace) -> bool:
        """Whether some instant triggers a rule, its guard holds there, and its clause `number` decides."""
        ...


class RuntimeEvaluator:
    """The evaluator of the runtime, which shares no code with the encoding and the solver."""

    def violations(self, ruleset: Ruleset, trace: Trace, untimed: Untimed) -> Sequence[Violation]:
        return violations(ruleset, trace, untimed)

    def violations_so_far(self, ruleset: Ruleset, history: Trace, untimed: Untimed) -> Sequence[Violation]:
        return violations_so_far(ruleset, history, untimed)

    def claim_holds(self, claim: Claim, ruleset: Ruleset, trace: Trace, untimed: Untimed) -> bool:
        return claim_holds(claim, ruleset, trace, untimed)

    def decides(self, rule: Rule, number: int, ruleset: Ruleset, trace: Trace) -> bool:
        for instant in trace.instants:
            context = Context(instant.events, instant.conditions)
            decision = decide(rule, context, ruleset.reading, ruleset.measures)
            if decision is not None and decision.clause == number:
                return True
        return False


RUNTIME: TraceEvaluator = RuntimeEvaluator()
