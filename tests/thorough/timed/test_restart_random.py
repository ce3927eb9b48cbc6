"""Restarts with random rulesets."""

from __future__ import annotations

import json

import pytest

from sleec_runtime import VirtualClock, errors
from tests.thorough.timed.test_times_random import STEPS, World

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


class Restarting(World):
    """A world in which another process takes over before some steps, on a clock that starts somewhere else."""

    def __init__(self, seed: int, before: tuple[int, ...]) -> None:
        super().__init__(seed)
        self.before = before
        self.offset = 0
        self.reported: list[str] = []
        self.seed = seed

    def now(self) -> int:
        return super().now() + self.offset

    def restart(self) -> None:
        old = self.sleec
        data = json.loads(json.dumps(old.pending_snapshot(self.now())))
        self.reported += map(str, old.failures)
        now = self.now()
        self.clock = VirtualClock(60 * 1_000)
        self.offset = now - 60 * 1_000
        self.sleec = self.loaded()
        self.sleec.update(dict(old.conditions))
        self.sleec.restore(data, now)

    def step(self, number: int) -> None:
        if number in self.before:
            self.restart()
        super().step(number)


def history(world: World) -> list[object]:
    """All that can be seen of a run."""
    seen: list[object] = []
    for number in range(1, STEPS + 1):
        try:
            world.step(number)
        except errors.ConflictInContext as refusal:
            seen.append(str(refusal))
        seen.append([str(one) for one in world.sleec.pending()])
    world.clock.advance(60 * 60)
    failures = [*getattr(world, "reported", ()), *map(str, world.sleec.failures)]
    return [*seen, world.instants, list(map(str, world.refusals)), failures]


@pytest.mark.slow
@pytest.mark.parametrize("block", range(4))
def test_a_run_with_restarts_is_the_run_without(block: int) -> None:
    pending = 0
    for seed in range(block * 50, block * 50 + 50):
        world = Restarting(seed, before=((), (3,), (5,), (2, 4, 6), tuple(range(1, STEPS + 1)))[seed % 5])
        plain = history(World(seed))
        assert history(world) == plain, world.ruleset.source.text
        pending += sum(len(step) for step in plain[:STEPS] if isinstance(step, list))
    assert pending > 100
