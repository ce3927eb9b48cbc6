"""Messages tell the time that is left, not what a clock shows."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from sleec_runtime import Sleec, VirtualClock, errors, obligation
from sleec_runtime.language import parse
from tests.thorough.timed.test_times_random import STEPS, World

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")

RULES = """
RULE quiet WHEN Sleep THEN NOT Alarm WITHIN 4 seconds
RULE later WHEN Nap THEN NOT Alarm WITHIN 2 TO 5 seconds
RULE then WHEN Prayer THEN NOT Alarm WITHIN 2 TO 2 seconds
RULE never WHEN Holiday THEN NOT Alarm EVENTUALLY
RULE once WHEN Guest THEN NOT Alarm
RULE test WHEN Test THEN Alarm
RULE soon WHEN Smoke THEN Alarm WITHIN 3 TO 4 seconds
RULE call WHEN Fall THEN Call WITHIN 1 minute
RULE walk WHEN Morning THEN Walk EVENTUALLY
"""


class Home:
    """Rules at work on a clock that starts at a time that no message shows."""

    def __init__(self) -> None:
        self.clock = VirtualClock(4270.824)
        self.sleec = Sleec(parse(RULES), clock=self.clock, on_error=lambda failure: None)
        slow = {name: obligation(name, completes=False)(lambda: None) for name in ("Call", "Walk")}
        self.sleec.implement({"Alarm": lambda: None, **slow})

    def refused(self, *triggers: str) -> str:
        with pytest.raises(errors.Prohibited) as refusal:
            self.sleec.trigger_all(triggers)
        return refusal.value.message

    def pending(self) -> list[str]:
        return [str(one) for one in self.sleec.pending()]


@pytest.mark.parametrize(
    ("triggers", "seconds", "text"),
    [
        (["Sleep"], 0.8, "`Alarm` is due, but rule `quiet` forbids it for 3.2 more seconds"),
        (["Sleep"], 3, "`Alarm` is due, but rule `quiet` forbids it for 1 more second"),
        (["Sleep"], 4, "`Alarm` is due, but rule `quiet` forbids it at this moment"),
        (["Sleep"], 3.9999, "`Alarm` is due, but rule `quiet` forbids it for 0.001 more seconds"),
        (["Nap"], 2.5, "`Alarm` is due, but rule `later` forbids it for 2.5 more seconds"),
        (["Holiday"], 5, "`Alarm` is due, but rule `never` forbids it permanently"),
        (
            ["Sleep", "Nap"],
            3,
            (
                "`Alarm` is due, but rule `quiet` forbids it for 1 more second and "
                "rule `later` forbids it for 2 more seconds"
            ),
        ),
    ],
)
def test_a_refusal_says_for_how_long(triggers: list[str], seconds: float, text: str) -> None:
    home = Home()
    home.sleec.trigger_all(triggers)
    home.clock.advance(seconds)
    assert home.refused("Test") == text


@pytest.mark.parametrize(
    ("before", "now", "text"),
    [
        ("Nap", "Smoke", "rule `later` forbids it for 3 seconds, 2 seconds from now"),
        ("Holiday", "Smoke", "rule `never` forbids it permanently"),
    ],
)
def test_a_refusal_of_what_opens_later_says_from_when(before: str, now: str, text: str) -> None:
    home = Home()
    home.sleec.trigger(before)
    assert home.refused(now) == f"`Alarm` is due (soon, opens in 3 seconds, closes in 4 seconds), but {text}"


def test_pending_says_what_is_left() -> None:
    home = Home()
    home.sleec.trigger_all(["Fall", "Nap", "Holiday", "Morning"])
    assert home.pending() == [
        "NOT Alarm (later): in force, opens in 2 seconds, closes in 5 seconds",
        "Call (call): under way, closes in 60 seconds",
        "Walk (walk): under way, never closes",
        "NOT Alarm (never): in force, never closes",
    ]
    home.clock.advance(2.5)
    assert home.pending()[:2] == [
        "NOT Alarm (later): in force, closes in 2.5 seconds",
        "Call (call): under way, closes in 57.5 seconds",
    ]


def texts(seed: int, start: int) -> Iterator[str]:
    world = World(seed, start)
    for number in range(1, STEPS + 1):
        try:
            world.step(number)
        except errors.ConflictInContext as refusal:
            yield str(refusal)
        yield from map(str, world.sleec.pending())
    world.clock.advance(3600)
    yield from map(str, (*world.refusals, *world.sleec.failures))


def test_messages_do_not_depend_on_where_the_clock_starts() -> None:
    found = [list(texts(seed, 0)) for seed in range(60)]
    assert found == [list(texts(seed, 60 * 1_000_003)) for seed in range(60)]
    together = "\n".join(text for one in found for text in one)
    for words in ("forbids it for", "closes in", "opens in", "was not done within", "is due ("):
        assert words in together
