"""Short traces, written in one line."""

from __future__ import annotations

from typing import Any

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.language import parse

DEFINITIONS = """def_start
  event A
  event B
  event C
  measure m: boolean
  measure n: boolean
  measure x: numeric
  measure risk: scale(low, middle, high)
def_end
"""


ALL_LOW: dict[str, Any] = {"m": False, "n": False, "x": 0, "risk": "low"}


# A rule that nothing breaks: a text needs one.
KEPT = "R0 when C then C"


def ruleset(rules=KEPT, relations="", concerns=""):
    blocks = [("rule", rules), ("relation", relations), ("concern", concerns)]
    return parse(DEFINITIONS + "".join(f"{name}_start\n{text}\n{name}_end\n" for name, text in blocks if text))


def trace(timeline):
    """`0: A m | 2: B x=3 | 4:`: capital letters are events, other words are true, all else is false and low."""
    instants = []
    for part in timeline.split("|"):
        time, words = part.split(":")
        events = {word for word in words.split() if word.isupper()}
        conditions = dict(ALL_LOW)
        for word in set(words.split()) - events:
            name, _, value = word.partition("=")
            conditions[name] = (int(value) if value.lstrip("-").isdigit() else value) or True
        instants.append(Instant(int(time), frozenset(events), conditions))
    return Trace(tuple(instants))


def times(found):
    return [time for _, time in found]
