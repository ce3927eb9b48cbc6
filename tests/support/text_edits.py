"""Texts of rules that are edited step by step at random, as an author does: a statement in each line."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

DEFINITIONS = ("MEASURE x: number", "MEASURE s: low < middle < high", "")
TRIGGERS = tuple(f"T{number}" for number in range(5))
ACTS = tuple(f"X{number}" for number in range(6))
CONDITIONS = tuple(f"c{number}" for number in range(4))


def edited_texts(seed: int, edits: int, timed: bool) -> Iterator[str]:
    """A text, and the text after each edit. The language features depend on the seed; windows, relations, claims and
    responses that trigger rules occur only with `timed`."""
    yield from _Author(Random(seed), timed).texts(edits)


class _Author:
    def __init__(self, random: Random, timed: bool) -> None:
        self.random = random
        self.timed = timed and self.maybe(0.6)
        self.chained = timed and self.maybe(0.6)
        self.domains = self.maybe(0.25)
        self.names_triggers = self.maybe(0.2)
        self.labelled = not self.maybe(0.15)
        self.number = 0

    def maybe(self, probability: float) -> bool:
        return self.random.random() < probability

    def texts(self, edits: int) -> Iterator[str]:
        laws = [self.law() for _ in range(self.random.choice((0, 1, 2, 4)))]
        reading = ["READING priority"] if self.maybe(0.3) else []
        rules = [self.statement() for _ in range(self.random.randint(3, 9))]
        first, last = (laws, []) if self.maybe(0.6) else ([], laws)
        for _ in range(edits + 1):
            yield "\n".join([*reading, *DEFINITIONS, *first, *rules, *last, ""])
            self.edit(rules, first + last)

    def edit(self, rules: list[str], laws: list[str]) -> None:
        at = self.random.randrange(len(rules))
        kind = self.random.randrange(12)
        if kind < 4:
            rules[at] = self.statement(rules[at].split()[1] if rules[at].startswith("RULE") else None)
        elif kind < 6:
            rules.insert(at, self.statement())
        elif kind == 6 and len(rules) > 1:
            del rules[at]
        elif kind == 7:
            rules[at] = "// a comment\n" + rules[at]
        elif kind == 8:
            rules.insert(at, "")
        elif kind == 9:
            rules[at] = rules[at].replace(" THEN", "  THEN")
        elif kind == 10:
            other = self.random.randrange(len(rules))
            rules[at], rules[other] = rules[other], rules[at]
        elif kind == 11 and laws and self.maybe(0.3):
            laws[0] = self.law()

    def condition(self, depth: int = 1) -> str:
        kind = self.random.randrange(9)
        if depth and kind < 2:
            return f"({self.condition(0)} {self.random.choice(('AND', 'OR'))} {self.condition(0)})"
        if depth and kind == 2:
            return f"NOT {self.condition(0)}"
        if kind == 3:
            return f"x {self.random.choice(('<', '>=', '='))} {self.random.randint(0, 2)}"
        if kind == 4:
            return f"s {self.random.choice(('<', '>='))} {self.random.choice(('middle', 'high'))}"
        if kind == 5 and self.names_triggers:
            return self.random.choice(TRIGGERS)
        return self.random.choice(CONDITIONS)

    def obligation(self) -> str:
        act = self.random.choice(ACTS)
        if self.maybe(0.25):
            return f"NOT {act}" + (" WITHIN 2 seconds" if self.timed and self.maybe(0.3) else "")
        return act + (f" WITHIN {self.random.randint(1, 3)} seconds" if self.timed and self.maybe(0.4) else "")

    def statement(self, label: str | None = None) -> str:
        if self.maybe(0.05):
            return f"ALWAYS {self.random.choice(ACTS)} UNLESS {self.condition()}"
        if label is None:
            self.number += 1
            label = f"r{self.number}"
        trigger = self.random.choice(ACTS if self.chained and self.maybe(0.2) else TRIGGERS)
        text = f"RULE {label} " if self.labelled else ""
        if self.domains and self.maybe(0.5):
            text = f"DOMAIN {self.random.choice(('home', 'ward'))}\n{text}"
        text += f"WHEN {trigger}{f' AND {self.condition()}' if self.maybe(0.3) else ''} THEN {self.obligation()}"
        for _ in range(self.random.choice((0, 0, 1, 2))):
            text += f" UNLESS {self.condition()}"
            text += f" IN WHICH CASE {self.obligation()}" if self.maybe(0.8) else ""
        return text

    def law(self) -> str:
        one, other = self.random.sample(ACTS, 2)
        laws = [
            f"ASSUME {self.condition()} OR {self.condition()}",
            f"ASSUME NOT ({self.random.choice(CONDITIONS)} AND {self.random.choice(CONDITIONS)})",
            f"EXCLUSIVE {one}, {other}",
            f"NEVER {one} AND {self.condition()}",
        ]
        if self.timed:
            laws += [
                f"RELATION {one} PRECEDES {other}",
                f"CONCERN k{self.random.randrange(99)} EXISTS {one} WHILE {other}",
            ]
        return self.random.choice(laws)
