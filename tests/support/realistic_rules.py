"""Random rulesets in the form that people's have: events of the environment, and acts that follow from them and from
each other, few of them forbidden. Nothing leads back to itself."""

from __future__ import annotations

from random import Random

EVENTS = tuple(f"E{number}" for number in range(4))
ACTS = tuple(f"X{number}" for number in range(6))
SHORT = ("", "", "1", "2", "2", "3", "4", "6", "[1, 2]", "[2, 5]", "eventually")
"""Windows of seconds; with none, at once."""

LONG = ("", "2", "5", "15", "30", "60", "120", "300", "600", "3600", "172800", "[5, 60]", "[60, 300]")
"""From seconds to days."""


def peoples_rules(seed: int, rules: int = 5, windows: tuple[str, ...] = SHORT) -> str:
    """A text of the DSL."""
    random = Random(seed)
    condition = lambda: random.choice(("m0", "m1", "(not m0)", "(m0 and m1)", "(s > lo)", "(s = hi)", "(n < 20)"))  # noqa: E731

    forbidden = [each for each in windows if each.isdigit()]

    def window() -> str:
        chosen = random.choice(windows)
        return f" {chosen}" if chosen == "eventually" else f" within {chosen} seconds" if chosen else ""

    def response(first: int, may_fail: bool = True) -> str:
        if random.randrange(4) == 0:
            return f"not {random.choice(ACTS)} within {random.choice(forbidden)} seconds"
        text = random.choice(ACTS[first:]) + window()
        if may_fail and "within" in text and random.randrange(4) == 0:
            text += f" otherwise {response(first, may_fail=False)}"
        return text

    def rule(label: str) -> str:
        number = random.randrange(len(ACTS) - 1)
        follows = random.randrange(5) < 2
        first = number + 1 if follows else 0
        text = f"{label} when {ACTS[number] if follows else random.choice(EVENTS)}"
        text += f" and {condition()}" if random.randrange(4) == 0 else ""
        text += f" then {response(first)}"
        if random.randrange(3) == 0:
            text += f" unless {condition()}" + (f" then {response(first)}" if random.randrange(3) else "")
        return text

    def relation() -> str:
        one, other = random.sample(ACTS, 2)
        event = random.choice(EVENTS)
        return random.choice(
            (
                f"mutualExclusive {one} {other}",
                f"mutualExclusive {one} {other}",
                f"witness {event} {random.choice(EVENTS)}",
                f"happenBefore {event} {one}",
                f"forbid {one} {condition()}",
                f"measure imply {condition()} {condition()}",
            )
        )

    lines = ["def_start", *(f"event {event}" for event in (*EVENTS, *ACTS))]
    lines += ["measure m0: boolean", "measure m1: boolean", "measure s: scale(lo, mid, hi)", "measure n: numeric"]
    lines += ["def_end", "rule_start", *(rule(f"R{number}") for number in range(rules)), "rule_end"]
    if random.randrange(2):
        lines += ["relation_start", *(relation() for _ in range(random.randint(1, 3))), "relation_end"]
    return "\n".join(lines) + "\n"
