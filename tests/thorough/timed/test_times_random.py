"""Random rules with times at work: as long as the runtime raises and reports nothing, what happened keeps the rules.

What happened is told by `sleec_runtime.evaluation.trace_violations`, which shares no code with what keeps the times.
"""

from __future__ import annotations

import warnings
from random import Random

import pytest

from sleec_runtime import Sleec, VirtualClock, errors, obligation
from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations, violations_so_far
from sleec_runtime.language import parse
from sleec_runtime.model import Value, literals
from tests.support.timed_strategies import BOOLEANS, SCALE, timed_ruleset

STEPS = 8
LONG = 60 * 60
NUMBERS = {"v": (0, 1), "w": (1, 1), "x": (0, 3), "y": (0, 3)}
"""The values of measures. Those of `v` and `w` are in every range that `timed_ruleset` declares."""


def in_minutes(seed: int, **features: bool):
    """Windows in whole minutes. Step i comes 7·i seconds after a full minute, so that nothing that it leads to comes
    with another step, even if it is held back for a second or two: what comes from two sides at one reading of the
    clock comes one after the other, and a trace knows no order within an instant."""
    text = timed_ruleset(seed, relations=0, **features).source.text
    return parse(text.replace(" seconds", " minutes"))


def taking_time(ruleset, random: Random) -> set[str]:
    """Some of the events that are never due at once: for what takes time, that could not be kept."""
    at_once = set()
    events = set()
    for rule in ruleset.rules:
        for clause in rule.clauses():
            for literal in literals(clause):
                events.add(literal.name)
                window = None if literal.timing is None else literal.timing.window
                if window is None or (
                    window.end is not None
                    and window.end.seconds == (0 if window.start is None else window.start.seconds)
                ):
                    at_once.add(literal.name)
    return {event for event in sorted(events - at_once) if random.random() < 0.6}


class World:
    """A run of the rules, and a log of it. `features` are those of `timed_ruleset`."""

    def __init__(self, seed: int, start: int = 0, **features: bool) -> None:
        self.random = Random(seed)
        self.ruleset = in_minutes(seed, **features)
        self.clock = VirtualClock(start)
        self.instants: dict[int, set[str]] = {}
        self.values: dict[int, dict[str, Value]] = {}
        self.refusals: list[errors.ConflictInContext] = []
        self.slow = taking_time(self.ruleset, self.random)
        self.sleec = self.loaded()

    def loaded(self) -> Sleec:
        """The rules at work on the clock of now."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", errors.NotEnforced)
            sleec = Sleec(self.ruleset, clock=self.clock, chains=True, on_error=lambda failure: None)
        sleec.implement({name: self.implementation(name) for name in sorted(self.ruleset.obligations)})
        return sleec

    def implementation(self, name: str):
        if name in self.slow:
            return obligation(name, completes=False)(lambda: None)
        return obligation(name)(lambda: self.note(name))

    def note(self, name: str) -> None:
        now = self.now()
        self.instants.setdefault(now, set()).add(name)
        self.values[now] = dict(self.sleec.conditions)

    def now(self) -> int:
        return int(self.clock.now())

    def trace(self) -> Trace:
        now = self.now()
        times = sorted({*self.instants, now})
        return Trace(
            tuple(
                Instant(t, frozenset(self.instants.get(t, ())), self.values.get(t, dict(self.sleec.conditions)))
                for t in times
            )
        )

    def step(self, number: int) -> None:
        now = self.now()
        self.clock.advance((now // 60 + self.random.randint(1, 2)) * 60 + 7 * number - now)
        values = {name: self.random.random() < 0.5 for name in BOOLEANS}
        self.sleec.update({name: value for name, value in values.items() if name in self.sleec.vocabulary})
        if "risk" in self.sleec.vocabulary:
            self.sleec.update({"risk": self.random.choice(SCALE)})
        self.sleec.update({n: self.random.randint(*NUMBERS[n]) for n in NUMBERS if n in self.sleec.vocabulary})
        waiting = sorted({one.obligation for one in self.sleec.pending() if one.state == "under way"})
        if waiting and self.random.random() < 0.6:
            name = self.random.choice(waiting)
            self.note(name)
            self.sleec.completed(name)
            return
        events = sorted(self.ruleset.triggers)
        chosen = self.random.sample(events, min(len(events), self.random.choice((1, 1, 1, 2))))
        if self.slow.intersection(chosen):
            return
        before = {time: set(names) for time, names in self.instants.items()}
        try:
            self.sleec.trigger_all(chosen)
        except errors.ConflictInContext as refusal:
            # Refused before anything ran: as if it had not happened.
            self.refusals.append(refusal)
            assert self.instants == before
        else:
            for name in chosen:
                self.note(name)


def outcome(seed: int) -> str:
    """What became of one run, which is checked on the way."""
    world = World(seed)
    for number in range(1, STEPS + 1):
        try:
            world.step(number)
        except errors.ConflictInContext:
            return "refused what had happened"
        if world.sleec.failures:
            return "reported"
        assert violations_so_far(world.ruleset, world.trace()) == (), world.ruleset.source.text
    world.clock.advance(LONG)
    if world.sleec.failures:
        return "reported"
    if any(not one.prohibited for one in world.sleec.pending()):
        assert violations_so_far(world.ruleset, world.trace()) == (), world.ruleset.source.text
        return "pending"
    assert violations(world.ruleset, world.trace()) == (), world.ruleset.source.text
    return "kept"


@pytest.mark.parametrize("block", range(6))
def test_what_is_not_refused_or_reported_keeps_the_rules(block):
    outcomes = [outcome(seed) for seed in range(block * 100, block * 100 + 100)]
    assert outcomes.count("kept") > 40
    assert "reported" in outcomes
    assert "pending" in outcomes


@pytest.mark.long
def test_what_is_not_refused_or_reported_keeps_the_rules_in_many_runs():
    outcomes = [outcome(seed) for seed in range(1_000_000, 1_020_000)]
    assert outcomes.count("kept") > 8_000
