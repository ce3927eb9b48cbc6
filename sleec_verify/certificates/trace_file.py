"""The file of a certificate with the traces that answer questions of its checks, and their replay."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import NamedTuple

from sleec_verify.certificates.theory.oracle import NoAnswer
from sleec_verify.certificates.theory.trace_oracle import NotCovered, OracleEvaluator
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.trace_evaluator import RUNTIME, TraceEvaluator
from sleec_verify.replay.traces import replay_found
from sleec_verify.results.found_trace import FoundTrace
from sleec_verify.results.json_values import Json, values_json
from sleec_verify.results.phrases import quoted

TRACES = "traces.json"
"""The name of the file."""


@dataclass(frozen=True)
class CheckTrace:
    """A trace that a check found, the domain of its rules (empty: all rules), and their index."""

    check: str
    domain: str
    index: RulesetIndex
    found: FoundTrace

    def json(self) -> dict[str, Json]:
        """The entry of the trace in the file."""
        instants: list[Json] = [
            {"time": time, "events": [*sorted(events)], "conditions": values_json(conditions)}
            for time, events, conditions in self.found.instants
        ]
        about: list[Json] = [{"name": name, "clause": clause} for name, clause in self.found.about]
        entry: dict[str, Json] = {"check": self.check, "domain": self.domain, "shows": self.found.shows}
        return {**entry, "about": about, "instants": instants}

    def __str__(self) -> str:
        """The question of the trace, for messages."""
        names = dict.fromkeys(name for name, _ in self.found.about)
        domain = f" in {quoted(self.domain)}" if self.domain else ""
        return f"the {self.found.shows} of {', '.join(map(quoted, names))}{domain} ({self.check})"


def traces_text(traces: Sequence[CheckTrace]) -> str:
    """The text of the file: JSON in ASCII, with a line for each trace."""
    return "[\n" + ",\n".join(map(_line, traces)) + "\n]\n"


def _line(trace: CheckTrace) -> str:
    return json.dumps(trace.json())


def changed_traces(data: bytes, traces: Sequence[CheckTrace]) -> Iterator[str]:
    """What differs between the content of the file and the traces that are found now. An entry that differs shows
    something else, or nothing."""
    if data == traces_text(traces).encode():
        return
    rows = data.decode("ascii", "replace").removeprefix("[\n").removesuffix("\n]\n").split(",\n")
    for row, trace in zip_longest(rows, traces):
        if trace is None:
            yield f"{TRACES} has more than the traces of the checks"
            return
        if row != _line(trace):
            yield f"{TRACES} does not show {trace}"
            return
    yield f"{TRACES} is not what certify writes"


class Replayed(NamedTuple):
    """How many traces there are, how many of them the evaluator extracted from Coq replayed, and why it did not replay
    the others: each reason with its number."""

    traces: int
    by_oracle: int
    reasons: Mapping[str, int]


class TraceReplay:
    """The replay of traces by the runtime's evaluator and, if there is one, by the oracle's."""

    def __init__(self, oracle: OracleEvaluator | None) -> None:
        self._oracle = oracle
        self._traces = self._by_oracle = 0
        self._reasons: dict[str, int] = {}

    def rejected(self, trace: CheckTrace) -> str | None:
        """The evaluator that does not confirm a trace, in words; None if each confirms it."""
        self._traces += 1
        if not _confirms(RUNTIME, trace):
            return "the evaluator in Python"
        try:
            if self._oracle is None:
                raise NoAnswer("the oracle is not built (make proofs)")
            if not _confirms(self._oracle, trace):
                return "the evaluator extracted from the theory in Coq"
            self._by_oracle += 1
        except (NoAnswer, NotCovered) as error:
            reason = str(error.message)
            self._reasons[reason] = self._reasons.get(reason, 0) + 1
        return None

    def result(self) -> Replayed:
        """The result of all replays so far."""
        return Replayed(self._traces, self._by_oracle, self._reasons)


def _confirms(evaluator: TraceEvaluator, trace: CheckTrace) -> bool:
    return replay_found(trace.index, trace.found, evaluator)
