"""`anticipate` prepares a trigger: it makes the plan and checks the arguments, and runs nothing."""

from __future__ import annotations

import pytest

from sleec_runtime import Monitor, Sleec, VirtualClock, obligation, recording
from sleec_runtime.dispatch import execution
from sleec_runtime.errors import NotBound, UnknownTrigger, WrongArguments
from sleec_runtime.facade import dispatcher
from sleec_runtime.language import parse
from sleec_runtime.monitor.difference import Difference

RULES = "RULE r WHEN A THEN X UNLESS C IN WHICH CASE Y"


def test_a_trigger_that_was_anticipated_makes_no_plan(monkeypatch) -> None:
    sleec, did = Sleec(parse(RULES)), []
    sleec.implement({"X": lambda message: did.append("X"), "Y": lambda message: did.append("Y")})
    sleec.update({"C": True})
    sleec.anticipate("A", None)
    assert did == []

    plans = []

    def counted(*given):
        plans.append(given)
        return execution.plan(*given)

    monkeypatch.setattr(dispatcher, "plan", counted)
    sleec.trigger("A", None)
    assert (did, plans) == (["Y"], [])
    sleec.update({"C": False})
    sleec.trigger("A", None)
    assert (did, len(plans)) == (["Y", "X"], 1)


def test_it_raises_what_the_trigger_would_raise() -> None:
    sleec = Sleec(parse(RULES))
    with pytest.raises(NotBound):
        sleec.anticipate("A", None)
    sleec.implement({"X": print, "Y": lambda message: None})
    sleec.update({"C": True})
    with pytest.raises(WrongArguments):
        sleec.anticipate("A")
    with pytest.raises(UnknownTrigger):
        sleec.anticipate("B")


def test_other_code_and_other_rules_count_at_once() -> None:
    sleec, did = Sleec(parse(RULES)), []
    sleec.implement({"X": lambda: did.append("old"), "Y": print})
    sleec.anticipate("A")
    sleec.implement({"X": lambda: did.append("new")})
    assert sleec.trigger("A").obligations == ("X",)
    sleec.anticipate("A")
    sleec.replace(parse("RULE r WHEN A THEN Z"), implement={"Z": lambda: did.append("other")})
    assert sleec.trigger("A").obligations == ("Z",)
    assert did == ["new", "other"]


def test_a_monitor_sees_what_was_anticipated() -> None:
    sleec = Sleec(parse(RULES))
    differences: list[Difference] = []
    sleec.implement({"X": lambda: None, "Y": lambda: None})
    with Monitor(sleec, differences.append), recording() as seen:
        sleec.anticipate("A")
        sleec.trigger("A")
    assert (seen.executed, differences) == (["X"], [])


def test_rules_with_times_start_through_their_scheduler() -> None:
    sleec = Sleec(parse("RULE r WHEN A THEN X WITHIN 5 minutes"), clock=VirtualClock())
    sleec.implement({"X": obligation("X", completes=False)(lambda: None)})
    sleec.anticipate("A")
    sleec.trigger("A")
    assert [pending.obligation for pending in sleec.pending()] == ["X"]
