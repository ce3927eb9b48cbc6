"""The test sees everything that the robot's code does, however the robot calls it."""

from __future__ import annotations

import sys
import threading
import types
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from sleec_runtime import Sleec
from sleec_runtime.language import parse
from sleec_verify.conformance import Nonconformance, check_conformance

UNTIMED = parse("RULE r WHEN T THEN A\nRULE s WHEN U THEN B")
TIMED = parse("RULE r WHEN T THEN A WITHIN 5 seconds\nRULE s WHEN U THEN B WITHIN 2 seconds")


class Plain:
    """Each method does what its name says, and nothing else."""

    def a(self) -> None:
        pass

    def b(self) -> None:
        pass


class CallsItself(Plain):
    def a(self) -> None:
        self.b()


class CallsThroughTheClass(Plain):
    def a(self) -> None:
        Plain.b(self)


class CallsThroughSuper(Plain):
    def a(self) -> None:
        super().b()


class WithSlots(Plain):
    __slots__ = ()

    def a(self) -> None:
        self.b()


class WithCoroutines(Plain):
    async def a(self) -> None:  # type: ignore[override]
        await self.b()

    async def b(self) -> None:  # type: ignore[override]
        pass


class StartsAThread(Plain):
    def a(self) -> None:
        threading.Thread(target=self.b).start()


class UsesAPool(Plain):
    pool = ThreadPoolExecutor(1)

    def a(self) -> None:
        self.pool.submit(self.b)


def module() -> types.ModuleType:
    """A module whose function `a` calls `b`."""
    found = types.ModuleType("a_robot_of_functions")
    exec("def a(): b()\ndef b(): pass", found.__dict__)
    sys.modules[found.__name__] = found
    return found


def whole(robot: Any) -> Any:
    return robot


def methods(robot: Any) -> Any:
    return {"A": robot.a, "B": robot.b}


def check(make_robot: Callable[[], Any], give: Callable[[Any], Any], rules: Any, **options: Any) -> None:
    def make(clock: Any) -> Sleec:
        sleec = Sleec(rules, clock=clock, on_error=lambda failure: None)
        sleec.implement(give(make_robot()))
        return sleec

    check_conformance(make, rules, parts=["each-rule"], **options)


ROBOTS = [CallsItself, CallsThroughTheClass, CallsThroughSuper, WithSlots, WithCoroutines, module]


@pytest.mark.parametrize("rules", [UNTIMED, TIMED], ids=["untimed", "timed"])
@pytest.mark.parametrize("give", [whole, methods])
@pytest.mark.parametrize("robot", ROBOTS)
def test_what_an_implementation_does_beside_its_obligation_is_seen(robot: Any, give: Any, rules: Any) -> None:
    with pytest.raises(Nonconformance, match="although not required"):
        check(robot, give, rules)


@pytest.mark.parametrize("rules", [UNTIMED, TIMED], ids=["untimed", "timed"])
@pytest.mark.parametrize("robot", [StartsAThread, UsesAPool])
def test_what_another_thread_executes_is_seen(robot: Any, rules: Any) -> None:
    with pytest.raises(Nonconformance, match="although not required"):
        check(robot, whole, rules)


@pytest.mark.parametrize("rules", [UNTIMED, TIMED], ids=["untimed", "timed"])
@pytest.mark.parametrize("give", [whole, methods])
def test_a_robot_that_does_nothing_else_passes(give: Any, rules: Any) -> None:
    check(Plain, give, rules)


def test_other_objects_of_the_class_do_not_count() -> None:
    other = Plain()

    class Asks(Plain):
        def a(self) -> None:
            other.b()

    check(Asks, whole, UNTIMED)


def test_the_code_is_as_before_after_the_test() -> None:
    before = dict(vars(Plain))
    check(Plain, whole, UNTIMED)
    assert dict(vars(Plain)) == before
