"""In random missions, a monitor publishes what an audit finds in the recording of the same mission."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest

from sleec_runtime.language import load
from sleec_runtime.ros.messages import ConditionsUpdate, DomainChange, Executed, MissionEvent
from sleec_runtime.ros.transport import STRING
from tests.support.missions import complete, declared, observations
from tests.support.monitored import MonitoredMission, contents
from tests.support.paths import ROOT
from tests.support.random_traces import random_cases


@pytest.mark.parametrize("seed", range(2))
def test_both_find_the_same(seed: int, tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for number, case in enumerate(random_cases(seed, 60)):
        ruleset = declared(case.ruleset)
        for one, trace in enumerate(case.traces):
            chance = Random(f"{seed} {number} {one}")
            period = max((1, *(instant.time for instant in trace.instants))) / chance.choice((3, 10, 30))
            watched = complete(trace, chance) if chance.random() < 0.5 else trace
            mission = MonitoredMission(
                ruleset,
                tmp_path / f"{number}_{one}.jsonl",
                tolerance=chance.choice((0, 1)),
                untimed=case.untimed,
                period=period,
            )
            mission.happen(observations(watched, chance))
            mission.advance(chance.choice((0, 3, 50)) * period)
            mission.end()
            assert contents(mission.received) == contents(mission.audited())
            assert [one.number for one in mission.received] == list(range(len(mission.received)))
            assert len(mission.deviations) == len(mission.received)
            assert not mission.problems
            found.update(one.kind for one in mission.received)
            found["none"] += not mission.received
    kinds = ("missed", "prohibited", "constraint", "assumption", "unrequired", "undetermined", "open", "none")
    assert all(found[kind] > 5 for kind in kinds), found


RULES = load(ROOT / "rulesets" / "care-robot.sleec")
TRIGGERS, OBLIGATIONS, CONDITIONS = (sorted(names) for names in (RULES.triggers, RULES.obligations, RULES.conditions))


def message_of_a_node(chance: Random) -> tuple[str, dict[str, object]]:
    """A message on a topic of our nodes, which may be malformed."""
    message = chance.choice(
        (
            DomainChange(domain=chance.choice((None, "hospital", "household", "garden"))),
            ConditionsUpdate(
                conditions={
                    chance.choice((*CONDITIONS, "Typo")): chance.choice((True, False, None)),
                    "UserAge": chance.choice((15, 40, None, "old", Fraction("15.5"))),
                }
            ),
            MissionEvent(trigger=chance.choice((*TRIGGERS, "Typo")), id=chance.choice((None, "1", "2"))),
            Executed(
                node=chance.choice(("a", "b")),
                triggered=chance.random(),
                time=1,
                trigger=chance.choice((None, *TRIGGERS)),
                executed=tuple(chance.sample(OBLIGATIONS, chance.randrange(3))),
            ),
        )
    )
    text = message.to_json()
    if chance.random() < 0.2:
        at = chance.randrange(len(text))
        text = text[:at] + chance.choice(('"', "}", "NaN", "\ud800", "")) + text[at + 1 :]
    return message.topic.name, {"data": text}


@pytest.mark.parametrize("seed", range(2))
def test_both_find_the_same_in_messages_of_our_nodes(seed: int, tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for number in range(25):
        chance = Random(f"{seed} {number}")
        mission = MonitoredMission(RULES, tmp_path / f"{number}.jsonl", mapping=" ", tolerance=1, period=0.3)
        for _ in range(40):
            topic, fields = message_of_a_node(chance)
            mission.send(topic, fields, STRING)
            mission.advance(chance.choice((0, 0, 0.1, 0.5, 3)))
        mission.end()
        published = [report for report in mission.received if report.kind != "wrong-value"]
        assert contents(published) == contents(one for one in mission.audited() if one.kind != "wrong-value")
        found.update(one.kind for one in published)
        found["problems"] += len(mission.problems)
    kinds = ("missed", "unrequired", "undetermined", "unknown-name", "problems")
    assert all(found[kind] > 5 for kind in kinds), found
