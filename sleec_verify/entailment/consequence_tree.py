"""The consequences of doing what is due, as a tree: an obligation that is done triggers the rules of that name.

Measures and conditions keep their values. An immediate obligation occurs together with the triggers of the situation.
If a name is both a trigger and an obligation (docs/semantics.md), the tree follows the rules step by step.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import takewhile
from typing import NamedTuple

from sleec_runtime.model import Context, Ruleset
from sleec_verify.encoding.response_windows import ResponseWindows
from sleec_verify.encoding.trace_scope import Untimed, speaks_of_traces
from sleec_verify.entailment.active_clauses import active_clauses
from sleec_verify.entailment.alternatives import has_alternative
from sleec_verify.entailment.answer import ActiveClause, ConsequenceStep, Entailment

DEEPEST = 100
"""The greatest depth of the tree."""


class Chain(NamedTuple):
    """The steps with consequences and the forbidden steps; and in `at_odds` the events of the situation that are
    forbidden in it, each with the clauses that forbid it."""

    steps: tuple[ConsequenceStep, ...] = ()
    at_odds: tuple[tuple[str, tuple[str, ...]], ...] = ()


def chain(ruleset: Ruleset, context: Context, answer: Entailment, untimed: Untimed = "at") -> Chain:
    """The consequences of the obligations of `answer`.

    Each event is expanded once, so the tree is linear in the number of clauses that it reaches.
    """
    if answer.consistent is False:
        return Chain()
    tree = _Tree(ruleset, context, untimed)
    done = tree.grow(answer.because)
    steps = tuple(tree.step(node) for node in done)
    # Without time, an event that occurred and an obligation of the same name are two things.
    happening = sorted(context.triggers) if speaks_of_traces(ruleset) else ()
    at_odds = ((event, tree.forbidding(_Done(event, (), ((0, 0),)))) for event in happening)
    return Chain(
        tuple(step for step in steps if step.leads_on or step.forbidden),
        tuple((event, forbidding) for event, forbidding in at_odds if forbidding),
    )


class _Link(NamedTuple):
    """An event on the way to another one, `start` to `end` seconds after the event before it. Without `end`: at any
    time from `start` on."""

    name: str
    start: int
    end: int | None


_Way = tuple[_Link, ...]


class _Done(NamedTuple):
    """An event at the end of a way, in one of `windows`. No windows: the time is not known."""

    name: str
    way: _Way
    windows: tuple[tuple[int, int | None], ...]

    @property
    def is_at_once(self) -> bool:
        """Whether the event occurs at the instant of the situation."""
        ends = [*self.windows, *((link.start, link.end) for link in self.way)]
        return bool(self.windows) and all(end == (0, 0) for end in ends)


class _Forbids(NamedTuple):
    """A clause that forbids an event, in a window after a way."""

    by: str
    way: _Way
    start: int
    end: int | None


@dataclass
class _Node:
    done: _Done
    clauses: list[tuple[ActiveClause, list[_Node]]] = field(default_factory=list)
    cycle: bool = False
    seen: bool = False
    more: bool = False


class _Tree:
    def __init__(self, ruleset: Ruleset, context: Context, untimed: Untimed) -> None:
        self._ruleset = ruleset
        self._context = context
        self._windows = ResponseWindows(ruleset, context, untimed)
        self._triggers = {rule.trigger for rule in ruleset.rules}
        self._shown: dict[tuple[str, bool], bool] = {}
        self._prohibitions: dict[str, list[_Forbids]] = {}

    def grow(self, because: tuple[ActiveClause, ...]) -> list[_Node]:
        """The tree below the clauses that decide in the situation."""
        return self._below(because, ())

    def _below(self, because: tuple[ActiveClause, ...], way: _Way) -> list[_Node]:
        done: dict[str, list[tuple[int, int | None] | None]] = {}
        for one in because:
            clause = list(self._ruleset.by_label[one.rule].clauses())[one.clause]
            for response in self._windows.of(clause):
                if response.instead is not None:
                    continue
                # The robot can choose another response, so it is not certain that this one occurs at its time.
                is_choice = has_alternative(response.obligation)
                window = None if response.start is None or is_choice else (response.start, response.end)
                if not response.obligation.negated:
                    done.setdefault(response.obligation.name, []).append(window)
                elif window is not None:
                    forbids = _Forbids(one.layer or one.rule, way, *window)
                    self._prohibitions.setdefault(response.obligation.name, []).append(forbids)
        return [
            self._node(_Done(name, way, tuple(window for window in windows if window is not None)))
            for name, windows in done.items()
        ]

    def _node(self, done: _Done) -> _Node:
        name = done.name
        if name in self._context.triggers or any(link.name == name for link in done.way):
            return _Node(done, cycle=name in self._triggers)
        if name not in self._triggers:
            return _Node(done)
        shown = name, done.is_at_once
        if shown in self._shown:
            return _Node(done, seen=self._shown[shown])
        if len(done.way) == DEEPEST:
            return _Node(done, more=True)
        others = self._context.triggers if done.is_at_once else ()
        answer = active_clauses(self._ruleset, Context(frozenset({name, *others}), self._context.conditions))
        because = [one for one in answer.because if self._ruleset.by_label[one.rule].trigger == name]
        self._shown[shown] = bool(because)
        ends = [end for _, end in done.windows]
        latest = None if None in ends else max((end for end in ends if end is not None), default=None)
        way = (*done.way, _Link(name, min((start for start, _ in done.windows), default=0), latest))
        return _Node(done, [(one, self._below((one,), way)) for one in because])

    def step(self, node: _Node) -> ConsequenceStep:
        """The step of a node, with the clauses anywhere in the tree that forbid it."""
        clauses = tuple((because, tuple(map(self.step, done))) for because, done in node.clauses)
        forbidden = self.forbidding(node.done)
        return ConsequenceStep(node.done.name, clauses, node.cycle, node.seen, node.more, forbidden)

    def forbidding(self, done: _Done) -> tuple[str, ...]:
        """The clauses that forbid an event at every time at which it can be done. If its window is longer than the
        prohibition, it can be done later."""
        found = (
            one for one in self._prohibitions.get(done.name, ()) for window in done.windows if _in(done, window, one)
        )
        return tuple(dict.fromkeys(one.by for one in found))


def _in(done: _Done, window: tuple[int, int | None], forbids: _Forbids) -> bool:
    """Whether all times of a window are forbidden, whenever the events on both ways occur."""
    shared = len(list(takewhile(lambda links: links[0] == links[1], zip(done.way, forbids.way))))
    here, there = done.way[shared:], forbids.way[shared:]
    if not here and there and there[0].name == done.name:
        # It is itself on the way to what forbids it.
        window, there = (0, 0), there[1:]
    first, last = _after(here, window)
    _, latest_start = _after(there, (forbids.start, forbids.start))
    earliest_end = None if forbids.end is None else _after(there, (forbids.end, None))[0]
    if latest_start is None or latest_start > first:
        return False
    return earliest_end is None or (last is not None and last <= earliest_end)


def _after(way: _Way, window: tuple[int, int | None]) -> tuple[int, int | None]:
    start, end = window
    for link in way:
        start += link.start
        end = None if end is None or link.end is None else end + link.end
    return start, end
