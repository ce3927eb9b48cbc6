"""Random rulesets of a given size as text, with three hedges for each rule and vocabularies that grow with the size."""

from __future__ import annotations

import random


def random_rules(count: int, hedges: int = 3, seed: int = 0, names_per_rule: float = 1.0) -> str:
    """`count` rules with `hedges` hedges.

    There are ``count * names_per_rule`` triggers, conditions and obligations, at least ten. A tenth of the responses
    are prohibitions.
    """
    draw = random.Random(seed)
    names = max(10, int(count * names_per_rule))

    def condition() -> str:
        shape = draw.random()
        one, other = (f"Condition{draw.randrange(names)}" for _ in range(2))
        if shape < 0.6:
            return one
        if shape < 0.8:
            return f"NOT {one}"
        if shape < 0.95:
            return f"{one} {draw.choice(('AND', 'OR'))} {other}"
        return f"Measure{draw.randrange(names)} {draw.choice(('<', '>='))} {draw.randrange(10)}"

    def response() -> str:
        name = f"Obligation{draw.randrange(names)}"
        return f"NOT {name}" if draw.random() < 0.1 else name

    rules = []
    for number in range(count):
        lines = [f"RULE r{number}", f"WHEN Trigger{draw.randrange(names)} THEN {response()}"]
        lines += [f"UNLESS {condition()} IN WHICH CASE {response()}" for _ in range(hedges)]
        rules.append("\n".join(lines))
    return "\n\n".join(rules) + "\n"


def assuming_rules(count: int) -> str:
    """`random_rules` with two hedges. For every third rule, an assumption makes two conditions exclude each other."""
    draw = random.Random(count)
    names = max(10, count)
    pairs = ((draw.randrange(names), draw.randrange(names)) for _ in range(count // 3))
    assumed = [f"ASSUME NOT Condition{one} OR NOT Condition{other}" for one, other in pairs]
    return "\n".join([random_rules(count, hedges=2), *assumed, ""])
