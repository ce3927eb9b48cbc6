"""Which of two literals asks for more, where they say when.

"X within 5 minutes" asks for more than "X within 10 minutes", and a prohibition for less. So a literal is taken for
due wherever one is due that asks for at least as much, and a longer window is laxer without being a case of its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sleec_runtime.model import Obligation

if TYPE_CHECKING:
    from sleec_runtime.model import Rational
    from sleec_runtime.model_time import Timing, Window
    from sleec_verify.timed.scope import Untimed


def implies(one: Obligation, other: Obligation, untimed: Untimed = "at") -> bool | None:
    """Whether whoever keeps `one` keeps `other`, of two literals of one name; None where their form does not tell."""
    if one.name != other.name or one.negated != other.negated:
        return False
    if one.timing is None and other.timing is None:
        return True
    if one.timing == other.timing:
        return True
    if _alternatives(one.timing):
        # What is due in another's place, and when, is compared as a whole or not at all.
        return None if _alternatives(other.timing) else False
    mine, theirs = _span_of_time(one.timing, untimed), _span_of_time(other.timing, untimed)
    if mine is None or theirs is None:
        return None
    narrow, wide = (theirs, mine) if one.negated else (mine, theirs)
    return wide[0] <= narrow[0] and (wide[1] is None or (narrow[1] is not None and narrow[1] <= wide[1]))


def why_not(one: Obligation, other: Obligation) -> str:
    """The construct for which `implies` has no answer."""
    for timing in (one.timing, other.timing):
        if timing is not None and timing.otherwise is not None:
            return "otherwise"
        if timing is not None and timing.instead is not None:
            return "else"
    return "a window whose length is a measure's"


def _alternatives(timing: Timing | None) -> bool:
    return timing is not None and (timing.otherwise is not None or timing.instead is not None)


def _span_of_time(timing: Timing | None, untimed: Untimed) -> tuple[Rational, Rational | None] | None:
    """From when to when, in seconds after the trigger; None where a measure says it."""
    window: Window | None = None if timing is None else timing.window
    if window is None:
        return (0, None) if untimed == "eventually" else (0, 0)
    start = 0 if window.start is None else window.start.seconds
    if start is None:
        return None
    if window.end is None:
        return start, None
    end = window.end.seconds
    return None if end is None else (start, end)
