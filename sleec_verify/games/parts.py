"""Parts of a ruleset that have nothing to do with each other: what is done for one cannot break another.

What the robot can do at any time without consequence is no part of any: nothing forbids it, no relation or condition
speaks of it, and what it triggers is of the same kind.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from sleec_runtime.model import Atom, Exclusive, Formula, Rule, formulas_of, leaves, measures_of
from sleec_runtime.model_time import EventRelation, Lasting, MeasureRelation
from sleec_verify.timed.program import Law, Program, events_in_conditions, events_of
from sleec_verify.timed.responses import Occurs


@dataclass(frozen=True)
class Part:
    """Rules and laws that have nothing to do with the others of their ruleset, the events that they speak of, and by
    the labels of the rules what they call for and forbid."""

    rules: tuple[Rule, ...]
    laws: tuple[Law, ...]
    events: tuple[str, ...]
    windows: Mapping[str, tuple[Occurs, ...]]


def free_events(program: Program) -> frozenset[str]:
    """What the robot can do at any time without consequence. Linear in the size of the rules, but for those that call
    for something later which leads back to them."""
    tied = {name for law in program.laws for name in events_of(law)}
    tied |= {name for rule in program.rules for name in events_in_conditions(rule)}
    windows = {rule.label: program.windows(rule) for rule in program.rules}
    bound = {window.event for found in windows.values() for window in found if window.negated}
    bound |= (
        {name for name, agent in program.agents.items() if agent != "system"} | tied | set(_endless(program, windows))
    )
    calling: dict[str, set[str]] = {}
    for rule in program.rules:
        for window in windows[rule.label]:
            if window.negated:
                bound.add(rule.trigger)
            calling.setdefault(window.event, set()).add(rule.trigger)
    ahead = list(bound)
    while ahead:
        for trigger in calling.get(ahead.pop(), ()):
            if trigger not in bound:
                bound.add(trigger)
                ahead.append(trigger)
    return frozenset(program.agents) - bound


def _endless(program: Program, windows: Mapping[str, list[Occurs]]) -> Iterator[str]:
    """Events that call for others which are due strictly later and lead back to them."""
    for rule in program.rules:
        for window in windows[rule.label]:
            if window.start is not None and window.start > 0:
                seen: set[str] = set()
                ahead = [window.event]
                while ahead:
                    event = ahead.pop()
                    if event not in seen:
                        seen.add(event)
                        for other in program.by_trigger.get(event, ()):
                            ahead += (w.event for w in windows[other.label] if not w.negated)
                if rule.trigger in seen:
                    yield rule.trigger


def parts(program: Program) -> Iterator[Part]:
    """The parts of a ruleset, in the order of their first rules and laws. O(size of the rules).

    Rules that share an event belong together, and so do those that a law ties. What a law says of measures only holds
    in every part that looks at one of them; they share the measures, which are the environment's to choose in each.
    """
    free = free_events(program)
    windows = {r.label: tuple(w for w in program.windows(r) if w.event not in free) for r in program.rules}
    contested = [rule for rule in program.rules if windows[rule.label]]
    union = _Union()
    laws = [(law, list(events_of(law)), set(_facts(formulas_of_law(law)))) for law in program.laws]
    users: dict[str, str] = {}
    for _, events, facts in laws:
        if events:
            for fact in facts:
                users.setdefault(fact, events[0])
    tied = set(users)
    for rule in contested:
        for window in windows[rule.label]:
            union.join(rule.trigger, window.event)
        for event in events_in_conditions(rule):
            union.join(rule.trigger, event)
        for fact in _facts(formulas_of(rule)):
            if fact in tied:
                union.join(rule.trigger, users[fact])
    for _, events, facts in laws:
        for event in events:
            union.join(events[0], event)
        if events:
            for fact in facts:
                union.join(events[0], users[fact])
    found: dict[str, tuple[list[Rule], list[Law], set[str]]] = {}
    for rule in contested:
        part = found.setdefault(union.root(rule.trigger), ([], [], set()))
        part[0].append(rule)
        part[2].update([rule.trigger, *(window.event for window in windows[rule.label]), *events_in_conditions(rule)])
    for law, events, _ in laws:
        if events:
            part = found.setdefault(union.root(events[0]), ([], [], set()))
            part[1].append(law)
            part[2].update(events)
    of_measures = [(law, facts) for law, events, facts in laws if not events]
    for rules, own, events_here in found.values():
        facts = {fact for rule in rules for fact in _facts(formulas_of(rule))}
        facts.update(fact for law in own for fact in _facts(formulas_of_law(law)))
        joined = [law for law, about in _reached(of_measures, facts)]
        own_windows = {rule.label: windows[rule.label] for rule in rules}
        yield Part(tuple(rules), (*own, *joined), tuple(sorted(events_here)), own_windows)


def _reached(laws: list[tuple[Law, set[str]]], facts: set[str]) -> list[tuple[Law, set[str]]]:
    """The laws that have to do with some facts, by way of others."""
    found: list[tuple[Law, set[str]]] = []
    left = laws
    grew = True
    while grew:
        near = [entry for entry in left if not facts.isdisjoint(entry[1])]
        grew = bool(near)
        found += near
        left = [entry for entry in left if entry not in near]
        facts = facts.union(*(about for _, about in near))
    return found


def _facts(formulas: Iterable[Formula]) -> Iterator[str]:
    """The conditions and measures of some formulas."""
    for formula in formulas:
        for leaf in leaves(formula):
            if not isinstance(leaf, Atom):
                yield from measures_of(leaf)
            elif leaf.kind == "condition":
                yield leaf.name


def formulas_of_law(law: Law) -> Iterator[Formula]:
    """The formulas of a law."""
    found: tuple[Formula | None, ...] = ()
    if isinstance(law, MeasureRelation):
        found = (law.left, law.right)
    elif isinstance(law, Lasting):
        found = (law.condition, law.formula, law.end_condition)
    elif not isinstance(law, (EventRelation, Exclusive)):
        found = (law.formula,)
    yield from (formula for formula in found if formula is not None)


class _Union:
    """Sets of names that grow together."""

    def __init__(self) -> None:
        self._above: dict[str, str] = {}

    def root(self, name: str) -> str:
        path = []
        while (above := self._above.get(name, name)) != name:
            path.append(name)
            name = above
        for passed in path:
            self._above[passed] = name
        return name

    def join(self, a: str, b: str) -> None:
        self._above[self.root(a)] = self.root(b)
