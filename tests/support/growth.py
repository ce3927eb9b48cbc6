"""How much more work a text of more rules is.

Times alone say little where other programs take the same processor: a ratio of times varies by a half and more. The
calls that Python makes are counted exactly, but not what one call does (a search of a long list is a single call). So
both are asked: the calls strictly, the times roughly.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from types import FrameType


def calls(work: Callable[[], object]) -> int:
    """How many calls, of functions in Python and of those in C, `work` makes."""
    count = 0

    def called(frame: FrameType, event: str, argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(called)
    try:
        work()
    finally:
        sys.setprofile(before)
    return count


def seconds(work: Callable[[], object]) -> float:
    """The time of the processor that `work` takes."""
    start = time.process_time()
    work()
    return time.process_time() - start


def grows_in_proportion(small: Callable[[], object], large: Callable[[], object], times: int) -> bool:
    """Whether `large`, which is to do `times` as much as `small`, makes that many calls and takes about that long.

    Work that grows with the square would take `times` as long again; a third of that is refused. The best of up to
    five is taken, by turns, so that a busy moment does not meet one of the two alone.
    """
    if calls(large) > 1.1 * times * calls(small):
        return False
    fastest_small = fastest_large = float("inf")
    for _ in range(5):
        fastest_small = min(fastest_small, seconds(small))
        fastest_large = min(fastest_large, seconds(large))
        if fastest_large < times * times / 3 * fastest_small:
            return True
    return False
