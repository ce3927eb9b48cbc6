"""Random pairs of rules with time for the same trigger, and the relation of their traces by brute force."""

from __future__ import annotations

from functools import cache
from itertools import combinations, product
from random import Random

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.language import parse
from sleec_verify.changes.compare import Relation

TIMES = (0, 1, 2, 3, 4, 9)
"""The instants of the traces. No window of a pair ends between 4 and 9 seconds."""


def _traces() -> list[Trace]:
    """All traces with the trigger at 0, in which X, Y and the condition vary."""
    happening = [frozenset(events) for size in range(3) for events in combinations("XY", size)]
    return [
        Trace(
            tuple(
                Instant(time, events | ({"t"} if time == 0 else set()), {"c": c and time == 0})
                for time, events in zip(TIMES, course)
            )
        )
        for c in (False, True)
        for course in product(happening, repeat=len(TIMES))
    ]


_TRACES = _traces()


@cache
def kept(text: str) -> frozenset[int]:
    """The traces that satisfy a text."""
    ruleset = parse(text)
    return frozenset(number for number, trace in enumerate(_TRACES) if not violations(ruleset, trace))


def relation_of_traces(old: str, new: str) -> Relation:
    """The relation of the new rules to the old ones: stricter if fewer traces satisfy them."""
    before, after = kept(old), kept(new)
    if before == after:
        return "equivalent"
    if after < before:
        return "stricter"
    return "laxer" if before < after else "incomparable"


def random_rule(random: Random, conjunctions: bool) -> str:
    """A rule for `t` about X, Y and the condition c."""
    hedge = random.choice(("", "", "\nUNLESS c", "\nUNLESS c IN WHICH CASE ({})", "\nUNLESS NOT c IN WHICH CASE ({})"))
    first, second = (_response(random, 1, conjunctions) for _ in range(2))
    return f"RULE r\nWHEN t THEN ({first}){hedge.format(second)}\n"


def edit_of(random: Random, text: str, conjunctions: bool) -> str:
    """Another rule, or the same with one word changed."""
    words = [
        ("WITHIN 1", "WITHIN 2"),
        ("WITHIN 2", "WITHIN 1"),
        (" WITHIN 2 seconds", " EVENTUALLY"),
        (" EVENTUALLY", " WITHIN 2 seconds"),
        (" WITHIN 2 seconds", ""),
        ("OTHERWISE", "ELSE"),
        ("ELSE", "OTHERWISE"),
        ("NOT X", "X"),
        ("X", "Y"),
        ("UNLESS c", "UNLESS NOT c"),
    ]
    old, new = random.choice(words)
    new = text.replace(old, new, 1)
    return random_rule(random, conjunctions) if new == text or random.random() < 0.3 else new


def _response(random: Random, depth: int, conjunctions: bool) -> str:
    parts = [_literal(random, depth, conjunctions) for _ in range(random.choice((1, 1, 2)) if conjunctions else 1)]
    return " AND ".join(parts)


def _literal(random: Random, depth: int, conjunctions: bool) -> str:
    window = random.choice(("", " WITHIN 1 seconds", " WITHIN 2 seconds", " WITHIN 1 TO 2 seconds", " EVENTUALLY"))
    text = random.choice(("", "", "NOT ")) + random.choice("XXY") + window
    if depth and random.random() < 0.45:
        inner = _response(random, 0, True)
        if random.random() < 0.3:
            inner += f" UNLESS c{random.choice(('', f' IN WHICH CASE {_literal(random, 0, True)}'))}"
        return f"({text} {random.choice(('OTHERWISE', 'ELSE'))} ({inner}))"
    return text
