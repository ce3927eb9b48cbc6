"""Which callable implements an obligation, and what recordings see of it."""

from __future__ import annotations

import asyncio
import inspect

import pytest

from sleec_runtime import obligation, recording
from sleec_runtime.dispatch.implementations import implementations, obligation_of, snake_case, watched


@pytest.mark.parametrize(
    ("name", "method"),
    [
        ("OpenCurtains", "open_curtains"),
        ("AskLegalPresence", "ask_legal_presence"),
        ("AddressSirOrMadam", "address_sir_or_madam"),
        ("CallDNRTeam", "call_dnr_team"),
        ("Step2Done", "step2_done"),
        ("wait", "wait"),
        ("already_snake", "already_snake"),
    ],
)
def test_the_name_in_snake_case(name: str, method: str) -> None:
    assert snake_case(name) == method


def test_a_marked_function_does_what_it_did() -> None:
    @obligation("OpenCurtains")
    def pull(far: int, *, slowly: bool = False) -> tuple[int, bool]:
        """Pulls."""
        return far, slowly

    assert pull(3, slowly=True) == (3, True)
    assert (pull.__name__, pull.__doc__) == ("pull", "Pulls.")
    assert list(inspect.signature(pull).parameters) == ["far", "slowly"]
    assert obligation_of(pull) == "OpenCurtains"
    assert obligation_of(print) is None


class Arm:
    @obligation("OpenCurtains")
    def pull(self) -> None: ...


class LongArm(Arm):
    @obligation("OpenCurtains")
    def pull(self) -> None:
        super().pull()


def test_an_override_that_calls_super_is_executed_once() -> None:
    with recording() as seen:
        LongArm().pull()
        LongArm().pull()
    assert seen.executed == ["OpenCurtains", "OpenCurtains"]


def test_recordings_nest_and_end() -> None:
    arm = Arm()
    with recording() as outer:
        arm.pull()
        with recording() as inner:
            arm.pull()
    arm.pull()
    assert (outer.executed, inner.executed) == (["OpenCurtains"] * 2, ["OpenCurtains"])


def test_recordings_kept_apart_do_not_report_to_each_other() -> None:
    arm = Arm()
    with recording() as all_of_it, recording(apart=True) as outer, recording(apart=True) as inner:
        arm.pull()
    assert (all_of_it.executed, outer.executed, inner.executed) == (["OpenCurtains"], [], ["OpenCurtains"])


def test_what_raises_is_executed_and_failed() -> None:
    @obligation("Help")
    def stuck() -> None:
        raise RuntimeError

    @obligation("Call")
    async def stuck_too() -> None:
        raise RuntimeError

    with recording() as outer, recording() as seen:
        with pytest.raises(RuntimeError):
            stuck()
        with pytest.raises(RuntimeError):
            asyncio.run(stuck_too())
    assert seen.executed == seen.failed == outer.failed == ["Help", "Call"]
    with pytest.raises(RuntimeError):
        asyncio.run(stuck_too())


def test_implementations_are_found_by_mark_before_name() -> None:
    class Robot(Arm):
        def open_curtains(self) -> None: ...

        def wait(self) -> None: ...

        help = "no method"

    robot = Robot()
    assert implementations(robot, ["OpenCurtains", "Wait", "Help", "Call"]) == {
        "OpenCurtains": robot.pull,
        "Wait": robot.wait,
    }


def test_unmarked_methods_can_be_watched_for_a_while() -> None:
    class Robot(Arm):
        def wait(self) -> str:
            return "waited"

    robot = Robot()
    with watched(robot, ["OpenCurtains", "Wait"]), recording() as seen:
        assert robot.wait() == "waited"
        robot.pull()
    assert seen.executed == ["Wait", "OpenCurtains"]
    assert vars(robot) == {}
