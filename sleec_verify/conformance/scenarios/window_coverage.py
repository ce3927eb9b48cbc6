"""The windows that scenarios meet and miss, and those that some trace can meet or miss."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from contextlib import suppress

from sleec_runtime.model import Ruleset
from sleec_verify.conformance.scenarios.expectations import required_in, trace_of
from sleec_verify.conformance.scenarios.goals import TraceGoal, trace_goals
from sleec_verify.conformance.scenarios.lawful_traces import LawfulTraces
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.conformance.scenarios.windows import WindowRef, windows_of
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef
from sleec_verify.results.timeline import Due
from sleec_verify.traces.trace import TraceInstant


def reached_windows(ruleset: Ruleset, scenarios: Iterable[Scenario]) -> frozenset[WindowRef]:
    """The windows that are met or missed in some scenario. Raises WrongType as `required_in`."""
    every = {ref for rule in ruleset.rules for ref in windows_of(rule)}
    found: set[WindowRef] = set()
    for scenario in scenarios:
        part = ruleset if scenario.domain is None else ruleset.in_domain(scenario.domain)
        trace = trace_of(scenario)
        for due in required_in(part, trace):
            found.add(WindowRef(due.rule, due.clause, due.words, missed=not _is_met(due, trace)))
    return frozenset(found & every)


def reachable_windows(ruleset: Ruleset, clauses: Collection[ClauseRef]) -> frozenset[WindowRef]:
    """The windows of these clauses, except those that no trace meets or misses if all rules are followed. What is not
    decided is included."""
    found = {ref for rule in ruleset.rules for ref in windows_of(rule) if ClauseRef(ref.rule, ref.clause) in clauses}
    if not found:
        return frozenset()
    asked: set[WindowRef] = set()
    possible: set[WindowRef] = set()
    for domain in ruleset.domains or (None,):
        index = RulesetIndex(ruleset if domain is None else ruleset.in_domain(domain))
        for goal in trace_goals(LawfulTraces(index), "clause"):
            if goal.window is not None and goal.window not in possible:
                asked.add(goal.window)
                if _is_possible(LawfulTraces(index), goal):
                    possible.add(goal.window)
    return frozenset(found - (asked - possible))


def _is_possible(world: LawfulTraces, goal: TraceGoal) -> bool:
    with suppress(Undecided):
        return world.reaches([*goal.situation(world), *goal.windows(world)])
    return True


def _is_met(due: Due, trace: Sequence[TraceInstant]) -> bool:
    occurs = any(
        due.event in one.events and due.start <= one.time and (due.end is None or one.time <= due.end) for one in trace
    )
    return occurs != due.negated
