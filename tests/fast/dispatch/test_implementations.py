"""Which callable implements an obligation, and what recordings see of it."""

from __future__ import annotations

import asyncio
import inspect

import pytest

from sleec_runtime import Sleec, obligation, recording
from sleec_runtime.dispatch.implementations import implementations, obligation_of, snake_case, watched
from sleec_runtime.errors import NotBound, Unbindable
from sleec_runtime.language import parse


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
        ("call the nurse", "call_the_nurse"),
        ("Call the ICU nurse", "call_the_icu_nurse"),
        ("take the patient's coat", "take_the_patients_coat"),
        ("take the patient\u2019s coat", "take_the_patients_coat"),
        ("re-open door 3", "re_open_door_3"),
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


class Robot:
    """Unmarked methods that implement phrases."""

    def __init__(self) -> None:
        self.done: list[str] = []

    def call_nurse(self) -> None:
        self.done.append("nurse")

    def take_the_coat(self) -> None:
        self.done.append("coat")


PHRASES = "WHEN a guest comes THEN take the coat\nWHEN the user falls THEN call the nurse\n"


def test_a_phrase_reaches_the_method_of_its_words() -> None:
    sleec = Sleec(parse(PHRASES))
    sleec.implement(robot := Robot())
    sleec.trigger("a guest comes")
    assert robot.done == ["coat"]


def test_a_phrase_without_a_method_names_the_method_and_a_similar_one() -> None:
    sleec = Sleec(parse(PHRASES))
    sleec.implement(Robot())
    hint = r"`call_the_nurse`.*obligation\(\"call the nurse\"\); did you mean `call_nurse`\?"
    with pytest.raises(NotBound, match=hint):
        sleec.trigger("the user falls")


def test_an_object_that_implements_nothing_says_what_it_lacks() -> None:
    with pytest.raises(Unbindable, match=r"`call_the_nurse`, `take_the_coat`, .*; did you mean `call_nurse`\?"):
        Sleec(parse(PHRASES)).implement(type("Other", (), {"call_nurse": print})())
    with pytest.raises(Unbindable, match="the rules have no obligations"):
        Sleec(parse("DOMAIN home\nWHEN a guest comes THEN greet\n").in_domain("ward")).implement(Robot())


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
