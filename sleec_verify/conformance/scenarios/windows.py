"""The windows of rules, and those that scenarios and tests meet and miss."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from sleec_runtime.model import Obligation, Rule, Ruleset, in_text_order, obligation_text
from sleec_verify.conformance.scenarios.construction import due_in
from sleec_verify.conformance.scenarios.expectations import trace_of
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.results.timeline import Due
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.trace import TraceInstant


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


def reached_windows(ruleset: Ruleset, scenarios: Iterable[Scenario]) -> frozenset[WindowRef]:
    """The windows that are met or missed in some scenario. Raises `Undecided`."""
    every = {ref for rule in ruleset.rules for ref in windows_of(rule)}
    found: set[WindowRef] = set()
    for scenario in scenarios:
        part = ruleset if scenario.domain is None else ruleset.in_domain(scenario.domain)
        trace = trace_of(scenario)
        for due in due_in(TraceIndex(part), trace):
            found.add(WindowRef(due.rule, due.clause, due.words, missed=not _is_met(due, trace)))
    return frozenset(found & every)


def _is_met(due: Due, trace: Sequence[TraceInstant]) -> bool:
    occurs = any(
        due.event in one.events and due.start <= one.time and (due.end is None or one.time <= due.end) for one in trace
    )
    return occurs != due.negated
