"""Strategies of the environment in words: a line for each act, indented at each branch."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.report.timeline import duration
from sleec_verify.results.phrases import listed, quoted, value_text

if TYPE_CHECKING:
    from sleec_verify.results.strategy import Act, Branch, Strategy


def in_words(strategy: Strategy) -> Iterator[str]:
    """The acts of the environment, with the responses of the robot between them."""
    yield from _from(strategy, "at first")


def _from(strategy: Strategy, when: str) -> Iterator[str]:
    yield f"{when}, {_happens(strategy.act)}"
    if not strategy.branches:
        yield "after this, it is impossible to follow every rule"
    for branch in strategy.branches:
        then = f"after {duration(branch.then.act.time)}"
        if branch.done is None:
            yield from _from(branch.then, f"whatever the robot does, {then}")
        else:
            yield f"if the robot {_does(branch)}:"
            yield from ("  " + line for line in _from(branch.then, then))
    if strategy.more:
        yield "the environment can answer everything else that the robot can do, too"


def _happens(act: Act) -> str:
    events = f"{listed(map(quoted, act.events))} {'occurs' if len(act.events) == 1 else 'occur'}"
    facts = [f"{quoted(name)} is {value_text(value)}" for name, value in act.conditions.items()]
    return (events if act.events else "nothing occurs") + (f" while {listed(facts)}" if facts else "")


def _does(branch: Branch) -> str:
    now = f"does {listed(map(quoted, branch.done))} immediately" if branch.done else "does nothing immediately"
    later = [f"{listed(map(quoted, plan.events))} after {duration(plan.time)}" for plan in branch.planned]
    return f"{now} and plans {listed(later)}" if later else now
