"""Histories: whether a lawful history leads to an abstract situation, and an example.

A history is lawful if no rule and no relation is violated so far, for each triggering separately (docs/times.md). It is
a trace model in which all instants are before now, and a demand whose window is still open at now need not be met.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from sleec_runtime.model import Lasting, Obligation, Rule
from sleec_verify.encoding.budget import as_far_as_decided
from sleec_verify.traces.cone import surroundings
from sleec_verify.traces.demands import Demand, Every, Occurs, last_second
from sleec_verify.traces.model import TraceModel
from sleec_verify.traces.pending_demands import Slot, from_last_end, is_open, last_end
from sleec_verify.traces.relation_encoding import stopped
from sleec_verify.traces.situations import Fact, Situations
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.traces.trivial_responses import contested_obligations


class Histories(TraceModel):
    """The lawful histories that lead to the situations with some `facts`.

    With `strict`, the history leaves nothing of `rules` pending except the slots of the facts.
    """

    def __init__(self, situations: Situations, facts: Iterable[Fact], rules: Collection[str]) -> None:
        super().__init__(surroundings(situations.index))
        self.strict = self.formula.fresh()
        self._situations = situations
        self._of = frozenset(rules)
        self._slots: dict[int, Slot] = {}
        self._nodes_of_slots: dict[int, int] = {}
        self.trigger_of: dict[int, TraceInstant] = {}
        """The instants of `history` that triggered the slots, by the numbers of these."""
        self.now = self.before = self.node()
        self._mode: list[int] = []
        self.facts: dict[Fact, int] = {}
        self._nodes = nodes = {situations.now: self.now}
        wanted = [fact for fact in facts if fact[0] in ("slot", "came", "gap", "occurred", "lasts")]
        for fact in wanted:
            if fact[0] == "slot" and fact[-1]:
                slot = situations.slots[int(str(fact[1]))]
                node = nodes.setdefault(slot.node, self.node())
                self._slots[node] = slot
                self._nodes_of_slots[int(str(fact[1]))] = node
            elif fact[0] == "lasts" and fact[-1]:
                nodes.setdefault(situations.lasting[str(fact[1])][2], self.node())
        self._triggers_of = {
            node: self.node() if any(choice.shift for choice in slot.pending.choices) else node
            for node, slot in self._slots.items()
        }
        """For the node of a slot, that of the trigger. The slot can count from an earlier time (`Pending`)."""
        for fact in wanted:
            literal = self._literal(fact)
            if literal is not None:
                self.facts[fact] = literal

    def _literal(self, fact: Fact) -> int | None:
        nodes = self._nodes
        kind, name, *rest = fact
        value = bool(rest[-1])
        if kind == "slot":
            if not value:
                return None
            slot = self._situations.slots[int(str(name))]
            return self._triggers(slot, nodes[slot.node])
        if kind == "came":
            slot = self._situations.slots[int(str(name))]
            leaf = rest[0]
            assert isinstance(leaf, Occurs)
            return self._came(nodes[slot.node], leaf) if value else self._never(nodes[slot.node], leaf)
        if kind == "gap":
            a, b, most, _ = fact[1:]
            there = a in nodes and b in nodes
            return self.times.at_most(nodes[a], nodes[b], most) if there else None  # type: ignore[index, arg-type]
        if kind == "occurred":
            event = str(name)
            if value:
                return self.exists(lambda at: self.instants[at].event(event))
            never = self.formula.fresh()
            self.exclude(never, event)
            return never
        law, _, node = self._situations.lasting[str(name)]
        return self._lasts(law, nodes[node]) if value else self._is_over(law)

    def _triggers(self, slot: Slot, node: int) -> int:
        """A literal that implies that a slot's demand is triggered and, as far as flags do not say it, is neither met
        nor violated."""
        unmet = [self._never(node, leaf) for leaf, flag in slot.came.items() if flag == -self._situations.true]
        trigger = self._triggers_of[node]

        def triggered(at: int) -> int:
            same_time = self.times.within(trigger, at, 0, 0)
            if -self.formula.true in same_time:
                return -self.formula.true
            guard = self.instants[at].guards(slot.rule, self.reading)[slot.pending.number]
            choices = [
                self.formula.every(
                    [
                        *self.index.responses.deciding(slot.pending.obligation, choice.clauses, self.chain(at)),
                        *self.times.within(node, trigger, choice.shift, choice.shift),
                    ]
                )
                for choice in slot.pending.choices
            ]
            return self.formula.every([*same_time, self.instants[at].used, guard, self.formula.any_of(choices)])

        return self.formula.every([self.exists(triggered), *unmet])

    def _came(self, node: int, leaf: Occurs) -> int:
        return self.exists(
            lambda other: self.formula.every([self.instants[other].event(leaf.event), *self._window(node, leaf, other)])
        )

    def _never(self, node: int, leaf: Occurs) -> int:
        never = self.formula.fresh()

        def exclude(other: int) -> None:
            bounds = self._window(node, leaf, other)
            if -self.formula.true not in bounds:
                self.add([-never, -self.instants[other].event(leaf.event), *(-bound for bound in bounds)])

        self.everywhere(exclude)
        return never

    def _window(self, node: int, leaf: Occurs, other: int) -> list[int]:
        """Literals that together say that an instant is in the window of an atom of a slot."""
        if is_open(leaf):
            trigger = self._triggers_of[node]
            opened = self.times.within(trigger, other, leaf.start, None)
            return [*opened, *self.times.within(node, other, None, leaf.end)]
        return self.times.within(node, other, leaf.start, leaf.end)

    def _lasts(self, law: Lasting, node: int) -> int:
        """A literal that implies that a relation begins at the time of a node and is not over before now."""

        def begins(at: int) -> int:
            same_time = self.times.within(node, at, 0, 0)
            return self.formula.every(
                [*same_time, self.instants[at].event(law.event), self.condition(at, law.condition)]
            )

        began = self.exists(begins)
        if law.end is None:
            return began
        end, goes_on = law.end, self.formula.fresh()

        def not_over(other: int) -> None:
            ends = [self.instants[other].event(end), self.condition(other, law.end_condition)]
            self.add([-goes_on, *(-literal for literal in (*ends, *self.times.within(node, other, 0, None)))])

        self.everywhere(not_over)
        return self.formula.every([began, goes_on])

    def _is_over(self, law: Lasting) -> int:
        """A literal that implies that a relation requires nothing now: it has not begun, or it is over."""
        over = self.formula.fresh()
        last = None if law.duration is None else last_second(law.duration)

        def has_ended(at: int) -> None:
            bounds = self.times.within(at, self.now, 0, last)
            begins = [self.instants[at].event(law.event), self.condition(at, law.condition), *bounds]
            if -self.formula.true not in begins:
                self.add([-over, *(-literal for literal in begins), *stopped(self, law, at, self.now)])

        self.everywhere(has_ended)
        return over

    # Nothing else is pending ----------------------------------------------------------------------------------

    def _encode(self, at: int, rule: Rule) -> None:
        super()._encode(at, rule)
        if rule.label not in self._of:
            return
        for number, (clause, guard) in enumerate(self.guards(at, rule)):
            for obligation in contested_obligations(self.index, clause):
                for conditions, demand in self._demands(at, obligation):
                    settled = self.formula.any_of(
                        [self._settled(at, demand), *self._dominated(at, rule, number, demand)]
                    )
                    self.add([-self.strict, -guard, *(-literal for literal in conditions), settled])

    def _demands(self, at: int, obligation: Obligation) -> Iterator[tuple[list[int], Demand]]:
        """The demand of an obligation; if measures give its windows, one for each of their values, with literals that
        together say that the measures have them."""
        if self.index.lengths.cases(obligation) is None:
            yield [], self.due(at, (obligation,))
            return
        for demand, choices in self.index.responses.variants(obligation):
            for choice in choices:
                yield self.index.responses.deciding(obligation, choice, self.chain(at)), demand

    def _settled(self, at: int, demand: Demand) -> int:
        """A literal that implies that a demand is met before now, for every continuation."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            if not demand.negated:
                return self.exists(lambda other: self.occurrence(at, other, demand))
            if demand.end is None:
                return -self.formula.true
            return self.formula.every([self.occurs(at, demand), -self.open(at, demand)])
        parts = [self._settled(at, part) for part in demand.parts]
        return self.formula.every(parts) if isinstance(demand, Every) else self.formula.any_of(parts)

    def _dominated(self, at: int, rule: Rule, number: int, demand: Demand) -> list[int]:
        """Literals each of which implies that a slot implies what a demand leaves pending."""
        found = []
        for node, slot in self._slots.items():
            if (slot.rule.label, slot.pending.number) == (rule.label, number):
                found.append(self.formula.every(self.times.within(self._triggers_of[node], at, 0, 0)))
                if not slot.pending.is_dominant or not isinstance(demand, Occurs):
                    continue
                if from_last_end(slot.demand) == from_last_end(demand):
                    # The demand counts from this many seconds before `at`.
                    shift = last_end(slot.demand) - last_end(demand)
                    at_most = self.times.at_most
                    found.append(at_most(node, at, shift) if demand.negated else at_most(at, node, -shift))
        return found

    # Questions ------------------------------------------------------------------------------------------------

    def exist(self, *, strict: bool = True) -> bool:
        """Whether there is such a history. Later questions have the same mode. Raises `Undecided`."""
        self._mode = [self.strict] if strict else []
        return self.ask(*self.facts.values(), *self._mode)

    def _occurrences(self) -> list[int]:
        """The literals of the events of the last answer, which was yes."""
        events = (literal for instant in self.instants.values() for literal in instant.events().values())
        return [literal for literal in events if self.true(literal)]

    def _exists_without(self, absent: Sequence[int]) -> bool:
        with as_far_as_decided():
            return self.ask(*self.facts.values(), *self._mode, *absent)
        return False

    def refuted(self) -> list[Fact]:
        """The facts in the core of the last answer, which was no."""
        return [fact for fact, literal in self.facts.items() if literal in self.core]

    def refutes(self, facts: Collection[Fact]) -> bool:
        """Whether no history leads to situations with these facts. Their bounds on times may differ from the
        original ones. Raises `Undecided`."""
        literals = [self._literal(fact) if fact[0] == "gap" else self.facts.get(fact) for fact in facts]
        return not self.ask(*(literal for literal in literals if literal is not None), *self._mode)

    def gap(self, a: int, b: int) -> int:
        """The time from a node to another one, in seconds, in the last answer, which was yes."""
        times, _ = self.schedule()
        return times[self._nodes[b]] - times[self._nodes[a]]

    def history(self) -> tuple[list[TraceInstant], int]:
        """A history without unnecessary events, after the answer yes: its instants and the time of now. The first
        instant is at 0."""
        found, left = self._moments(), self._occurrences()
        absent: list[int] = []
        needed: set[int] = set()
        while ahead := [literal for literal in left if literal not in needed]:
            if self._exists_without([*absent, -ahead[0]]):
                absent.append(-ahead[0])
                found, left = self._moments(), self._occurrences()
            else:
                # If this is undecided, the history found before is as good.
                needed.add(ahead[0])
        return found

    def _moments(self) -> tuple[list[TraceInstant], int]:
        """The history of the last answer, which was yes."""
        times, _ = self.schedule()
        nodes = sorted((n for n in self.used() if n in self.instants and self.events(n)), key=lambda n: times[n])
        begin = min((times[node] for node in nodes), default=times[self.now])
        moments = [self.at(node, times[node] - begin) for node in nodes]
        by_time = {moment.time: moment for moment in moments}
        for number, node in self._nodes_of_slots.items():
            self.trigger_of[number] = by_time[times[self._triggers_of[node]] - begin]
        return moments, times[self.now] - begin
