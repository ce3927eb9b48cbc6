"""The evaluator of traces that is extracted from the theory in Coq (`proofs/traces/`), asked by way of the oracle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import TracebackType

from sleec_runtime.model import Claim, Clause, Obligation, Rule, Ruleset, Truth
from sleec_verify.certificates.theory.numbered_traces import NotCovered, NumberedTraces
from sleec_verify.certificates.theory.oracle import NoAnswer, Oracle
from sleec_verify.replay.trace_evaluator import Trace, Untimed, Violation

__all__ = ["NotCovered", "OracleEvaluator"]


class OracleEvaluator:
    """An oracle at work, as an evaluator of traces. After a question without an answer, a new oracle starts.

    Its methods raise NoAnswer if the oracle does not answer, and NotCovered for what the theory does not cover.
    """

    def __init__(self, program: Path, seconds: float | None = None) -> None:
        """`seconds` is the time limit for one question."""
        self._program = program
        self._seconds = seconds
        self._oracle: Oracle | None = None

    def violations(self, ruleset: Ruleset, trace: Trace, untimed: Untimed) -> Sequence[Violation]:
        """What a complete trace violates."""
        return self._broken(ruleset, trace, untimed)[0]

    def violations_so_far(self, ruleset: Ruleset, history: Trace, untimed: Untimed) -> Sequence[Violation]:
        """What every continuation of a history violates."""
        return self._broken(ruleset, history, untimed)[1]

    def claim_holds(self, claim: Claim, ruleset: Ruleset, trace: Trace, untimed: Untimed) -> bool:
        """Whether a concern or purpose occurs in a trace."""
        numbered = NumberedTraces(replace(ruleset, statements=(), inferred=tuple(ruleset.measures.values())), untimed)
        claims = numbered.claims(claim)
        return self._ask(numbered.line, numbered.trace(trace), claims)[-1] == "yes"

    def decides(self, rule: Rule, number: int, ruleset: Ruleset, trace: Trace) -> bool:
        """Whether some instant triggers a rule, its guard holds there, and its clause `number` decides: whether a claim
        occurs whose response is the trigger in this clause and nothing else in the others."""
        response = _only(rule, number)
        claim = Claim("concern", rule.label, "exists", rule.trigger, rule.guard, (response,))
        return self.claim_holds(claim, ruleset, trace, "at")

    def _broken(self, ruleset: Ruleset, trace: Trace, untimed: Untimed) -> tuple[list[Violation], list[Violation]]:
        numbered = NumberedTraces(ruleset, untimed)
        answer = self._ask(numbered.line, numbered.trace(trace))[-1]
        whole, _, so_far = answer.partition("; ")
        if not (whole.startswith("broken ") and so_far.startswith("so-far ")):
            raise NoAnswer(f"the oracle did not answer: {answer}")
        found, early = numbered.broken(whole, trace), numbered.broken(so_far, trace)
        return [Violation(*one) for one in found], [Violation(*one) for one in early]

    def _ask(self, *questions: str) -> list[str]:
        if self._oracle is None:
            self._oracle = Oracle(self._program, self._seconds)
        try:
            return [self._oracle.ask(question) for question in questions]
        except NoAnswer:
            self.close()
            raise

    def close(self) -> None:
        """End the oracle."""
        if self._oracle is not None:
            self._oracle.close()
            self._oracle = None

    def __enter__(self) -> OracleEvaluator:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()


def _only(rule: Rule, number: int) -> Clause:
    """The chain of a rule in which clause `number` obliges the trigger, which occurs, and the others forbid it."""
    numbers = iter(range(sum(1 for _ in rule.clauses())))

    def marked(clause: Clause) -> Clause:
        marks = (Obligation(rule.trigger, negated=next(numbers) != number),)
        return replace(clause, obligations=marks, hedges=tuple(map(marked, clause.hedges)))

    default = marked(rule.default)
    hedges = tuple(map(marked, rule.hedges))
    if not default.hedges:
        return replace(default, hedges=hedges)
    if not hedges:
        return default
    # A default with its own chain is equivalent to a first hedge with the condition `true`.
    return Clause(None, (), hedges=(replace(default, condition=Truth(True)), *hedges))
