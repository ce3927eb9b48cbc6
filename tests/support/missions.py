"""Missions for the auditor: observations of traces."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from random import Random

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.observation import Executed, Observation, Occurred, Reported
from sleec_runtime.evaluation.trace import Trace
from sleec_runtime.model import Declaration, Ruleset
from tests.support.random_traces import CONDITIONS, EVENTS, SCALE

AFTERWARDS = 10**9
"""A time at which every window has closed."""


def declared(ruleset: Ruleset) -> Ruleset:
    """A random ruleset with declarations of all its names."""
    names = (Declaration("event", EVENTS), Declaration("condition", CONDITIONS))
    return replace(ruleset, statements=(*names, *ruleset.statements))


def complete(trace: Trace, chance: Random) -> Trace:
    """The trace with a value for every condition and measure."""
    instants = []
    for instant in trace.instants:
        drawn = {name: chance.random() < 0.5 for name in CONDITIONS} | {"risk": chance.choice(SCALE)}
        instants.append(replace(instant, conditions={**drawn, **instant.conditions}))
    return Trace(tuple(instants))


def observations(trace: Trace, chance: Random) -> Iterator[Observation]:
    """A mission with the same events and values. Each event is an occurrence or an execution, in any order."""
    for instant in trace.instants:
        unknown = dict.fromkeys((*CONDITIONS, "risk"))
        yield Reported(instant.time, {**unknown, **instant.conditions})
        events = sorted(instant.events)
        chance.shuffle(events)
        for event in events:
            yield chance.choice((Occurred, Executed))(instant.time, event)


def audit(auditor: Auditor, mission: Iterable[Observation], end: int | None = AFTERWARDS) -> list[Deviation]:
    """All deviations of a mission."""
    found = [deviation for observation in mission for deviation in auditor.observe(observation)]
    return found + auditor.finish(end)
