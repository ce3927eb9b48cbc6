"""Rules with time and methods written by hand."""

from __future__ import annotations

import contextpy3 as cop
import pytest

from sleec_runtime import Monitor, errors, obligation, recording
from tests.support.homes import CHAIN, SMOKE, Home, written

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


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
