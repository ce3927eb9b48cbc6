"""Obligations with a window, and what is due in place of what is not done."""

from __future__ import annotations

import pytest

from sleec_runtime import errors
from tests.support.homes import SMOKE, Home, shown

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


def test_what_has_a_window_is_begun_at_once_and_done_when_its_callable_returns():
    home = Home(SMOKE)
    done = home.sleec.trigger("Smoke")
    assert home.log == [(0, "CallNurse")]
    assert done.obligations == ("CallNurse",)
    assert done.due == ()
    assert home.sleec.pending() == ()
    home.clock.advance(100)
    assert home.log == [(0, "CallNurse")]
    assert home.told == []


def test_what_takes_time_is_due_until_it_is_reported():
    home = Home(SMOKE, slow=("CallNurse",))
    home.clock.advance(2)
    done = home.sleec.trigger("Smoke")
    (due,) = done.due
    assert (due.obligation, due.rule, due.start, due.until, due.state) == ("CallNurse", "alarm", 2, 12, "under way")
    assert not due.prohibited
    assert shown(home.sleec.pending()) == ["CallNurse (alarm): under way, closes in 10 seconds"]
    assert done.explain().endswith("\nCallNurse (alarm): under way, closes in 10 seconds")
    home.clock.advance(9)
    assert home.sleec.completed("CallNurse") == (due,)
    assert (due.state, due.is_open) == ("done", False)
    assert done.due == home.sleec.pending() == ()
    home.clock.advance(100)
    assert home.log == [(2, "CallNurse")]


def test_the_handle_of_what_is_due_reports_too():
    home = Home(SMOKE, slow=("CallNurse",))
    (due,) = home.sleec.trigger("Smoke").due
    due.completed()
    assert due.state == "done"
    assert len({due, *home.sleec.completed("CallNurse")}) == 1
    assert due != "CallNurse"
    assert repr(due) == "<Pending CallNurse (alarm): done>"


def test_what_opens_later_is_begun_then():
    home = Home(SMOKE)
    done = home.sleec.trigger("Post", "letter")
    assert home.log == []
    assert shown(done.due) == ["Fetch (post): waiting, opens in 3 seconds, closes in 8 seconds"]
    home.clock.advance(2)
    assert home.log == []
    home.clock.advance(2)
    assert home.log == [(3, "Fetch")]
    assert home.arguments == ["letter"]
    assert done.due == ()


def test_done_before_its_window_opens_is_not_done():
    home = Home(SMOKE, slow=("Fetch",))
    (due,) = home.sleec.trigger("Post").due
    assert home.sleec.completed("Fetch") == ()
    home.clock.advance(5)
    assert due.state == "under way"
    assert home.sleec.completed("Fetch") == (due,)


def test_whoever_does_it_it_is_done():
    home = Home("RULE a WHEN A THEN X WITHIN 9 seconds\nRULE b WHEN B THEN X", slow=())
    home.broken.add("X")
    with pytest.raises(OSError, match="X"):
        home.sleec.trigger("A")
    (due,) = home.sleec.pending()
    assert str(due) == "X (a): waiting, closes in 9 seconds", "it can still be done"
    home.broken.clear()
    home.sleec.trigger("B")
    assert due.state == "done"


def test_a_missed_deadline_is_told_and_kept():
    home = Home("RULE a WHEN A THEN X WITHIN 9 seconds", slow=("X",))
    (due,) = home.sleec.trigger("A").due
    home.clock.advance(20)
    (failure,) = home.told
    assert home.sleec.failures == (failure,)
    assert isinstance(failure.error, errors.DeadlineMissed)
    assert (failure.error.obligation, failure.error.until, due.state) == ("X", 9, "missed")
    assert str(failure) == "X (a): `X` was not done within 9 seconds of the trigger of rule `a`"
    assert home.sleec.completed("X") == (), "too late"


def test_a_window_of_no_length_is_kept_by_beginning_in_it():
    home = Home("RULE a WHEN A THEN X WITHIN 0 seconds\nRULE b WHEN B THEN Y WITHIN 3 TO 3 seconds")
    home.sleec.trigger_all(["A", "B"])
    home.clock.advance(10)
    assert home.log == [(0, "X"), (3, "Y")]
    assert home.told == []


def test_what_is_due_at_once_and_takes_time_has_no_deadline():
    home = Home("RULE a WHEN A THEN X", slow=("X",), chains=True)
    (due,) = home.sleec.trigger("A").due
    assert str(due) == "X (a): under way, never closes"
    home.clock.advance(1_000)
    assert home.sleec.completed("X") == (due,)


def test_a_measure_says_how_long():
    home = Home("MEASURE patience: integer\nRULE a WHEN A THEN X WITHIN 1 TO patience seconds")
    with pytest.raises(errors.UndeterminedDecision, match="report `patience` with update") as caught:
        home.sleec.trigger("A")
    assert caught.value.missing == ("patience",)
    home.sleec.update({"patience": -1})
    with pytest.raises(errors.WrongType, match="patience"):
        home.sleec.trigger("A")
    home.sleec.update({"patience": 0})
    with pytest.raises(errors.WrongType, match="end of a window"):
        home.sleec.trigger("A")
    home.sleec.update({"patience": 2})
    (due,) = home.sleec.trigger("A").due
    assert str(due) == "X (a): waiting, opens in 1 second, closes in 2 seconds"
    assert home.log == []


def test_a_calculation_says_how_long():
    home = Home(
        "def_start event A event X measure warmth: numeric measure load: numeric def_end "
        "rule_start a when A then X within (120 - (22 - {warmth}) * {load}) seconds rule_end",
        slow=("X",),
    )
    home.sleec.update({"warmth": 20})
    with pytest.raises(errors.UndeterminedDecision, match="report `load` with update"):
        home.sleec.trigger("A")
    home.sleec.update({"load": 100})
    with pytest.raises(errors.WrongType, match=r"from 0 to 1,000,000,000,000 seconds; got -80"):
        home.sleec.trigger("A")
    home.sleec.update({"load": 15})
    (due,) = home.sleec.trigger("A").due
    assert str(due) == "X (a): under way, closes in 90 seconds"


def test_otherwise_is_done_when_the_window_closes_undone():
    home = Home(SMOKE, slow=("CallNurse",))
    (due,) = home.sleec.trigger("Smoke", "kitchen").due
    home.clock.advance(30)
    assert home.log == [(0, "CallNurse"), (10, "SoundAlarm")]
    assert home.arguments == ["kitchen", "kitchen"]
    assert due.state == "replaced"
    assert home.told == []


def test_otherwise_has_hedges_decided_at_the_trigger_and_windows_counted_from_the_close():
    home = Home(
        """
        MEASURE calm: integer
        RULE a WHEN A THEN X WITHIN 5 seconds OTHERWISE
            (Y WITHIN 4 seconds OTHERWISE Z UNLESS c IN WHICH CASE W WITHIN 2 TO calm seconds)
        """,
        slow=("X", "Y"),
    )
    home.sleec.trigger("A")
    home.sleec.update({"c": True, "calm": 3})
    home.clock.advance(5)
    assert shown(home.sleec.pending()) == ["Y (a): under way, closes in 4 seconds"]
    home.clock.advance(100)
    assert home.taken() == [(0, "X"), (5, "Y"), (9, "Z")]
    home.sleec.trigger("A")
    home.sleec.update({"c": False, "calm": 100})
    home.clock.advance(100)
    assert home.taken() == [(105, "X"), (112, "W")]
    assert home.told == []


def test_otherwise_may_be_a_prohibition_or_nothing():
    text = "RULE a WHEN A THEN X WITHIN 5 seconds OTHERWISE (NOT Y WITHIN 5 seconds UNLESS c)\nRULE b WHEN B THEN Y"
    home = Home(text, slow=("X",))
    home.sleec.trigger("A")
    home.sleec.update({"c": True})
    home.sleec.trigger("A")
    home.clock.advance(6)
    assert shown(home.sleec.pending()) == ["NOT Y (a): in force, closes in 4 seconds"]
    with pytest.raises(errors.Prohibited):
        home.sleec.trigger("B")
    assert home.told == []


def test_else_is_done_if_the_first_raises():
    home = Home("RULE a WHEN A THEN X ELSE Y WITHIN 5 seconds", slow=("Y",))
    home.sleec.trigger("A")
    assert home.taken() == [(0, "X")]
    home.broken.add("X")
    with pytest.raises(OSError, match="X"):
        home.sleec.trigger("A")
    assert home.taken() == [(0, "X"), (0, "Y")]
    assert shown(home.sleec.pending()) == ["Y (a): under way, closes in 5 seconds"]


def test_otherwise_of_what_is_due_at_once_is_done_if_it_raises():
    home = Home("RULE a WHEN A THEN X OTHERWISE Y\nRULE b WHEN B THEN X")
    home.broken.add("X")
    with pytest.raises(OSError, match="X"):
        home.sleec.trigger("A")
    assert home.taken() == [(0, "X"), (0, "Y")]
    with pytest.raises(OSError, match="X"):
        home.sleec.trigger("B")
    assert home.sleec.pending() == ()


def test_else_is_begun_when_the_window_closes_if_there_is_time_for_it():
    home = Home(
        "RULE a WHEN A THEN X WITHIN 5 seconds ELSE Y WITHIN 8 seconds\n"
        "RULE b WHEN B THEN X WITHIN 5 seconds ELSE Y WITHIN 4 seconds",
        slow=("X",),
    )
    home.sleec.trigger("A")
    home.clock.advance(10)
    assert home.taken() == [(0, "X"), (5, "Y")]
    home.sleec.trigger("B")
    home.clock.advance(10)
    assert home.taken() == [(10, "X")]
    assert [type(failure.error) for failure in home.told] == [errors.DeadlineMissed]


def test_what_is_reported_and_then_raises_is_done():
    home = Home("RULE a WHEN A THEN X WITHIN 5 seconds ELSE Y", slow=("X",))

    def reports() -> None:
        home.sleec.completed("X")
        raise OSError("X")

    home.sleec.implement({"X": reports})
    with pytest.raises(OSError, match="X"):
        home.sleec.trigger("A")
    assert home.log == []


def test_an_alternative_that_is_refused_is_raised_with_the_rest():
    home = Home("RULE a WHEN A THEN X ELSE Y\nRULE b WHEN B THEN NOT Y WITHIN 5 seconds")
    home.broken.add("X")
    home.sleec.trigger("B")
    with pytest.raises(errors.VariantsFailed) as caught:
        home.sleec.trigger("A")
    assert [type(error) for _, error in caught.value.errors] == [OSError, errors.Prohibited]
    assert home.log == [(0, "X")]
