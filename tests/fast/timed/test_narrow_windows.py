"""Windows and prohibitions of one second, and alternatives of code that fails: at the edge of what the runtime does."""

from __future__ import annotations

import pytest

from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.errors import Prohibited
from sleec_runtime.language import parse


class Robot:
    """An instance on a virtual clock, with what it has executed and when."""

    def __init__(self, text: str, slow: tuple[str, ...] = (), broken: tuple[str, ...] = (), chains: bool = False):
        self.log: list[tuple[str, object]] = []
        self.clock = VirtualClock()
        rules = parse(text)
        self.sleec = Sleec(rules, clock=self.clock, chains=chains, on_error=lambda failure: None)

        def code(name: str):
            @obligation(name, completes=name not in slow)
            def function() -> None:
                self.log.append((name, self.clock.now()))
                if name in broken:
                    raise OSError(name)

            return function

        self.sleec.implement({name: code(name) for name in sorted(rules.obligations)})


LATER = "RULE do WHEN A THEN X WITHIN 2 TO 2 seconds\nRULE leave WHEN B THEN NOT X WITHIN 1 TO 3 seconds"


@pytest.mark.parametrize("slow", [(), ("X",)], ids=["at return", "completed later"])
def test_a_window_of_one_later_second_is_compared_with_prohibitions(slow) -> None:
    together = Robot(LATER, slow)
    with pytest.raises(Prohibited):
        together.sleec.trigger_all(["A", "B"])
    forbidden = Robot(LATER, slow)
    forbidden.sleec.trigger("B")
    with pytest.raises(Prohibited):
        forbidden.sleec.trigger("A")
    pending = Robot(LATER, slow)
    pending.sleec.trigger("A")
    with pytest.raises(Prohibited):
        pending.sleec.trigger("B")
    pending.clock.advance(10)
    assert pending.log == [("X", 2)]


def test_a_prohibition_of_one_later_second_is_compared_with_obligations() -> None:
    robot = Robot("RULE do WHEN A THEN X WITHIN 2 TO 2 seconds\nRULE leave WHEN B THEN NOT X WITHIN 2 TO 2 seconds")
    with pytest.raises(Prohibited):
        robot.sleec.trigger_all(["A", "B"])


def test_what_is_forbidden_for_the_second_in_which_it_opens_starts_after_it() -> None:
    robot = Robot("RULE do WHEN A THEN X WITHIN 2 TO 3 seconds\nRULE leave WHEN B THEN NOT X WITHIN 2 TO 2 seconds")
    robot.sleec.trigger_all(["A", "B"])
    robot.clock.advance(10)
    assert robot.log == [("X", 3)]
    assert robot.sleec.failures == ()


def test_an_else_whose_window_has_closed_is_not_started() -> None:
    failing = Robot("RULE do WHEN A THEN X WITHIN 3 TO 9 seconds ELSE Y WITHIN 2 seconds", broken=("X",))
    failing.sleec.trigger("A")
    failing.clock.advance(20)
    assert failing.log == [("X", 3)]
    broken = Robot("RULE do WHEN A THEN NOT X WITHIN 3 seconds ELSE Y WITHIN 2 seconds", slow=("X",))
    broken.sleec.trigger("A")
    broken.sleec.completed("X")
    broken.clock.advance(20)
    assert broken.log == []


def test_code_that_fails_and_leads_back_to_itself_ends() -> None:
    robot = Robot("RULE one WHEN A THEN X ELSE B\nRULE two WHEN B THEN X ELSE B", broken=("X",), chains=True)
    with pytest.raises(Exception, match="X"):
        robot.sleec.trigger("A")
    assert [name for name, _ in robot.log].count("B") <= 2
