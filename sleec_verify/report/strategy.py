"""Strategies of the environment in words: a line for each act, indented at each branch."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.wording.phrases import happening, listed, quoted
from sleec_verify.wording.sentence import joined, sentence
from sleec_verify.wording.times import duration

if TYPE_CHECKING:
    from sleec_verify.results.strategy import Act, Branch, Strategy


def in_words(strategy: Strategy) -> Iterator[str]:
    """The acts of the environment, with the responses of the robot between them."""
    yield from _from(strategy, sentence("at first, "))


def _from(strategy: Strategy, when: str) -> Iterator[str]:
    yield joined("", [when, _happens(strategy.act)])
    if not strategy.branches:
        yield sentence("after this, it is impossible to follow every rule")
    for branch in strategy.branches:
        then = sentence("after {time}, ", time=duration(branch.then.act.time))
        if branch.done is None:
            yield from _from(branch.then, sentence("whatever the robot does, {then}", then=then))
        else:
            yield sentence("if the robot {response}:", response=_does(branch))
            yield from (joined("  ", ["", line]) for line in _from(branch.then, then))
    if strategy.more:
        yield sentence("the environment can answer everything else that the robot can do, too")


def _happens(act: Act) -> str:
    return happening(act.events, act.conditions)


def _does(branch: Branch) -> str:
    done = branch.done
    now = (
        sentence("does {events} immediately", events=listed(map(quoted, done)))
        if done
        else sentence("does nothing immediately")
    )
    later = [
        sentence("{events} after {time}", events=listed(map(quoted, plan.events)), time=duration(plan.time))
        for plan in branch.planned
    ]
    return sentence("{now} and plans {later}", now=now, later=listed(later)) if later else now
