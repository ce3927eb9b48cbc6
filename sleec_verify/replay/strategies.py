"""Replay of strategies by the runtime's evaluator of traces, which shares no code with the circuits.

It confirms that each act is lawful, and that the robot's actions and plans satisfy everything until it loses. That the
robot has no other way is a claim about all its actions, which a replay cannot confirm.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.evaluation.trace import Instant, Trace, Untimed
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.model import Ruleset
from sleec_verify.games.players import is_environments
from sleec_verify.results.finding import Finding
from sleec_verify.results.strategy import Act, Strategy
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.relations import Name, names_of_relation


def replay_strategy(index: TraceIndex, finding: Finding) -> bool:
    """Whether the evaluator agrees with a strategy."""
    assert finding.strategy is not None, "only strategies are replayed here"
    whole = index.ruleset
    rules = tuple(whole.by_label[label] for label in finding.rules)
    measures = tuple(whole.measures.values())
    # The others hold in any case, or depend on conditions and measures that are irrelevant and not shown.
    shown = set(_names(finding.strategy))
    relations = tuple(law for law in index.relations if not shown.isdisjoint(names_of_relation(law)))
    robots = replace(whole, statements=(*relations, *rules), inferred=measures)
    lawful = tuple(law for law in relations if is_environments(law, index.agents))
    environments = replace(whole, statements=lawful, inferred=measures)
    return _plays(finding.strategy, robots, environments, (), index.untimed)


def _names(strategy: Strategy) -> Iterator[Name]:
    """The events, conditions and measures of a strategy."""
    acts = [strategy.act, *(act for branch in strategy.branches for act in branch.planned)]
    for act in acts:
        yield from (("event", event) for event in act.events)
        yield from (("measure", name) for name in act.conditions)
    for branch in strategy.branches:
        yield from (("event", event) for event in branch.done or ())
        yield from _names(branch.then)


def _plays(
    strategy: Strategy, robots: Ruleset, environments: Ruleset, before: tuple[Instant, ...], untimed: Untimed
) -> bool:
    act = _instant(strategy.act)
    if violations(environments, Trace((*before, act)), untimed):
        return False
    for branch in strategy.branches:
        after = branch.then.act.time
        if branch.done is None:
            # The strategy does not depend on the robot's actions, so there is nothing to replay.
            if not after > act.time:
                return False
            continue
        now = replace(act, events=act.events.union(branch.done))
        plan = [_instant(planned) for planned in branch.planned]
        if violations(robots, Trace((*before, now, *plan)), untimed):
            return False
        done = [instant for instant in plan if instant.time < after]
        if not _plays(branch.then, robots, environments, (*before, now, *done), untimed):
            return False
    return True


def _instant(act: Act) -> Instant:
    return Instant(act.time, frozenset(act.events), act.conditions)
