"""Small random rulesets with times in structured English, by a seed: what the DSL cannot say, or says otherwise. Both
readings, responses of several obligations, numbers that are compared, constraints."""

from __future__ import annotations

from random import Random

DEFINITIONS = "EVENT A, B, C\nCONDITION m, n\nMEASURE x: integer\nMEASURE y: integer\nMEASURE s: low < middle < high\n"


def timed_english(seed: int) -> str:
    """The text of a ruleset with three rules at most; no window is over after three seconds."""
    return _Writer(Random(seed)).text()


def untimed_english(seed: int) -> str:
    """The text of a ruleset without time, relations, claims and chains."""
    return _Untimed(Random(seed)).text()


class _Writer:
    def __init__(self, random: Random) -> None:
        self.random = random
        self.events = ("A", "B", "C")[: random.choice((2, 3, 3))]

    def text(self) -> str:
        reading = "READING priority\n" if self.random.random() < 0.4 else ""
        rules = [self.rule(number) for number in range(self.random.randint(1, 3))]
        laws = [self.law() for _ in range(max(0, self.random.randint(-2, 2)))]
        concern = f"CONCERN c1 EXISTS {self.event()}{self.guard()} WHILE {self.obligation(0)}\n"
        return f"{reading}{DEFINITIONS}{''.join(rules)}{''.join(laws)}{concern if self.random.random() < 0.4 else ''}"

    def event(self) -> str:
        return self.random.choice(self.events)

    def condition(self, depth: int = 1) -> str:
        kind = self.random.randrange(9)
        if depth and kind == 0:
            return f"({self.condition(0)} {self.random.choice(('AND', 'OR'))} {self.condition(0)})"
        if depth and kind == 1:
            return f"NOT {self.condition(0)}"
        if kind in (2, 3):
            return f"x {self.random.choice(('<', '<=', '=', '!=', '>=', '>'))} {self.random.randint(0, 3)}"
        if kind == 4:
            return "x < y"
        if kind == 5:
            return f"s {self.random.choice(('<', '<=', '=', '>='))} {self.random.choice(('low', 'middle', 'high'))}"
        return self.random.choice("mn")

    def guard(self) -> str:
        return f" AND {self.condition()}" if self.random.random() < 0.3 else ""

    def window(self) -> str:
        kind = self.random.randrange(8)
        if kind < 3:
            return ""
        if kind == 3:
            return " EVENTUALLY"
        end = self.random.randint(0, 3)
        return f" WITHIN {end} seconds" if kind < 6 else f" WITHIN {self.random.randint(0, end)} TO {end} seconds"

    def obligation(self, depth: int = 1) -> str:
        text = ("NOT " if self.random.random() < 0.3 else "") + self.event() + self.window()
        if depth and self.random.random() < 0.2:
            instead = self.obligation(0) if self.random.random() < 0.6 else f"({self.response(0)})"
            return f"({text} {self.random.choice(('OTHERWISE', 'ELSE'))} {instead})"
        return text

    def response(self, depth: int = 1) -> str:
        return " AND ".join(self.obligation(depth) for _ in range(self.random.choice((1, 1, 1, 2))))

    def rule(self, number: int) -> str:
        text = f"RULE R{number} WHEN {self.event()}{self.guard()} THEN {self.response()}"
        for _ in range(max(0, self.random.randint(-2, 2))):
            text += f" UNLESS {self.condition()}"
            if self.random.random() < 0.8:
                text += f" IN WHICH CASE ({self.response()})"
        return f"{text}\n"

    def law(self) -> str:
        a, b = self.random.sample(self.events, 2)
        p = self.condition(0)
        return self.random.choice(
            (
                f"ASSUME {self.condition()}\n",
                f"EXCLUSIVE {a}, {b}\n",
                f"NEVER {a} AND {p}\n",
                f"RELATION WHEN {a} THEN {p} FOR {self.random.randint(0, 3)} seconds\n",
                f"RELATION {a} PRECEDES {b}\n",
                f"RELATION {a} CAUSES {p}\n",
            )
        )


class _Untimed(_Writer):
    def text(self) -> str:
        reading = "READING priority\n" if self.random.random() < 0.4 else ""
        rules = [self.rule(number) for number in range(self.random.randint(1, 4))]
        laws = [self.law() for _ in range(max(0, self.random.randint(-2, 2)))]
        return f"{reading}{DEFINITIONS}EVENT X, Y, Z\n{''.join(rules)}{''.join(laws)}"

    def act(self) -> str:
        return self.random.choice("XYZ")

    def obligation(self, depth: int = 1) -> str:
        return ("NOT " if self.random.random() < 0.3 else "") + self.act()

    def law(self) -> str:
        return self.random.choice(
            (
                f"ASSUME {self.condition()}\n",
                f"EXCLUSIVE {', '.join(self.random.sample('XYZ', 2))}\n",
                f"NEVER {self.act()} AND {self.condition(0)}\n",
            )
        )
