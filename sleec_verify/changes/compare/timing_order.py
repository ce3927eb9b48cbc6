"""The order of literals with windows: which of two requires more.

"X within 5 minutes" requires more than "X within 10 minutes". For prohibitions, the longer window requires more. A
literal counts as due if a stronger literal is due. So a longer window is laxer without a special case. With
alternatives, a literal is a formula over timed occurrences. It is stronger if it implies the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import product
from typing import TYPE_CHECKING

from sleec_runtime.model import Obligation
from sleec_verify.encoding.solver import Undecided
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Rational, Timing, Window
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.traces.demands import Demand, Occurs

MOST_WAYS = 10_000
"""The maximal number of ways to meet one response, times ways to violate another."""


def implies(one: Obligation, other: Obligation, untimed: Untimed = "at") -> bool | None:
    """Whether meeting `one` meets `other`, for two literals without hedges in their alternatives; None if unknown."""
    if one == other:
        return True
    if _has_alternatives(one) or _has_alternatives(other):
        return _follows(one, other, untimed)
    mine, theirs = _span_of_time(one.timing, untimed), _span_of_time(other.timing, untimed)
    if (not one.negated and _is_empty(mine)) or (other.negated and _is_empty(theirs)):
        return True
    if one.name != other.name or one.negated != other.negated:
        return False
    if mine is None or theirs is None:
        return None
    narrow, wide = (theirs, mine) if one.negated else (mine, theirs)
    return wide[0] <= narrow[0] and (wide[1] is None or (narrow[1] is not None and narrow[1] <= wide[1]))


def is_trivial(obligation: Obligation, untimed: Untimed) -> bool:
    """Whether a literal is kept whatever happens, as ``A else NOT A`` is."""
    return _has_alternatives(obligation) and _follows(None, obligation, untimed) is True


def incomparability(one: Obligation, other: Obligation) -> str:
    """Why `implies` has no answer."""
    try:
        _demand(one, "at")
        _demand(other, "at")
    except Undecided:
        return sentence("nothing bounds a measure that gives the length of a window")
    return sentence("there are too many ways to meet it")


def _has_alternatives(obligation: Obligation) -> bool:
    timing = obligation.timing
    return timing is not None and (timing.otherwise is not None or timing.instead is not None)


# What is due in place of a response -----------------------------------------------------------------------


@lru_cache(maxsize=10_000)
def _follows(one: Obligation | None, other: Obligation, untimed: Untimed) -> bool | None:
    """Whether every way to meet `one` (None: of doing anything) leaves no way to violate `other`."""
    try:
        kept = [[]] if one is None else _ways(_demand(one, untimed))
        broken = _ways(_demand(other, untimed, kept=False))
    except Undecided:
        return None
    if len(kept) * len(broken) > MOST_WAYS:
        return None
    return not any(_possible([*keeping, *breaking]) for keeping, breaking in product(kept, broken))


def _demand(obligation: Obligation, untimed: Untimed, kept: bool = True) -> Demand:
    from sleec_verify.traces.demands import Responses

    # What is due in place of a response has no hedges here, so that it decides.
    return Responses(untimed).of((obligation,), lambda clause: [_DECIDES], kept)


_DECIDES = 1


def _ways(demand: Demand) -> list[list[Occurs]]:
    """The ways to meet a demand, each as required and forbidden occurrences."""
    from sleec_verify.traces.demands import Every, Some

    if isinstance(demand, int):
        return [[]] if demand == _DECIDES else []
    if isinstance(demand, Some):
        return [way for part in demand.parts for way in _ways(part)]
    if isinstance(demand, Every):
        found: list[list[Occurs]] = [[]]
        for part in demand.parts:
            found = [[*way, *more] for way, more in product(found, _ways(part))]
            if len(found) > MOST_WAYS:
                raise Undecided(sentence("there are too many ways to meet it"))
        return found
    return [[demand]]


def _possible(way: Sequence[Occurs]) -> bool:
    """Whether each required occurrence has an allowed time. Events are independent."""
    return all(
        _has_room(what, [ban for ban in way if ban.negated and ban.event == what.event])
        for what in way
        if not what.negated
    )


def _has_room(what: Occurs, bans: Sequence[Occurs]) -> bool:
    """Whether some second of a window is outside all others."""
    second = what.start or 0
    for ban in sorted(bans, key=lambda ban: ban.start or 0):
        if (ban.start or 0) <= second:
            if ban.end is None:
                return False
            second = max(second, ban.end + 1)
    return what.end is None or second <= what.end


# Windows --------------------------------------------------------------------------------------------------


def _is_empty(span: tuple[Rational, Rational | None] | None) -> bool:
    return span is not None and span[1] is not None and span[1] < span[0]


def _span_of_time(timing: Timing | None, untimed: Untimed) -> tuple[Rational, Rational | None] | None:
    """The first and last second after the trigger; None if the length is a measure."""
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
