"""Realizability: can the robot always keep its rules, whatever the environment does?

Rules that share no event and no relation are separate games. Each game is tried with plans of increasing length. A
robot that wins with short plans wins. Longer plans than the rules can require do not help.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import islice

from sleec_runtime.model import EventRelation, Lasting, Obligation, Rule, Span, in_text_order
from sleec_verify.encoding.relations import Relation
from sleec_verify.encoding.solver import Undecided
from sleec_verify.games.decomposition import GamePart, parts
from sleec_verify.games.play import Play
from sleec_verify.games.qbf import Move, winning_move
from sleec_verify.results.strategy import Act, Branch, Strategy
from sleec_verify.traces.demands import Occurs
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.induction import impossible_events
from sleec_verify.wording.sentence import plural

MOST_PLANNED = 4
"""The maximal number of instants of a plan."""

MOST_REPLIES = 6
"""The maximal number of the robot's immediate answers that a strategy shows."""


@dataclass(frozen=True)
class Loss:
    """A game that the environment wins: a minimal set of rules, the number of acts, and the strategy. `place` is the
    place of the first rule. If there are no rules, it is the place of a relation."""

    rules: tuple[Rule, ...]
    place: Span
    steps: int
    strategy: Strategy


def lost_games(index: TraceIndex, steps: int) -> Iterator[tuple[Sequence[Rule], Callable[[], Loss | None]]]:
    """The parts of the rules, each with the question whether the environment wins against it within `steps` acts.

    A question raises `Undecided` beyond its limits. The first step raises it if the length of a window is a measure.
    """
    for part in parts(index):
        yield part.rules, partial(_loss, _Contest(index, part), steps)


class _Contest:
    """A part of the rules, with its games."""

    def __init__(self, index: TraceIndex, part: GamePart) -> None:
        self.index = index
        self.part = part

    def play(self, steps: int, spare: int, eager: bool = True, pressed: Sequence[str] = ()) -> Play:
        never = self._never if self.has_memory else frozenset()
        return Play(self.index, self.part, steps, spare, never, eager, pressed)

    def only(self, rules: Sequence[Rule]) -> _Contest:
        """The same with fewer rules."""
        windows = {rule.label: self.part.windows[rule.label] for rule in rules}
        return _Contest(self.index, replace(self.part, rules=tuple(rules), windows=windows))

    @cached_property
    def has_memory(self) -> bool:
        """Whether earlier instants matter."""
        return any(map(_is_delayed, self._windows())) or any(map(_remembers, self.part.laws))

    @cached_property
    def standing(self) -> list[str]:
        """The events that earlier prohibitions may forbid."""
        return sorted({window.event for window in self._windows() if window.negated and _is_delayed(window)})

    def spare(self, steps: int) -> int | None:
        """The maximal number of instants that a plan can need: one for each response that can become due later, and one
        for each relation that requires an earlier event. None if later responses lead back to themselves."""
        whole = self._whole(self._never)
        return None if whole is None else steps * whole + sum(map(_looks_back, self.part.laws))

    @cached_property
    def _never(self) -> frozenset[str]:
        """Events that the robot never does, because their consequences never end."""
        if self._whole(frozenset()) is not None:
            return frozenset()
        counting = [*self.part.windows, *self.index.relation_by_key]
        return impossible_events(self.index, counting, self.part.events)

    def _whole(self, never: frozenset[str]) -> int | None:
        return _Costs(self.index, self.part, never).of_rules(self.part.rules)

    def _windows(self) -> Iterator[Occurs]:
        for rule in self.part.rules:
            yield from self.part.windows[rule.label]


class _Costs:
    """The number of instants that rules can require, if some events never occur."""

    def __init__(self, index: TraceIndex, part: GamePart, never: frozenset[str]) -> None:
        self._index = index
        self._part = part
        self._never = never
        self._known: dict[str, int | None] = {}

    def of_rules(self, rules: Iterable[Rule]) -> int | None:
        """The number if each of these rules is triggered once. None if later responses lead back to themselves."""
        whole = 0
        for rule in rules:
            windows = self._part.windows[rule.label]
            for window in _windows_of_one_value(self._index, rule):
                if window in windows and window.event not in self._never and _is_delayed(window):
                    cost = self._of(window.event)
                    if cost is None:
                        return None
                    whole += 1 + cost
        return whole

    def _of(self, event: str) -> int | None:
        """The number for one occurrence of an event, with everything that may have to occur at the same instant."""
        if event not in self._known:
            # Until it is known: a recursive call means a cycle.
            self._known[event] = None
            rules: dict[str, Rule] = {}
            ahead = [event]
            while ahead:
                for rule in self._index.by_trigger.get(ahead.pop(), ()):
                    if rule.label in self._part.windows and rule.label not in rules:
                        rules[rule.label] = rule
                        ahead += (w.event for w in self._part.windows[rule.label] if not w.negated)
            self._known[event] = self.of_rules(rules.values())
        return self._known[event]


def _is_delayed(window: Occurs) -> bool:
    return not window.start == window.end == 0


def _windows_of_one_value(index: TraceIndex, rule: Rule) -> Iterator[Occurs]:
    """The windows of the obligations of a rule, for values of its measures with which most are delayed."""
    for clause in rule.clauses():
        for obligation in clause.obligations:
            yield from _most_windows(index, obligation)


def _most_windows(index: TraceIndex, obligation: Obligation) -> list[Occurs]:
    cases = index.lengths.cases(obligation)
    if cases is None:
        return [window for window in index.atoms((obligation,)) if not window.negated]
    found = [_most_windows(index, one) for member in in_text_order(cases) for one in member.obligations]
    return max(found, key=lambda windows: sum(map(_is_delayed, windows)))


def _looks_back(law: Relation) -> bool:
    return isinstance(law, EventRelation) and law.relation == "happenBefore"


def _remembers(law: Relation) -> bool:
    return isinstance(law, Lasting) or _looks_back(law)


def _loss(contest: _Contest, steps: int) -> Loss | None:
    if _always_won(contest):
        return None
    for count in range(1, (steps if contest.has_memory else 1) + 1):
        lost = _lost(contest, count)
        if lost is not None:
            few, spare = lost
            place = [*few.part.rules, *few.part.laws][0].span
            return Loss(few.part.rules, place, count, StrategySearch(few, count, spare).strategy())
    return None


def _always_won(contest: _Contest) -> bool:
    """Whether the robot can meet at once everything that an act requires, even under all earlier prohibitions. Then
    nothing stays pending, and the robot wins for every number of acts."""
    if not contest.has_memory or any(map(_remembers, contest.part.laws)):
        return False
    return not _wins(contest.play(1, 0, pressed=contest.standing))


def _lost(contest: _Contest, steps: int) -> tuple[_Contest, int] | None:
    """A minimal set of rules with which the environment wins, and the length of plans there; None if the robot wins.
    Longer plans do not help once they have as many instants as these rules can require."""
    bound = contest.spare(steps)
    most = MOST_PLANNED if bound is None else min(bound, MOST_PLANNED)
    for spare in range(min(most, 1), most + 1):
        if not _wins(contest.play(steps, spare)):
            return None
        few = _fewest(contest, steps, spare)
        enough = few.spare(steps)
        if enough is None or enough > MOST_PLANNED:
            continue
        if enough <= spare:
            return few, spare
        if _wins(few.play(steps, enough)):
            return _fewest(few, steps, enough), enough
    if most == bound:
        return contest, most
    raise Undecided(
        plural(
            most,
            "no strategy of the robot with plans of {number} instant",
            "no strategy of the robot with plans of up to {number} instants",
        )
    )


def _wins(play: Play) -> bool:
    """Whether the environment wins."""
    first, *later = play.turns
    return winning_move(play.circuit, first, play.lost, later) is not None


def _fewest(contest: _Contest, steps: int, spare: int) -> _Contest:
    """A minimal set of rules with which the environment still wins."""
    kept = list(contest.part.rules)
    size = len(kept)
    while size:
        start = 0
        while start < len(kept):
            fewer = kept[:start] + kept[start + size :]
            if _wins(contest.only(fewer).play(steps, spare)):
                kept = fewer
            else:
                start += size
        size //= 2
    return contest.only(kept)


class StrategySearch:
    """The search for a simple strategy of the environment, in a game that it wins."""

    def __init__(self, contest: _Contest, steps: int, spare: int) -> None:
        self._play = contest.play(steps, spare, eager=False)
        self._circuit = self._play.circuit
        self._steps = steps

    def strategy(self) -> Strategy:
        return self._from(0, {}, [])

    def _from(self, step: int, settled: Move, unseen: list[int]) -> Strategy:
        """The strategy from an act on, with fixed moves of earlier turns. The environment does not depend on the
        robot's variables `unseen`."""
        settled = {**settled, **self._simplest(step, settled, unseen)}
        act = self._act(step, settled)
        if step + 1 == self._steps:
            return Strategy(act)
        unseen = [*unseen, *self._play.turns[2 * step + 1]]
        if self._move(step + 1, settled, unseen) is not None:
            return Strategy(act, (Branch(None, (), self._from(step + 1, settled, unseen)),))
        replies = list(islice(self._replies(step, settled, unseen), MOST_REPLIES + 1))
        branches = tuple(
            Branch(self._done(step, reply), self._planned(step, reply), self._from(step + 1, {**settled, **reply}, []))
            for reply in replies[:MOST_REPLIES]
        )
        return Strategy(act, branches, more=len(replies) > MOST_REPLIES)

    def _move(self, step: int, settled: Move, unseen: list[int]) -> Move | None:
        """A winning act of the environment that agrees with its fixed variables."""
        own, robots, *later = self._play.turns[2 * step :]
        goal = self._circuit.replaced(self._play.lost, settled)
        free = [variable for variable in own if variable not in settled]
        return winning_move(self._circuit, free, goal, [[*unseen, *robots], *later])

    def _simplest(self, step: int, settled: Move, unseen: list[int]) -> Move:
        """A winning act that is early and has few events."""
        found = self._move(step, settled, unseen)
        assert found is not None, "the environment wins"
        fixed: Move = {}
        for wish in self._play.wishes(step):
            wanted = {**fixed, **wish}
            if any(found[variable] != value for variable, value in wish.items()):
                other = self._move(step, {**settled, **wanted}, unseen)
                if other is None:
                    continue
                found = {**wanted, **other}
            fixed = wanted
        return found

    def _replies(self, step: int, settled: Move, variables: Sequence[int]) -> Iterator[Move]:
        """Answers of the robot that satisfy everything so far, with different immediate actions."""
        goal = self._circuit.replaced(self._play.kept[step], settled)
        while True:
            reply = winning_move(self._circuit, variables, goal)
            if reply is None:
                return
            yield reply
            now = self._play.doing(step).values()
            goal = self._circuit.both(goal, self._circuit.some(-variable * reply[variable] for variable in now))

    # Decoding --------------------------------------------------------------------------------------------

    def _act(self, step: int, settled: Move) -> Act:
        act = self._play.act(step, settled)
        return replace(act, events=tuple(event for event in act.events if event not in self._play.doing(step)))

    def _done(self, step: int, reply: Move) -> tuple[str, ...]:
        return tuple(name for name, variable in self._play.doing(step).items() if reply[variable] > 0)

    def _planned(self, step: int, reply: Move) -> tuple[Act, ...]:
        return tuple(act for act in self._play.plan(step, reply) if act.events)
