"""Seconds before now from which several instants may, by turns, keep off what a rule calls for.

A prohibition of two seconds, one after the other, keeps a door shut for a minute. What was triggered long ago may end
in one: so the seconds that matter may be few, and far from now.
"""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Rule
from sleec_verify.timed.program import Program
from sleec_verify.timed.responses import Occurs, Part


def turns(program: Program, rule: Rule, most: int) -> Iterator[list[int]]:
    """Sets of at most so many seconds before now, the first first, the smaller set first: each second from which a
    prohibition may reach what the rule calls for; and of all prohibitions and demands that may have a part in it, as
    far as there is room, one each time that one ends."""
    each: set[int] = set()
    by_length = {1}
    for what in program.windows(rule):
        if not what.is_deadline or what.end is None:
            continue
        for part in _having_a_part(program, what.event):
            if part.what.event == what.event:
                each |= _ago(part.what, what.end, 1)
            more = by_length | _ago(part.what, what.end, _length(part.what))
            by_length = more if len(more) <= most else by_length
    for ago in sorted((by_length, each), key=len):
        if 1 < len(ago) <= most:
            yield sorted(ago, reverse=True)


def _having_a_part(program: Program, event: str) -> Iterator[Part]:
    """The parts of what rules demand that may keep an event off: that forbid it, and what could be done instead; and
    then that call for what triggers these."""
    seen: set[str] = set()
    forbidden, called = [event], list[str]()
    while forbidden or called:
        negated = bool(forbidden)
        name = (forbidden or called).pop(0)
        if name in seen:
            continue
        seen.add(name)
        for rule in (program.forbidding if negated else program.obliging).get(name, ()):
            for part in program.parts(rule):
                if (part.what.event, part.what.negated) == (name, negated):
                    yield part
                    if part.instead is not None and not part.instead.negated:
                        forbidden.append(part.instead.event)
            called.append(rule.trigger)


def _length(what: Occurs) -> int:
    return max(1, (what.end or 0) - (what.start or 0))


_MOST_STEPS = 1000


def _ago(what: Occurs, end: int, step: int) -> set[int]:
    """Every so many of the seconds before now from which a window reaches into those up to `end` seconds after now;
    none where these are very many."""
    if what.end is None or what.end < 1:
        return set()
    first = max((what.start or 0) - end, 1)
    if (what.end - first) // step > _MOST_STEPS:
        return set()
    return {*range(first, what.end + 1, step), what.end}
