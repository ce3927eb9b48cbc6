"""A conformance run of 10,000 random scenarios on a virtual clock, as a ratio to the commands of `make demo`.

Hypothesis takes longer to draw a scenario than the robot to play it. So the second figure is that of
`check_conformance` with as many examples, from a tenth of them. Times are those of the processor, because the run and
the commands do not alternate.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from random import Random
from statistics import median

from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.language import parse
from sleec_verify.conformance import Bench, check_conformance
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step
from sleec_verify.conformance.scenarios.trials import Trials

SCENARIOS = 10_000
LIMIT = 60
"""At most this many times the commands of `make demo`."""

RULES = parse("""
CONDITION Alone
RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 1 minute OTHERWISE CallPolice
RULE rest WHEN UserSleeps THEN NOT Vacuum WITHIN 1 hour
RULE dust WHEN DustSeen THEN Vacuum
RULE walk WHEN MorningComes THEN OfferWalk WITHIN 10 TO 60 minutes UNLESS Alone IN WHICH CASE CallNurse WITHIN 2 minutes
RULE ask WHEN Ask THEN Answer WITHIN 10 seconds OTHERWISE (Apologise UNLESS Alone)
""")
SLOW = ("CallNurse", "Answer")
CODE = {name: obligation(name, completes=name not in SLOW)(lambda: None) for name in sorted(RULES.obligations)}
DEMO = (
    ("check", *map(str, sorted(Path("rulesets").glob("*.sleec"))), "--format", "concise"),
    ("explain", "rulesets/household.sleec", "--when", "CurtainOpenRequest", "--given", "UserUndressed"),
)


def make(clock: VirtualClock) -> Sleec:
    """A robot of which every obligation works."""
    sleec = Sleec(RULES, clock=clock)
    sleec.implement(CODE)
    return sleec


def scenario(random: Random) -> Scenario:
    """A random scenario of one to six steps."""
    steps = []
    at = 0
    for _ in range(random.randint(1, 6)):
        when = tuple(random.sample(sorted(RULES.triggers), random.choice((1, 1, 2))))
        steps.append(Step(at, when, {"Alone": random.random() < 0.5}))
        at += random.choice((1, 9, 10, 59, 60, 61, 299, 300, 301, 3599, 3600, 3601))
    completions = tuple(
        Completion(name, step.at, random.choice((None, step.at + 10, step.at + 300)))
        for step in steps
        for name in SLOW
        if random.random() < 0.3
    )
    return Scenario("a random scenario", tuple(steps), at + 3600, completions)


def demo() -> float:
    """The processor time of the commands of `make demo`, in seconds."""
    before = os.times()
    for command in DEMO:
        subprocess.run((sys.executable, "-m", "sleec_verify", *command), capture_output=True, check=False)
    after = os.times()
    return sum(after[2:4]) - sum(before[2:4])


def main() -> None:
    demo()
    one = median(demo() for _ in range(5))
    random = Random(1)
    trials = Trials(Bench(make))
    chosen = [scenario(random) for _ in range(SCENARIOS)]
    started = time.process_time()
    for each in chosen:
        trials.check(each)
    took = time.process_time() - started
    started = time.process_time()
    check_conformance(make, RULES, parts=["scenarios"], examples=SCENARIOS // 10)
    drawn = 10 * (time.process_time() - started)
    print(f"commands of `make demo`, warm  {one:6.2f} s")
    print(f"{SCENARIOS:,} scenarios          {took:6.1f} s  {took / one:5.1f} times (at most {LIMIT})")
    print(f"  drawn by Hypothesis      {drawn:6.1f} s  {drawn / one:5.1f} times")


if __name__ == "__main__":
    main()
