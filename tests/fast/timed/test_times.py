"""Rules with times at work, on a clock that the tests move."""

from __future__ import annotations

import gc
import threading

import contextpy3 as cop
import pytest

import sleec_runtime
from sleec_runtime import Monitor, Sleec, VirtualClock, errors, obligation, recording
from sleec_runtime.language import parse
from sleec_runtime.timed.task import Task

SMOKE = """
RULE alarm WHEN Smoke THEN CallNurse WITHIN 10 seconds OTHERWISE SoundAlarm
RULE quiet WHEN Sleep THEN NOT SoundAlarm WITHIN 5 seconds
RULE test WHEN Test THEN SoundAlarm
RULE post WHEN Post THEN Fetch WITHIN 3 TO 8 seconds
"""


pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


class Home:
    """Rules at work, with a log of what was begun and when. What is in `slow` is not done when its callable returns,
    what is in `broken` raises."""

    def __init__(self, text: str, slow: tuple[str, ...] = (), **options) -> None:
        self.clock = VirtualClock()
        self.told: list[sleec_runtime.Failure] = []
        self.log: list[tuple[object, str]] = []
        self.broken: set[str] = set()
        self.arguments: list[object] = []
        self.sleec = Sleec(parse(text), clock=self.clock, on_error=self.told.append, **options)
        self.code = {name: self.callable(name, name in slow) for name in sorted(self.sleec.ruleset.obligations)}
        self.sleec.implement(self.code)

    def callable(self, name: str, slow: bool = False):
        @obligation(name, completes=not slow)
        def function(*args: object) -> None:
            self.log.append((self.clock.now(), name))
            self.arguments += args
            if name in self.broken:
                raise OSError(name)

        return function

    def taken(self) -> list[tuple[object, str]]:
        log, self.log = self.log, []
        return log


def shown(pending) -> list[str]:
    return [str(one) for one in pending]


# Obligations with a window --------------------------------------------------------------------------------


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


# In place of what is not done -----------------------------------------------------------------------------


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


# Prohibitions ---------------------------------------------------------------------------------------------


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


# Chains ---------------------------------------------------------------------------------------------------

CHAIN = "RULE a WHEN A THEN B\nRULE b WHEN B THEN C WITHIN 5 seconds\nRULE c WHEN C THEN D UNLESS quiet"


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


# Changes --------------------------------------------------------------------------------------------------


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


# Code written by hand -------------------------------------------------------------------------------------


def written(text: str, **options):
    clock = VirtualClock()
    return clock, Sleec(parse(text), clock=clock, **options)


def test_a_method_of_a_rule_is_run_when_the_window_opens():
    clock, sleec = written("RULE a WHEN A THEN X WITHIN 2 TO 5 seconds UNLESS c IN WHICH CASE Y WITHIN 4 seconds")
    log: list[tuple[object, ...]] = []

    class Robot:
        @sleec.rule("a")
        @cop.base
        def a(self, message):
            self.x()

        @cop.around(sleec.layers["a.hc1"])  # type: ignore[no-redef]
        def a(self, message):  # noqa: F811
            log.append((clock.now(), "Y", message))

        @obligation("X", completes=False)
        def x(self):
            log.append((clock.now(), "X"))

    sleec.bind(Robot())
    (due,) = sleec.trigger("A", "now").due
    clock.advance(3)
    assert log == [(2, "X")]
    assert due.state == "under way"
    due.completed()
    sleec.update({"c": True})
    done = sleec.trigger("A", "then")
    assert log[1:] == [(3, "Y", "then")]
    assert done.due == ()
    assert done.results == {"a": None}


def test_what_a_method_cannot_do_is_refused():
    _, sleec = written(
        "RULE a WHEN A THEN X WITHIN 2 TO 5 seconds AND Y WITHIN 5 seconds\n"
        "RULE b WHEN B THEN X WITHIN 5 seconds OTHERWISE Z"
    )

    @sleec.rule("a")
    @sleec.rule("b")
    def method():
        raise AssertionError

    sleec.bind(method)
    assert set(sleec.missing()) == {"a", "b"}
    with pytest.raises(errors.NotBound, match="different start times"):
        sleec.trigger("A")
    with pytest.raises(errors.NotBound, match="may require Z in place of X"):
        sleec.trigger("B")
    sleec.implement({"Z": lambda: None})
    assert set(sleec.missing()) == {"a"}


def test_what_does_not_take_the_arguments_is_refused_for_later_too():
    home = Home("RULE a WHEN A THEN X WITHIN 5 seconds OTHERWISE (Y UNLESS c IN WHICH CASE Z)")
    home.sleec.implement({"Y": lambda: None})
    with pytest.raises(errors.WrongArguments):
        home.sleec.trigger("A", "argument")
    assert home.log == []
    home.sleec.update({"c": True})
    home.sleec.trigger("A", "argument")
    home.sleec.trigger("A", "argument")


def test_nothing_runs_if_code_is_missing():
    _, sleec = written("RULE a WHEN A THEN X WITHIN 5 seconds")
    with pytest.raises(errors.NotBound):
        sleec.trigger("A")
    assert sleec.due("A").obligations == ("X",)
    with pytest.raises(errors.UnknownTrigger):
        sleec.trigger("B")
    with pytest.raises(errors.WrongType):
        sleec.trigger_all("A")


def test_recordings_see_what_the_clock_starts():
    home = Home(SMOKE, slow=("CallNurse",))
    home.sleec.trigger("Smoke")
    with recording() as seen:
        home.clock.advance(10)
    assert seen.executed == ["SoundAlarm"]


def test_the_monitor_looks_at_what_a_trigger_starts():
    home = Home(SMOKE + CHAIN, slow=("CallNurse",), chains=True)
    differences: list[object] = []
    with Monitor(home.sleec, differences.append):
        home.sleec.trigger("Smoke")
        home.sleec.trigger("Post")
        home.sleec.trigger("A")
        home.clock.advance(20)
        assert differences == []
        home.broken.add("C")
        with pytest.raises(OSError, match="C"):
            home.sleec.trigger("A")
    assert str(differences[0]) == "A: not executed: C, D"


# Strict mode, limits --------------------------------------------------------------------------------------


def test_strict_mode_asks_for_what_decides_alternatives_too():
    home = Home("RULE a WHEN A THEN X WITHIN 5 seconds OTHERWISE (Y UNLESS c)", strict=True)
    with pytest.raises(errors.UndeterminedDecision) as caught:
        home.sleec.trigger("A")
    assert caught.value.missing == ("c",)
    home.sleec.update({"c": True})
    home.sleec.trigger("A")


def test_strict_mode_asks_for_what_decides_rules():
    home = Home("RULE a WHEN A THEN X WITHIN 5 seconds UNLESS c", strict=True)
    with pytest.raises(errors.UndeterminedDecision):
        home.sleec.trigger("A")


LIMITED = """
MEASURE long: integer
RELATION A WITNESSES X
RULE a WHEN A THEN X EVENTUALLY
RULE x WHEN X THEN Y WITHIN long minutes OTHERWISE (Z EVENTUALLY UNLESS c IN WHICH CASE NOT Z EVENTUALLY)
"""


@pytest.mark.filterwarnings("default")
def test_what_cannot_be_enforced_is_named_at_load(tmp_path):
    path = tmp_path / "limited.sleec"
    path.write_text(LIMITED, encoding="utf-8")
    with pytest.warns(errors.NotEnforced) as caught:
        sleec_runtime.load(path)
    (warning,) = caught
    assert warning.filename == __file__
    assert isinstance(warning.message, errors.NotEnforced)
    assert warning.message.constructs == (
        ("the relation witness", 3),
        ("`X` eventually (it is started, without a deadline)", 4),
        ("rules that `X` triggers as a response (chains=True enforces them)", 4),
        ("a window of length `long` while `long` has no value", 5),
        ("`Z` eventually (it is started, without a deadline)", 5),
    )
    with pytest.warns(errors.NotEnforced) as caught:
        Sleec(parse(LIMITED), chains=True)
    (warning,) = caught
    assert warning.filename == __file__
    assert isinstance(warning.message, errors.NotEnforced)
    assert len(warning.message.constructs) == 4


def test_what_cannot_be_enforced_is_an_error_on_request(tmp_path):
    path = tmp_path / "limited.sleec"
    path.write_text(LIMITED, encoding="utf-8")
    with pytest.raises(errors.UnsupportedTimes, match="the relation witness, line 3") as caught:
        sleec_runtime.load(path, strict_times=True)
    assert caught.value.lines == (3, 4, 4, 5, 5)
    sleec = Sleec(parse(SMOKE), strict_times=True)
    with pytest.raises(errors.UnsupportedTimes):
        sleec.replace(parse(LIMITED), implement=dict.fromkeys("XYZ", print))
    assert sleec.ruleset == parse(SMOKE)


def test_eventually_is_begun_and_a_prohibition_for_good_is_kept():
    home = Home("RULE a WHEN A THEN X EVENTUALLY\nRULE b WHEN B THEN NOT X EVENTUALLY", slow=("X",))
    (due,) = home.sleec.trigger("A").due
    assert str(due) == "X (a): under way, never closes"
    with pytest.raises(errors.Prohibited, match="rule `b` forbids it permanently"):
        home.sleec.trigger("B")
    home.clock.advance(10_000)
    assert home.sleec.completed("X") == (due,)
    home.sleec.trigger("B")
    home.clock.advance(10_000)
    with pytest.raises(errors.Prohibited, match="permanently") as caught:
        home.sleec.trigger("A")
    assert caught.value.over is None


def test_global_activation_refuses_times():
    home = Home(SMOKE)
    with pytest.raises(errors.UnsupportedTimes, match="global activation"):
        home.sleec.activate_globally()
    plain = Sleec(parse("RULE a WHEN A THEN X"))
    plain.implement({"X": lambda: None})
    with plain.activate_globally(), pytest.raises(errors.UnsupportedTimes):
        plain.replace(parse(SMOKE), implement=home.code)
    assert plain.ruleset == parse("RULE a WHEN A THEN X")


def test_choices_are_true_or_false():
    with pytest.raises(errors.WrongType, match="chains"):
        Sleec(parse(SMOKE), chains="yes")  # type: ignore[arg-type]


# What goes wrong while nobody calls -----------------------------------------------------------------------


def test_what_raises_under_the_clock_is_told_and_kept():
    home = Home(SMOKE, slow=("CallNurse",))
    home.broken.add("SoundAlarm")
    home.broken.add("Fetch")
    home.sleec.trigger("Smoke")
    home.sleec.trigger("Post")
    home.clock.advance(20)
    assert [(f.time, f.rule, f.obligations, type(f.error)) for f in home.told] == [
        (3, "post", ("Fetch",), OSError),
        (8, "post", ("Fetch",), errors.DeadlineMissed),
        (10, "alarm", ("SoundAlarm",), OSError),
    ]
    assert home.sleec.failures == tuple(home.told)


def test_what_is_refused_under_the_clock_is_told_and_kept():
    home = Home(SMOKE, slow=("CallNurse",))
    home.sleec.trigger("Smoke")
    home.clock.advance(8)
    home.sleec.trigger("Sleep")
    home.clock.advance(20)
    (failure,) = home.told
    assert isinstance(failure.error, errors.Prohibited)
    assert home.log == [(0, "CallNurse")]


def test_what_is_to_begin_at_a_moment_and_is_forbidden_then_has_its_otherwise():
    home = Home("RULE a WHEN A THEN X WITHIN 3 TO 3 seconds OTHERWISE Y\nRULE b WHEN B THEN NOT X WITHIN 5 seconds")
    home.sleec.trigger("A")
    home.sleec.trigger("B")
    home.clock.advance(20)
    assert home.log == [(3, "Y")]
    assert [failure.rule for failure in home.told] == ["a"]
    assert home.sleec.pending() == ()


def test_what_the_clock_starts_at_one_time_happens_at_once():
    home = Home(
        "RULE a WHEN A THEN X WITHIN 3 seconds OTHERWISE Y\nRULE b WHEN A THEN X WITHIN 3 seconds OTHERWISE NOT Y\n"
        "RULE c WHEN C THEN X WITHIN 3 seconds OTHERWISE NOT Y\n"
        "RULE d WHEN C THEN X WITHIN 3 seconds OTHERWISE Y WITHIN 4 seconds",
        slow=("X",),
    )
    home.sleec.trigger("A")
    home.clock.advance(10)
    assert home.taken() == [(0, "X"), (0, "X"), (3, "Y")]
    assert "`Y` was done at this moment, but rule `b` forbids it at this moment" in str(home.told[0].error)
    home.sleec.trigger("C")
    home.clock.advance(10)
    assert home.taken() == [(10, "X"), (10, "X"), (14, "Y")], "once it is allowed"
    assert len(home.told) == 1


def test_without_a_handler_the_log_is_told(caplog):
    clock, sleec = written("RULE a WHEN A THEN X WITHIN 9 seconds")
    sleec.implement({"X": obligation("X", completes=False)(lambda: None)})
    sleec.trigger("A")
    clock.advance(9)
    assert [record.name for record in caplog.records] == ["sleec_runtime"]
    assert "`X` was not done within 9 seconds" in caplog.text


def test_a_handler_that_raises_stops_nothing(caplog):
    clock = VirtualClock()

    def handler(failure: object) -> None:
        raise ZeroDivisionError

    sleec = Sleec(parse("RULE a WHEN A THEN X WITHIN 9 seconds"), clock=clock, on_error=handler)
    sleec.implement({"X": obligation("X", completes=False)(lambda: None)})
    sleec.trigger("A")
    sleec.trigger("A")
    clock.advance(9)
    assert len(sleec.failures) == 2
    assert caplog.text.count("on_error failed") == 2


def test_a_closed_instance_watches_nothing():
    home = Home(SMOKE, slow=("CallNurse",))
    with home.sleec as sleec:
        sleec.trigger("Smoke")
    home.clock.advance(100)
    assert home.log == [(0, "CallNurse")]
    assert len(home.sleec.pending()) == 1
    with pytest.raises(errors.SleecError, match="closed"):
        home.sleec.trigger("Smoke")
    assert home.taken() == [(0, "CallNurse")]
    home.sleec.trigger("Test")
    assert home.log == [(100, "SoundAlarm")]


def test_much_that_is_done_leaves_little_behind():
    home = Home("RULE a WHEN A THEN X WITHIN 1 day")
    for _ in range(10_000):
        home.sleec.trigger("A")
    assert sum(isinstance(one, Task) for one in gc.get_objects()) < 200


def test_threads_may_trigger_while_the_clock_runs():
    home = Home(
        "RULE a WHEN A THEN X WITHIN 5 seconds\nRULE b WHEN B THEN NOT Y WITHIN 5 seconds\nRULE y WHEN C THEN Y"
    )
    refused: list[int] = []

    def work() -> None:
        for number in range(300):
            home.sleec.trigger("A")
            home.sleec.trigger("B")
            try:
                home.sleec.trigger("C")
            except errors.Prohibited:
                refused.append(number)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(refused) == 1_200
    assert all(one.prohibited for one in home.sleec.pending())
    home.clock.advance(7)
    assert home.sleec.pending() == ()
    assert home.told == []
