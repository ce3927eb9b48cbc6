"""The alternatives of a clause in one situation: ways to meet an obligation, of which one suffices."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

from sleec_runtime.model import Clause, Obligation
from sleec_verify.encoding.response_windows import ResponseWindows, WindowedResponse
from sleec_verify.wording.sentence import joined, sentence

Way = tuple[WindowedResponse, ...]
"""Responses that together meet an obligation."""


def has_alternative(obligation: Obligation) -> bool:
    timing = obligation.timing
    return timing is not None and (timing.otherwise is not None or timing.instead is not None)


def ways_of(windows: ResponseWindows, clause: Clause) -> list[tuple[Way, ...]]:
    """For each obligation of a clause that decides, the ways to meet it, in the order of the text. Their number is
    exponential in the alternatives that are conjunctions of alternatives."""
    every = list(windows.of(clause))
    return [tuple(_ways(one, every)) for one in every if one.instead is None]


def _ways(one: WindowedResponse, every: Sequence[WindowedResponse]) -> Iterator[Way]:
    yield (one,)
    timing = one.obligation.timing
    if timing is None:
        return
    for clause, overdue in ((timing.otherwise, True), (timing.instead, False)):
        if clause is not None:
            parts = [other for other in every if other.instead is one and other.overdue == overdue]
            for ways in product(*(list(_ways(part, every)) for part in parts)):
                yield tuple(response for way in ways for response in way)


def way_text(way: Way) -> str:
    """``X within 5 minutes AND NOT Y``; ``nothing`` if nothing is due."""
    return joined(" AND ", [f"{one.obligation} {when_text(one)}".rstrip() for one in way]) or sentence("nothing")


def when_text(one: WindowedResponse) -> str:
    """The window as the text states it, without alternatives; empty if there is none."""
    timing = one.obligation.timing
    return "" if timing is None else str(replace(timing, otherwise=None, instead=None))


def ways_text(ways: Sequence[Way]) -> str:
    """``X within 5 minutes, or else Y``"""
    text = way_text(ways[0])
    for way in ways[1:]:
        text = sentence("{response}, or else {other}", response=text, other=way_text(way))
    return text
