"""Responses that trigger rules, and changes of context."""

from __future__ import annotations

import pytest

from sleec_runtime import errors
from sleec_runtime.language import parse
from tests.support.homes import CHAIN, SMOKE, Home, shown

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


def test_without_chains_doing_something_triggers_nothing():
    home = Home(CHAIN)
    assert home.sleec.trigger("A").obligations == ("B",)
    assert home.log == [(0, "B")]


def test_with_chains_a_response_is_an_event():
    home = Home(CHAIN, chains=True)
    done = home.sleec.trigger("A", "why")
    assert done.obligations == ("B", "C", "D")
    assert home.log == [(0, "B"), (0, "C"), (0, "D")]
    assert home.arguments == ["why"] * 3


def test_a_chain_goes_on_when_what_takes_time_is_done():
    home = Home(CHAIN, slow=("C",), chains=True)
    assert home.sleec.trigger("A", "why").obligations == ("B", "C")
    home.clock.advance(3)
    home.sleec.completed("C")
    assert home.log == [(0, "B"), (0, "C"), (3, "D")]
    assert home.arguments == ["why"] * 3


def test_what_the_chain_raises_is_raised_when_something_is_completed():
    home = Home(CHAIN, slow=("C",), chains=True)
    (due,) = home.sleec.trigger("A").due
    home.broken.add("D")
    with pytest.raises(OSError, match="D"):
        due.completed()
    assert due.state == "done"


def test_a_chain_ends_with_what_raises():
    home = Home(CHAIN + "\nRULE n WHEN B THEN NOT E AND NOT F WITHIN 5 seconds", chains=True)
    home.broken.add("B")
    with pytest.raises(OSError, match="B"):
        home.sleec.trigger("A")
    assert home.log == [(0, "B")]
    assert home.sleec.pending() == ()


def test_a_chain_is_refused_as_a_whole_and_before_anything_runs():
    home = Home(
        "RULE a WHEN A THEN B\nRULE b WHEN B THEN NOT A\nRULE c WHEN C THEN D\nRULE d WHEN D THEN NOT D", chains=True
    )
    with pytest.raises(errors.ConflictInContext, match=r"NOT A \(b\) and A are both due"):
        home.sleec.trigger("A")
    with pytest.raises(errors.ConflictInContext):
        home.sleec.trigger("C")
    assert home.log == []


def test_a_cycle_of_events_comes_about_once():
    home = Home("RULE a WHEN A THEN B\nRULE b WHEN B THEN A", chains=True)
    assert home.sleec.trigger("A").obligations == ("B", "A")


def test_with_chains_an_event_that_occurs_is_done():
    home = Home("RULE a WHEN A THEN X WITHIN 9 seconds\nRULE x WHEN X THEN Y", slow=("X",), chains=True)
    (due,) = home.sleec.trigger("A").due
    home.sleec.trigger("X")
    assert due.state == "done"


def test_with_chains_what_the_clock_starts_triggers_rules():
    home = Home("RULE a WHEN A THEN X WITHIN 2 TO 5 seconds\nRULE x WHEN X THEN Y", chains=True)
    home.sleec.trigger("A")
    home.clock.advance(9)
    assert home.log == [(2, "X"), (2, "Y")]


def test_pending_obligations_survive_a_change_of_context():
    home = Home("RULE alarm WHEN Smoke THEN CallNurse WITHIN 10 seconds UNLESS Asleep", slow=("CallNurse",))
    home.sleec.trigger("Smoke")
    home.sleec.update({"Asleep": True})
    assert shown(home.sleec.pending()) == ["CallNurse (alarm): under way, closes in 10 seconds"]


def test_pending_obligations_finish_under_the_rules_that_asked_for_them():
    home = Home(SMOKE, slow=("CallNurse",))
    home.sleec.trigger("Smoke")
    home.sleec.trigger("Post")
    home.clock.advance(1)
    home.sleec.trigger("Sleep")
    home.sleec.replace(parse("RULE new WHEN Test THEN SoundAlarm"))
    assert [one.rule for one in home.sleec.pending()] == ["quiet", "post", "alarm"]
    with pytest.raises(errors.Prohibited, match="rule `quiet` forbids it for 5 more seconds"):
        home.sleec.trigger("Test")
    home.clock.advance(20)
    assert home.log == [(0, "CallNurse"), (3, "Fetch"), (10, "SoundAlarm")]
    home.sleec.trigger("Test")
    assert home.told == []


def test_rules_with_times_may_come_later():
    home = Home("RULE test WHEN Test THEN SoundAlarm")
    assert home.sleec.pending() == home.sleec.failures == ()
    assert home.sleec.completed("SoundAlarm") == ()
    with pytest.raises(errors.UnknownObligation):
        home.sleec.completed("Sound")
    home.sleec.tick()
    home.sleec.replace(parse(SMOKE), implement={name: home.callable(name) for name in ("CallNurse", "Fetch")})
    home.sleec.trigger("Sleep")
    assert len(home.sleec.pending()) == 1
    with pytest.raises(errors.UnknownObligation, match="SoundAlarm"):
        home.sleec.completed("SoundAlrm")
