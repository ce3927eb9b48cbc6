"""Independent parts of a ruleset: actions for one part cannot violate another.

Free events belong to no part. The robot can do them at any time without consequence: no rule forbids them, no relation
or condition names them, and they trigger only free events.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from sleec_runtime.model import Atom, Formula, Rule, leaves, measures_of
from sleec_verify.encoding.relations import Relation, events_of, formulas_of_relation
from sleec_verify.encoding.trace_scope import named_atoms
from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.traces.demands import Occurs
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.relations import names_of_rule
from sleec_verify.traces.trivial_responses import cannot_be_met


@dataclass(frozen=True)
class GamePart:
    """Rules and relations that are independent of the rest of their ruleset, with the events that they name. `windows`
    has the required and forbidden occurrences of each rule, by its label."""

    rules: tuple[Rule, ...]
    laws: tuple[Relation, ...]
    events: tuple[str, ...]
    windows: Mapping[str, tuple[Occurs, ...]]


def free_events(index: TraceIndex) -> frozenset[str]:
    """The events that the robot can do at any time without consequence. Linear in the size of the rules, except for
    rules whose later responses lead back to their trigger."""
    tied = {name for law in index.relations for name in events_of(law)}
    tied |= {name for rule in index.rules for name in named_atoms(rule)}
    windows = {rule.label: index.windows(rule) for rule in index.rules}
    bound = {window.event for found in windows.values() for window in found if window.negated}
    bound |= {name for name, agent in index.agents.items() if agent != "system"} | tied | set(_endless(index, windows))
    calling: dict[str, set[str]] = {}
    for rule in index.rules:
        if cannot_be_met(index, rule):
            bound.add(rule.trigger)
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
    return frozenset(index.agents) - bound


def _endless(index: TraceIndex, windows: Mapping[str, list[Occurs]]) -> Iterator[str]:
    """Events with strictly later responses that lead back to them."""
    for rule in index.rules:
        for window in windows[rule.label]:
            if window.start is not None and window.start > 0:
                seen: set[str] = set()
                ahead = [window.event]
                while ahead:
                    event = ahead.pop()
                    if event not in seen:
                        seen.add(event)
                        for other in index.by_trigger.get(event, ()):
                            ahead += (w.event for w in windows[other.label] if not w.negated)
                if rule.trigger in seen:
                    yield rule.trigger


def parts(index: TraceIndex) -> Iterator[GamePart]:
    """The parts of a ruleset, in the order of their first rules and relations. O(size of the rules).

    Rules that share an event belong together, and so do rules that a relation connects. A relation about measures only
    belongs to every part that uses one of its measures. Parts share measures, which the environment chooses for each
    part.
    """
    free = free_events(index)
    windows = {r.label: tuple(w for w in index.windows(r) if w.event not in free) for r in index.rules}
    contested = [rule for rule in index.rules if windows[rule.label] or cannot_be_met(index, rule)]
    union = UnionFind()
    laws = [(law, list(events_of(law)), set(_facts(formulas_of_relation(law)))) for law in index.relations]
    users: dict[str, str] = {}
    for _, events, facts in laws:
        if events:
            for fact in facts:
                users.setdefault(fact, events[0])
    tied = set(users)
    for rule in contested:
        for window in windows[rule.label]:
            union.join(rule.trigger, window.event)
        for event in named_atoms(rule):
            union.join(rule.trigger, event)
        for fact in _facts_of(rule):
            if fact in tied:
                union.join(rule.trigger, users[fact])
    for _, events, facts in laws:
        for event in events:
            union.join(events[0], event)
        if events:
            for fact in facts:
                union.join(events[0], users[fact])
    found: dict[Hashable, tuple[list[Rule], list[Relation], set[str]]] = {}
    for rule in contested:
        part = found.setdefault(union.root(rule.trigger), ([], [], set()))
        part[0].append(rule)
        part[2].update([rule.trigger, *(window.event for window in windows[rule.label]), *named_atoms(rule)])
    for law, events, _ in laws:
        if events:
            part = found.setdefault(union.root(events[0]), ([], [], set()))
            part[1].append(law)
            part[2].update(events)
    of_measures = [(law, facts) for law, events, facts in laws if not events]
    for rules, own, events_here in found.values():
        facts = {fact for rule in rules for fact in _facts_of(rule)}
        facts.update(fact for law in own for fact in _facts(formulas_of_relation(law)))
        joined = [law for law, about in _reached(of_measures, facts)]
        own_windows = {rule.label: windows[rule.label] for rule in rules}
        yield GamePart(tuple(rules), (*own, *joined), tuple(sorted(events_here)), own_windows)


def _reached(laws: list[tuple[Relation, set[str]]], facts: set[str]) -> list[tuple[Relation, set[str]]]:
    """The relations that share facts with these facts, directly or through other relations."""
    found: list[tuple[Relation, set[str]]] = []
    left = laws
    grew = True
    while grew:
        near = [entry for entry in left if not facts.isdisjoint(entry[1])]
        grew = bool(near)
        found += near
        left = [entry for entry in left if entry not in near]
        facts = facts.union(*(about for _, about in near))
    return found


def _facts_of(rule: Rule) -> Iterator[str]:
    """The conditions and measures that decide what a rule requires."""
    return (name for kind, name in names_of_rule(rule) if kind == "measure")


def _facts(formulas: Iterable[Formula]) -> Iterator[str]:
    """The conditions and measures of some formulas."""
    for formula in formulas:
        for leaf in leaves(formula):
            if not isinstance(leaf, Atom):
                yield from measures_of(leaf)
            elif leaf.kind == "condition":
                yield leaf.name
