"""Strict mode, limits, and errors that no caller sees."""

from __future__ import annotations

import gc
import threading

import pytest

import sleec_runtime
from sleec_runtime import Sleec, VirtualClock, errors, obligation
from sleec_runtime.language import parse
from sleec_runtime.timed.task import Task
from tests.support.homes import SMOKE, Home, written

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


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
