"""Small rulesets to play about: two events of the environment, one of the robot, one condition, windows of seconds."""

from __future__ import annotations

from random import Random
from typing import NamedTuple

HEAD = "def_start\n  event A\n  event B\n  event X as system\n  measure m: boolean\ndef_end\n"

WINDOWS = ("", "", " within 1 seconds", " within 2 seconds", " within [1,2] seconds", " within [1,1] seconds")

LENGTHS = (" within {w} seconds", " within [{w},2] seconds", " within ({w} - 1) seconds")

RANGE = "measure invariant (({w} >= 1) and ({w} <= 2))"

ENVIRONMENTS = ("mutualExclusive A B", "happenBefore A B", "happenBefore X A", "witness A B")
ROBOTS = ("happenBefore A X", "witness A X", "mutualExclusive A X", "equal A X")
ENVIRONMENTS_OF_M = (
    "when A then {m} for 2 seconds",
    "when X then {m} for 2 seconds",
    "when A then {m} until B",
    "includes A {m}",
    "causation B {m}",
    "measure invariant {m}",
)
ROBOTS_OF_M = ("forbid X {m}", "causation X {m}")


class Drawn(NamedTuple):
    """A ruleset, which of its relations the environment keeps, and how many seconds what is due may reach."""

    text: str
    lawful: set[str]
    measures: list[str]
    reach: int


def drawn(seed: int, named: bool = False, lengths: bool = False) -> Drawn:
    """The same ruleset for the same seed. With `named`, conditions name events instead of `m`. With `lengths`, the
    measure `w` gives lengths of windows, and there are no conditions."""
    random = Random(seed)
    with_m = random.random() < 0.4 and not (named or lengths)
    windows = LENGTHS + WINDOWS if lengths else WINDOWS

    def response(inner: bool = False) -> str:
        negated, window = random.random() < 0.45, random.choice(windows)
        text = f"{'not ' if negated else ''}X{window}"
        if window and not (inner or negated) and random.random() < 0.2:
            text += f" otherwise {response(inner=True)}"
        return text

    rules = []
    for number in range(random.randint(1, 3)):
        if named:
            guard = random.choice(("", " and B", " and (not A)", " and (not X)"))
            hedge = f" unless {random.choice('ABX')} then {response(inner=True)}" if random.random() < 0.6 else ""
            rules.append(f"  R{number} when {random.choice('AABBX')}{guard} then {response()}{hedge}\n")
            continue
        guard = random.choice(("", " and {m}", " and (not {m})")) if with_m else ""
        if lengths:
            guard = random.choice(("", "", " and ({w} = 1)", " and ({w} > 1)"))
        hedge = f" unless ({{m}}) then {response(inner=True)}" if with_m and random.random() < 0.4 else ""
        rules.append(f"  R{number} when {random.choice('AABBX')}{guard} then {response()}{hedge}\n")
    relations: list[str] = []
    if random.random() < 0.4:
        choices = [*ENVIRONMENTS, *ROBOTS, *(ENVIRONMENTS_OF_M + ROBOTS_OF_M if with_m else ())]
        relations = random.sample(choices, random.randint(1, 2))
    if lengths:
        relations.append(RANGE)
    head = HEAD.replace("measure m: boolean", "measure w: numeric") if lengths else HEAD
    text = head + f"rule_start\n{''.join(rules)}rule_end\n"
    if relations:
        text += "relation_start\n" + "".join(f"  {relation}\n" for relation in relations) + "relation_end\n"
    lawful = {*ENVIRONMENTS, *ENVIRONMENTS_OF_M, RANGE}.intersection(relations)
    measures = ["w"] if lengths else ["m"] if with_m else []
    return Drawn(text, lawful, measures, 4 if "otherwise" in text else 2)
