"""Hedges that name triggers, at run time: what occurs together is triggered together."""

from __future__ import annotations

import asyncio
import json
import warnings
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime import Sleec
from sleec_runtime.dispatch.decisions import trigger_outcomes
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import NotEnforced, SnapshotRefused
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.language import parse
from sleec_runtime.timed.clocks import VirtualClock
from tests.support import brute_force as brute
from tests.support.strategies import contexts, rulesets

TEXT = """
RULE stranger WHEN Stranger THEN Lock UNLESS Fire AND home IN WHICH CASE Greet
RULE fire WHEN Fire THEN Open
EXCLUSIVE Lock, Open
"""


def robot(text: str = TEXT, **options: Any) -> Sleec:
    sleec = Sleec(parse(text), **options)
    obligations = sorted(sleec.ruleset.obligations)
    sleec.implement({name: (lambda *_: None) for name in obligations})
    return sleec


def test_what_is_triggered_together_occurs_together() -> None:
    sleec = robot()
    sleec.update({"home": True})
    assert sleec.trigger("Stranger").obligations == ("Lock",)
    assert sleec.trigger_all(["Stranger", "Fire"]).obligations == ("Greet", "Open")
    assert sleec.due("Fire", "Stranger").obligations == ("Greet", "Open")
    # The order of two dispatches does not matter: each is an instant of its own.
    assert sleec.trigger("Fire").obligations == ("Open",)
    assert sleec.trigger("Stranger").obligations == ("Lock",)


def test_a_coroutine_does_the_same() -> None:
    sleec = robot()
    sleec.update({"home": True})
    done = asyncio.run(sleec.trigger_all_async(["Fire", "Stranger"]))
    assert done.obligations == ("Greet", "Open")
    assert asyncio.run(sleec.trigger_async("Stranger")).obligations == ("Lock",)


def test_the_explanation_says_what_occurs() -> None:
    sleec = robot()
    assert "Fire does not occur, home = unreported" in sleec.trigger("Stranger").explain()
    sleec.update({"home": True})
    assert "Fire occurs, home = true" in sleec.trigger_all(["Stranger", "Fire"]).explain()


def test_a_trigger_is_no_condition_to_report() -> None:
    assert "Fire" not in robot().vocabulary


@pytest.mark.slow
@given(st.data())
@settings(max_examples=100)
def test_dispatches_agree_with_brute_force(data: st.DataObject) -> None:
    ruleset = data.draw(rulesets(domains=False, max_rules=3))
    context = data.draw(contexts(ruleset))
    if not context.triggers or brute.conflicts(ruleset, context):
        return
    sleec = Sleec(ruleset)
    sleec.update(dict(context.conditions))
    expected = [(label, number) for label, number, _ in brute.active_clauses(ruleset, context)]
    assert [(d.rule.label, d.clause) for d in sleec.due(*context.triggers).decisions] == expected
    taken: list[Snapshot] = []
    sleec.hold(taken.append)
    for trigger in context.triggers:
        alone = brute.active_clauses(ruleset, type(context)(frozenset({trigger}), context.conditions))
        outcomes = [(label, number) for label, number, _ in alone]
        cell = trigger_outcomes(taken[0], trigger)
        assert [(o.rule.label, o.clause) for o in cell.outcomes if isinstance(o, Decision)] == outcomes


TIMED = """
RULE stranger WHEN Stranger THEN Lock WITHIN 5 minutes OTHERWISE (Call UNLESS Fire IN WHICH CASE Wait)
RULE fire WHEN Fire THEN Open
RULE night WHEN Night THEN Fire
RULE warn WHEN Fire THEN Warn UNLESS Night IN WHICH CASE Whisper
"""


def timed(**options: Any) -> tuple[Sleec, VirtualClock, list[str]]:
    clock, done = VirtualClock(), []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NotEnforced)
        sleec = Sleec(parse(TIMED), clock=clock, **options)
    names = sorted(sleec.ruleset.obligations - {"Lock"})
    sleec.implement({name: (lambda *_, name=name: done.append(name)) for name in names})

    def lock(*_: object) -> None:
        raise OSError("the bolt is stuck")

    sleec.implement({"Lock": lock})
    return sleec, clock, done


@pytest.mark.parametrize(("triggers", "instead"), [(["Stranger"], "Call"), (["Stranger", "Fire"], "Wait")])
def test_hedges_behind_otherwise_are_decided_by_what_occurred_with_the_trigger(triggers, instead) -> None:
    sleec, clock, done = timed()
    with pytest.raises(OSError, match="the bolt is stuck"):
        sleec.trigger_all(triggers)
    done.clear()
    saved = json.loads(json.dumps(sleec.pending_snapshot(now=1000)))
    clock.advance(301)
    assert done == [instead]

    again, clock, done = timed()
    again.restore(saved, now=1000)
    clock.advance(301)
    assert done == [instead]


def test_with_chains_a_rule_sees_the_triggers_that_led_to_its_own() -> None:
    sleec, _, done = timed(chains=True)
    sleec.trigger("Night")
    assert done == ["Fire", "Open", "Whisper"]
    done.clear()
    sleec.trigger("Fire")
    assert done == ["Open", "Warn"]


@pytest.mark.parametrize("triggers", ["Fire", [1], ["Lock"], [["Fire"]]])
def test_a_snapshot_with_other_triggers_is_refused(triggers) -> None:
    sleec, _, _ = timed()
    with pytest.raises(OSError, match="stuck"):
        sleec.trigger("Stranger")
    saved = sleec.pending_snapshot(now=1000)
    saved["decisions"][0]["triggers"] = triggers
    with pytest.raises(SnapshotRefused, match="triggers"):
        timed()[0].restore(saved, now=1000)


def test_it_is_named_that_a_response_at_the_same_moment_is_not_seen() -> None:
    with pytest.warns(NotEnforced, match="conditions of `stranger` on `Fire` as a response, line 2"):
        Sleec(parse(TIMED), clock=VirtualClock(), chains=True)
