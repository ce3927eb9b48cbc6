"""A ruleset as the questions about traces need it: the rules of each event, and what holds at every instant."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple, TypeVar, Union

from sleec_runtime.model import (
    Agent,
    Assume,
    Atom,
    Clause,
    Declaration,
    Exclusive,
    Formula,
    Never,
    Obligation,
    Rule,
    Ruleset,
    formulas_of,
    in_text_order,
    leaves,
    literals,
    names_of,
)
from sleec_runtime.model_time import RELATIONS, Claim, Effect, EventRelation, Lasting, MeasureRelation, Relation
from sleec_verify.solver import Recorder, Undecided
from sleec_verify.timed.responses import Demand, Occurs, Part, Responses, certain, occurrences, parts_of, ways_of
from sleec_verify.timed.scope import Untimed

if TYPE_CHECKING:
    from sleec_verify.timed.brought import Brought
    from sleec_verify.timed.free import Free

Law = Union[Relation, Exclusive, Never, Assume]
"""What a ruleset demands besides its rules."""

_Indexed = TypeVar("_Indexed", Rule, Law)


def law_name(law: Law) -> str:
    """What a law goes by among the labels of the rules, which have no blanks: where it stands."""
    return f"law at {law.span.start}"


def events_of(law: Law) -> Iterator[str]:
    """The events that a law speaks of."""
    if isinstance(law, EventRelation):
        yield law.left
        yield law.right
    elif isinstance(law, Effect):
        yield law.event
    elif isinstance(law, Lasting):
        yield law.event
        if law.end is not None:
            yield law.end
    elif isinstance(law, Exclusive):
        yield from law.names
    elif isinstance(law, (Never, Assume)):
        yield from (leaf.name for leaf in leaves(law.formula) if isinstance(leaf, Atom) and leaf.kind != "condition")


def may_call(law: Law) -> Iterator[str]:
    """The events that a law may call for."""
    if isinstance(law, EventRelation):
        if law.relation in ("equal", "happenBefore"):
            yield law.left
        if law.relation in ("equal", "witness"):
            yield law.right
    elif isinstance(law, Lasting):
        if law.end is not None:
            yield law.end
    elif isinstance(law, (Assume, Never)) or (isinstance(law, Effect) and law.relation == "causation"):
        yield from events_of(law)


def together(law: Law) -> Iterator[tuple[str, str]]:
    """The pairs of events of which a law lets the one occur only with the other."""
    if isinstance(law, EventRelation) and law.relation in ("equal", "witness"):
        yield law.left, law.right
        if law.relation == "equal":
            yield law.right, law.left


def excluding(law: Law) -> Iterator[tuple[str, str]]:
    """The pairs of events that a law excludes from one instant, whatever else is the case."""
    if isinstance(law, EventRelation) and law.relation == "mutualExclusive":
        yield law.left, law.right
    elif isinstance(law, Exclusive):
        yield from combinations(dict.fromkeys(law.names), 2)


def kept_apart(law: Law, event: str) -> set[str]:
    """The events that a law excludes from the instants of an event: itself, where it can never occur."""
    return {right if event == left else left for left, right in excluding(law) if event in (left, right)}


def formulas_of_law(law: Law) -> Iterator[Formula]:
    """What a law says of the conditions and measures."""
    if isinstance(law, MeasureRelation):
        candidates: tuple[Formula | None, ...] = (law.left, law.right)
    elif isinstance(law, Lasting):
        candidates = (law.condition, law.formula, law.end_condition)
    elif isinstance(law, (Effect, Never, Assume)):
        candidates = (law.formula,)
    else:
        candidates = ()
    yield from (formula for formula in candidates if formula is not None)


def _index(pairs: Iterable[tuple[str, _Indexed]]) -> dict[str, list[_Indexed]]:
    """The values of each key, each once, in their order."""
    index: dict[str, list[_Indexed]] = {}
    for key, value in pairs:
        values = index.setdefault(key, [])
        if not values or values[-1] is not value:
            values.append(value)
    return index


def _found(same: dict[str, str], event: str) -> str:
    """What stands for an event and those that are the same as it."""
    while event in same:
        event = same[event]
    return event


def leads_back(calls: Iterable[tuple[str, str]]) -> bool:
    """Whether anything that calls for something else is called for by that in the end."""
    from graphlib import CycleError, TopologicalSorter

    graph: TopologicalSorter[str] = TopologicalSorter()
    for event, called in calls:
        graph.add(event, called)
    try:
        graph.prepare()
    except CycleError:
        return True
    return False


def comes_back(later: Sequence[tuple[str, str]], at_once: Sequence[tuple[str, str]]) -> bool:
    """Whether anything that calls for something later is called for by that in the end, be it at once or later. Linear
    where nothing leads back, and quadratic else."""
    if not leads_back((*later, *at_once)):
        return False
    called: dict[str, set[str]] = defaultdict(set)
    for event, other in (*later, *at_once):
        called[event].add(other)
    for event, other in later:
        found, ahead = {other}, [other]
        while ahead:
            fresh = called[ahead.pop()] - found
            found |= fresh
            ahead += fresh
        if event in found:
            return True
    return False


MOST_FOLLOWERS = 200
"""What comes of an event is not looked at further than this."""


class Follower(NamedTuple):
    """What occurs after an event, as rules of these labels call for it one after the other."""

    what: Occurs
    labels: tuple[str, ...]


def _size(clause: Clause) -> int:
    return sum(1 for _ in in_text_order(clause))


class Program:
    """The indices of one ruleset under one meaning of responses without a window."""

    def __init__(self, ruleset: Ruleset, untimed: Untimed = "at", recorder: Recorder | None = None) -> None:
        """`recorder` is told of every question about its traces."""
        self.ruleset = ruleset
        self.recorder = recorder
        self.untimed = untimed
        self.rules = ruleset.rules
        self.responses = Responses(untimed)
        self._demands: dict[str, list[list[Demand]]] = {}
        self._windows: dict[str, list[Occurs]] = {}
        self._parts: dict[tuple[str, int | None], list[Part]] = {}
        self._followers: dict[str, list[Follower]] = {}
        self._endless: dict[frozenset[str], frozenset[str]] = {}

    def impossible(self, without: frozenset[str] = frozenset()) -> frozenset[str]:
        """The events that are known so far to occur in no trace that keeps all but the rules `without`."""
        return self._endless.get(without, frozenset())

    def look_for_impossible(self, without: frozenset[str] = frozenset()) -> bool:
        """Find such events; whether this is news."""
        from sleec_verify.timed.endless import endless

        if without in self._endless or not self.has_delays:
            return False
        self._endless[without] = endless(self, without)
        return bool(self._endless[without])

    @cached_property
    def by_trigger(self) -> dict[str, list[Rule]]:
        return _index((rule.trigger, rule) for rule in self.rules)

    @cached_property
    def laws(self) -> list[Law]:
        """Relations and constraints, in the order of the text."""
        return [s for s in self.ruleset.statements if isinstance(s, (*RELATIONS, Exclusive, Never, Assume))]

    def laws_among(self, events: set[str]) -> list[Law]:
        """The laws that speak of these events only."""
        return [law for law in self.laws if events.issuperset(events_of(law))]

    @cached_property
    def obliging(self) -> dict[str, list[Rule]]:
        """The rules that may come to oblige an event."""
        return self._answering(negated=False)

    @cached_property
    def forbidding(self) -> dict[str, list[Rule]]:
        """The rules that may come to forbid an event."""
        return self._answering(negated=True)

    def _answering(self, negated: bool) -> dict[str, list[Rule]]:
        return _index((o.name, rule) for rule in self.rules for o in responses_of(rule) if o.negated == negated)

    @cached_property
    def bound(self) -> dict[str, set[str]]:
        """The events that some law ties to an event."""
        index: dict[str, set[str]] = {}
        for law in self.laws:
            names = set(events_of(law))
            for name in names:
                index.setdefault(name, set()).update(names - {name})
        return index

    @cached_property
    def law_named(self) -> dict[str, Law]:
        """The laws by what they go by (`law_name`)."""
        return {law_name(law): law for law in self.laws}

    @cached_property
    def laws_of_event(self) -> dict[str, list[Law]]:
        """The laws that speak of an event."""
        return _index((event, law) for law in self.laws for event in events_of(law))

    @cached_property
    def laws_of_measure(self) -> dict[str, list[Law]]:
        """The laws that speak of a condition or measure."""
        return _index(
            (name, law) for law in self.laws for formula in formulas_of_law(law) for name in names_of(formula)
        )

    @cached_property
    def may_come_later(self) -> frozenset[str]:
        """The events that rules or laws may come to call for at a time after what calls for them."""
        found: set[str] = set()
        ahead = [
            what.event
            for rule in self.rules
            for what in self.windows_at_most(rule)
            if what.end != 0 and not what.negated
        ]
        ahead += [event for law in self.laws if not isinstance(law, EventRelation) for event in may_call(law)]
        while ahead:
            event = ahead.pop()
            if event not in found:
                found.add(event)
                ahead += [
                    o.name for rule in self.by_trigger.get(event, ()) for o in responses_of(rule) if not o.negated
                ]
                for law in self.laws_of_event.get(event, ()):
                    if isinstance(law, EventRelation) and law.relation != "mutualExclusive":
                        ahead += [law.left, law.right]
        return frozenset(found)

    @cached_property
    def pressing(self) -> dict[str, list[Rule]]:
        """The rules that may come to oblige an event at a time after what calls for that."""
        return {
            event: [rule for rule in rules if rule.trigger in self.may_come_later or self.is_timed(rule)]
            for event, rules in self.obliging.items()
        }

    @cached_property
    def reading_later(self) -> dict[str, list[Rule]]:
        """The rules that a condition or measure may decide at a time after what calls for their triggers."""
        return _index(
            (name, rule)
            for rule in self.rules
            if rule.trigger in self.may_come_later
            for formula in formulas_of(rule)
            for name in names_of(formula)
        )

    def demands_of_clauses(self, rule: Rule) -> list[list[Demand]]:
        """What each obligation of each clause of a rule demands, itself or what is due in its place.

        Raises Undecided for a window whose length a measure says."""
        found = self._demands.get(rule.label)
        if found is None:
            found = self._demands[rule.label] = [
                [self.responses.of((obligation,), lambda c: [1] * _size(c)) for obligation in clause.obligations]
                for clause in rule.clauses()
            ]
        return found

    def demands(self, rule: Rule) -> list[Demand]:
        """As `demands_of_clauses`, of all clauses together."""
        return [demand for demands in self.demands_of_clauses(rule) for demand in demands]

    def windows(self, rule: Rule) -> list[Occurs]:
        """Every occurrence that a rule may come to call for or forbid. Raises Undecided for a window whose length a
        measure says."""
        found = self._windows.get(rule.label)
        if found is None:
            found = self._windows[rule.label] = [one for demand in self.demands(rule) for one in occurrences(demand)]
        return found

    def bound_to_follow(self, event: str) -> list[Follower]:
        """What comes of an event whatever the conditions, by the rules that it triggers, by laws, and by theirs."""
        found = self._followers.get(event)
        if found is None:
            found = self._followers[event] = []
            ahead = deque([Follower(Occurs(event, 0, 0), ())])
            while ahead and len(found) < MOST_FOLLOWERS:
                one = ahead.popleft()
                for label, called in self._follow_at_first(one.what.event):
                    if label not in one.labels:
                        fresh = [Follower(what.following(one.what), (*one.labels, label)) for what in called]
                        found += fresh
                        ahead += fresh
        return found

    def _follow_at_first(self, event: str) -> Iterator[tuple[str, Iterator[Occurs]]]:
        """What comes of an event by single rules and laws, each with its label or name."""
        for rule in self.by_trigger.get(event, ()):
            yield rule.label, self.surely_called(rule)
        for law in self.laws_of_event.get(event, ()):
            for one, other in together(law):
                if one == event != other:
                    yield law_name(law), iter([Occurs(other, 0, 0)])

    def surely_called(self, rule: Rule) -> Iterator[Occurs]:
        """What a rule calls for whichever of its clauses decides, each event in a window that has room for all."""
        if rule.guard is not None:
            return
        try:
            clauses = self.demands_of_clauses(rule)
        except Undecided:
            return
        called = [
            {what.event: what for demand in demands for what in certain(demand) if not what.negated}
            for demands in clauses
        ]
        for event in sorted(set.intersection(*map(set, called))):
            windows = [in_clause[event] for in_clause in called]
            ends = [what.end for what in windows if what.end is not None]
            yield Occurs(
                event, min(what.start or 0 for what in windows), max(ends) if len(ends) == len(windows) else None
            )

    def windows_at_most(self, rule: Rule) -> list[Occurs]:
        """As `windows`, with all times from the trigger on where a measure says how long."""
        try:
            return self.windows(rule)
        except Undecided:
            return [Occurs(response.name, 0, None, response.negated) for response in responses_of(rule)]

    def parts(self, rule: Rule, standby: int | None = None) -> list[Part]:
        """As `windows_at_most`, each with what may as well be done in its place (`parts_of`). Where a measure says how
        long, no bound is known."""
        found = self._parts.get((rule.label, standby))
        if found is None:
            try:
                parts = [
                    part
                    for clause, demands in enumerate(self.demands_of_clauses(rule))
                    for demand in demands
                    for part in parts_of(demand, clause, standby)
                ]
            except Undecided:
                parts = [Part(what._replace(start=None), None, -1) for what in self.windows_at_most(rule)]
            found = self._parts[rule.label, standby] = list(dict.fromkeys(parts))
        return found

    def ways(self, rule: Rule) -> list[tuple[Occurs, ...]]:
        """For each way in which hedges inside responses may decide, those of which one has to be kept (`ways_of`); none
        where several have to be. Raises Undecided for a window whose length a measure says."""
        return [way for demand in self.demands(rule) for way in ways_of(demand) or ()]

    @cached_property
    def brought(self) -> Brought:
        """What each event brings with it."""
        from sleec_verify.timed.brought import Brought

        return Brought(self)

    @cached_property
    def free(self) -> Free:
        """What can be done whatever else is the case."""
        from sleec_verify.timed.free import Free

        return Free(self)

    @cached_property
    def is_acyclic(self) -> bool:
        """Whether nothing that an event calls for, by rules or laws, ever calls for that event again: then there are
        only so many instants that a trace can be made to have."""
        laws = self.laws
        if any(isinstance(law, (Assume, Never)) and any(events_of(law)) for law in laws):
            return False
        calls = [(rule.trigger, o.name) for rule in self.rules for o in responses_of(rule) if not o.negated]
        calls += [(law.event, law.end) for law in laws if isinstance(law, Lasting) and law.end is not None]
        same: dict[str, str] = {}
        for law in laws:
            if isinstance(law, EventRelation):
                if law.relation == "witness":
                    calls.append((law.left, law.right))
                elif law.relation == "happenBefore":
                    calls.append((law.right, law.left))
                elif law.relation == "equal":
                    one, other = _found(same, law.left), _found(same, law.right)
                    if one != other:
                        same[one] = other
        return not leads_back((_found(same, event), _found(same, called)) for event, called in calls)

    @cached_property
    def tied(self) -> frozenset[str]:
        """The labels of the rules whose conditions name events, and of all that share names with these, through one
        another or through laws: most arguments about conflicts hold only where measures alone decide a rule."""
        named = {rule.label: set(_names_of(rule)) for rule in self.rules}
        laws = [{*events_of(law), *(n for f in formulas_of_law(law) for n in names_of(f))} for law in self.laws]
        names = {name for rule in self.rules if any(events_in_conditions(rule)) for name in named[rule.label]}
        grew = bool(names)
        while grew:
            reached = (own for own in (*named.values(), *laws) if not own.isdisjoint(names))
            fresh = set[str]().union(*reached) - names
            names |= fresh
            grew = bool(fresh)
        return frozenset(label for label, own in named.items() if not own.isdisjoint(names))

    @cached_property
    def is_open_ended(self) -> bool:
        """Whether any time to come can be as now is, but for the events: no law tells one time from another."""
        return all(
            isinstance(law, (MeasureRelation, Exclusive))
            or (isinstance(law, EventRelation) and law.relation != "happenBefore")
            for law in self.laws
        )

    def is_inert(self, event: str) -> bool:
        """Whether an event has no consequences: it triggers no rule, and no law speaks of it."""
        return event not in self.by_trigger and event not in self.bound

    def is_timed(self, rule: Rule) -> bool:
        """Whether a rule demands anything of other instants than that of its trigger."""
        return any(o.start != 0 or o.end != 0 for o in self.windows_at_most(rule))

    @cached_property
    def has_delays(self) -> bool:
        """Whether any rule demands anything of other instants than that of its trigger."""
        return any(map(self.is_timed, self.rules))

    @cached_property
    def agents(self) -> dict[str, Agent]:
        """The agent of every event that the rules speak of: as it is declared; else a response is the robot's, and what
        only triggers the environment's."""
        found: dict[str, Agent] = {}
        for statement in self.ruleset.statements:
            if isinstance(statement, Declaration) and statement.agent is not None:
                found.update(dict.fromkeys(statement.names, statement.agent))
        for rule in self.rules:
            for response in responses_of(rule):
                found.setdefault(response.name, "system")
        for rule in self.rules:
            for event in (rule.trigger, *events_in_conditions(rule)):
                found.setdefault(event, "environment")
        return found

    @cached_property
    def claims(self) -> list[Claim]:
        return [s for s in self.ruleset.statements if isinstance(s, Claim)]


def events_in_conditions(rule: Rule) -> Iterator[str]:
    """The events that the conditions of a rule name, also those inside what is due in place of a response."""
    for formula in formulas_of(rule):
        yield from (leaf.name for leaf in leaves(formula) if isinstance(leaf, Atom) and leaf.kind == "trigger")


def _names_of(rule: Rule) -> Iterator[str]:
    """All events, conditions and measures that a rule names, but for measures that give lengths."""
    yield rule.trigger
    yield from (response.name for response in responses_of(rule))
    for formula in formulas_of(rule):
        yield from names_of(formula)


def responses_of(rule: Rule) -> Iterator[Obligation]:
    """Every response that a rule may come to, those in place of others included, in the order of the text."""
    for clause in rule.clauses():
        yield from literals(clause)
