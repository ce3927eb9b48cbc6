"""Prohibitions that last."""

from __future__ import annotations

import pytest

from sleec_runtime import errors
from tests.support.homes import SMOKE, Home, shown

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


def test_a_prohibition_refuses_until_it_ends_before_anything_runs():
    home = Home(SMOKE + "RULE both WHEN Test THEN Other\n")
    done = home.sleec.trigger("Sleep")
    assert shown(done.due) == ["NOT SoundAlarm (quiet): in force, closes in 5 seconds"]
    assert done.due[0].prohibited
    for left in ("for 5 more", "for 4 more", "for 3 more", "for 2 more", "for 1 more second", "at this moment"):
        with pytest.raises(errors.Prohibited, match=f"rule `quiet` forbids it {left}") as caught:
            home.sleec.trigger("Test")
        assert (caught.value.obligation, caught.value.over) == ("SoundAlarm", 6)
        assert isinstance(caught.value, errors.ConflictInContext)
        with pytest.raises(errors.Prohibited):
            home.sleec.due("Test")
        home.clock.advance(1)
    assert home.log == []
    assert done.due == home.sleec.pending() == ()
    home.sleec.trigger("Test")
    assert home.log == [(6, "SoundAlarm"), (6, "Other")]


def test_a_prohibition_is_over_when_its_window_is():
    home = Home("RULE a WHEN A THEN NOT X WITHIN 5 seconds")
    (one,) = home.sleec.trigger("A").due
    home.clock.advance(5)
    assert one.is_open
    home.clock.advance(0.5)
    assert (one.state, one.is_open) == ("over", False)
    home.clock.advance(1)
    assert one.state == "over"
    with pytest.raises(errors.SleecError, match="a prohibition, which cannot be completed"):
        one.completed()


def test_a_prohibition_may_begin_later():
    home = Home("RULE a WHEN A THEN NOT X WITHIN 2 TO 4 seconds\nRULE b WHEN B THEN X")
    home.sleec.trigger("A")
    home.sleec.trigger("B")
    home.clock.advance(2)
    with pytest.raises(errors.Prohibited):
        home.sleec.trigger("B")
    assert home.log == [(0, "X")]


def test_a_prohibition_without_a_window_is_of_its_dispatch():
    home = Home("RULE a WHEN A THEN NOT X\nRULE b WHEN B THEN X\nRULE c WHEN C THEN Y WITHIN 1 second")
    done = home.sleec.trigger("A")
    assert (done.prohibitions, done.due) == (("X",), ())
    home.sleec.trigger("B")
    with pytest.raises(errors.ConflictInContext, match=r"NOT X \(a\) and X \(b\) are both due"):
        home.sleec.trigger_all(["A", "B"])
    assert home.log == [(0, "X")]


def test_windows_that_do_not_meet_do_not_conflict():
    home = Home("RULE a WHEN A THEN X WITHIN 6 TO 9 seconds\nRULE b WHEN A THEN NOT X WITHIN 5 seconds")
    home.sleec.trigger("A")
    home.clock.advance(10)
    assert home.log == [(6, "X")]


def test_what_is_forbidden_when_its_window_opens_waits_until_it_is_not():
    home = Home("RULE a WHEN A THEN X WITHIN 3 TO 9 seconds\nRULE b WHEN A THEN NOT X WITHIN 5 seconds")
    home.sleec.trigger("A")
    home.clock.advance(4)
    assert shown(home.sleec.pending())[1] == "X (a): waiting, closes in 5 seconds"
    home.clock.advance(10)
    assert home.log == [(6, "X")]
    assert home.told == []


def test_what_is_forbidden_for_the_whole_of_its_window_is_refused_at_the_trigger():
    home = Home("RULE a WHEN A THEN X WITHIN 3 TO 5 seconds\nRULE b WHEN B THEN NOT X WITHIN 5 seconds")
    with pytest.raises(
        errors.Prohibited, match=r"`X` is due \(a, opens in 3 seconds, closes in 5 seconds\), but rule `b` forbids"
    ):
        home.sleec.trigger_all(["A", "B"])
    home.sleec.trigger("B")
    with pytest.raises(errors.Prohibited):
        home.sleec.trigger("A")
    home.clock.advance(20)
    home.sleec.trigger("A")
    with pytest.raises(errors.Prohibited):
        home.sleec.trigger("B")
    home.clock.advance(20)
    assert home.log == [(23, "X")]
    assert home.told == []


def test_what_is_begun_before_a_prohibition_and_done_within_is_told():
    home = Home(SMOKE, slow=("SoundAlarm",))
    home.sleec.trigger("Test")
    home.sleec.trigger("Sleep")
    home.clock.advance(1)
    with pytest.raises(errors.Prohibited, match="`SoundAlarm` was done, but rule `quiet` forbids it for 4 more"):
        home.sleec.completed("SoundAlarm")
    assert not [one for one in home.sleec.pending() if not one.prohibited], "it is done all the same"


def test_a_callable_that_brings_the_prohibition_of_itself_is_told():
    home = Home("RULE a WHEN A THEN X\nRULE b WHEN B THEN NOT X WITHIN 5 seconds")
    home.sleec.implement({"X": lambda: home.sleec.trigger("B")})
    with pytest.raises(errors.Prohibited, match="it was started before that"):
        home.sleec.trigger("A")


def test_a_prohibition_that_is_broken_has_its_otherwise():
    home = Home("RULE a WHEN A THEN X\nRULE b WHEN B THEN NOT X WITHIN 5 seconds OTHERWISE Y", slow=("X",), chains=True)
    home.sleec.trigger("A")
    home.sleec.trigger("B")
    home.clock.advance(2)
    home.sleec.completed("X")
    home.clock.advance(10)
    assert home.log == [(0, "X"), (5, "Y")]
    home.sleec.trigger("B")
    home.clock.advance(10)
    assert home.log == [(0, "X"), (5, "Y")], "kept this time"


def test_constraints_bind_what_the_clock_starts():
    home = Home(
        "EXCLUSIVE X, Y\nRULE a WHEN A THEN X WITHIN 3 TO 3 seconds AND Y WITHIN 3 TO 3 seconds\n"
        "RULE b WHEN B THEN X WITHIN 5 seconds AND Y WITHIN 2 TO 5 seconds"
    )
    home.sleec.trigger("B")
    home.clock.advance(20)
    assert home.taken() == [(0, "X"), (2, "Y")], "never two of them together"
    home.sleec.trigger("A")
    home.clock.advance(20)
    assert home.log == [], "what belongs together is refused together"
    (failure,) = home.told
    assert (failure.obligations, type(failure.error)) == (("X", "Y"), errors.ConflictInContext)


def test_what_the_clock_may_not_start_is_due_until_its_window_closes():
    home = Home(
        "EXCLUSIVE X, Y\nRULE a WHEN A THEN (X WITHIN 3 TO 5 seconds OTHERWISE Z) AND Y WITHIN 3 TO 5 seconds",
    )
    home.sleec.trigger("A")
    home.clock.advance(3)
    assert [type(failure.error) for failure in home.told] == [errors.ConflictInContext]
    assert len(home.sleec.pending()) == 2
    home.sleec.completed("Y")
    home.clock.advance(3)
    assert home.log == [(5, "Z")]
    assert len(home.told) == 1
