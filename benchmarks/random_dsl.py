"""Random rulesets of the DSL as text, with hedges, prohibitions and responses that trigger other rules."""

from __future__ import annotations

import random


def random_dsl(count: int, hedges: int = 2, seed: int = 0, windows: tuple[str, ...] = ("",)) -> str:
    """`count` rules with at most `hedges` hedges.

    There are as many events as rules. Half of them are responses, and a tenth of these also trigger rules. A tenth of
    the responses are prohibitions. `windows` are texts that follow a response.
    """
    draw = random.Random(seed)
    half = max(5, count // 2)
    causes, effects = [f"E{n}" for n in range(half)], [f"F{n}" for n in range(half)]
    measures = [f"m{n}" for n in range(half)]

    def condition() -> str:
        one, other = draw.sample(measures, 2)
        return draw.choice(
            (f"{{{one}}}", f"(not {{{one}}})", f"({{{one}}} and {{{other}}})", f"({{{one}}} or {{{other}}})")
        )

    def response() -> str:
        return f"{'not ' if draw.random() < 0.1 else ''}{draw.choice(effects)}{draw.choice(windows)}"

    lines = ["def_start", *(f"  event {e}" for e in causes + effects), *(f"  measure {m}: boolean" for m in measures)]
    lines += ["def_end", "rule_start"]
    for number in range(count):
        trigger = draw.choice(effects if draw.random() < 0.1 else causes)
        lines.append(f"  R{number} when {trigger} then {response()}")
        lines += [f"    unless {condition()} then {response()}" for _ in range(draw.randint(0, hedges))]
    return "\n".join([*lines, "rule_end", ""])
