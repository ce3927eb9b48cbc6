"""The replay of the traces of a certificate, by the runtime's evaluator and by the one that is extracted from Coq."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from sleec_verify.certificates.theory.oracle import NoAnswer
from sleec_verify.certificates.theory.trace_oracle import NotCovered, OracleEvaluator
from sleec_verify.certificates.trace_evidence import Entry
from sleec_verify.replay.trace_evaluator import RUNTIME


class Replayed(NamedTuple):
    """How many traces there are, how many of them the evaluator extracted from Coq confirmed, and why it did not replay
    the others: each reason with the number of traces."""

    traces: int
    by_oracle: int
    reasons: Mapping[str, int]


class TraceReplay:
    """The replay by the runtime's evaluator and, if there is one, by the oracle's."""

    def __init__(self, oracle: OracleEvaluator | None) -> None:
        self._oracle = oracle
        self._traces = self._by_oracle = 0
        self._reasons: dict[str, int] = {}

    def rejected(self, entry: Entry) -> str | None:
        """The evaluator that does not confirm the traces of an entry, in words; None if each confirms them."""
        self._traces += entry.traces
        if not entry.confirmed(RUNTIME):
            return "the evaluator in Python"
        try:
            if self._oracle is None:
                raise NoAnswer("the oracle is not built (make proofs)")
            if not entry.confirmed(self._oracle):
                return "the evaluator extracted from the theory in Coq"
            self._by_oracle += entry.traces
        except (NoAnswer, NotCovered) as error:
            reason = str(error.message)
            self._reasons[reason] = self._reasons.get(reason, 0) + entry.traces
        return None

    def result(self) -> Replayed:
        """The result of all replays so far."""
        return Replayed(self._traces, self._by_oracle, self._reasons)
