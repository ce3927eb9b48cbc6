"""Continuations: whether the robot has a response that complies with some rules in a situation."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from functools import cached_property

from sleec_runtime.model import Clause, Lasting, Obligation
from sleec_verify.traces.demands import Demand, Every, Occurs, last_second
from sleec_verify.traces.induction import InductiveModel
from sleec_verify.traces.pending_demands import Slot
from sleec_verify.traces.relations import relation_key
from sleec_verify.traces.situations import Fact, Situations, state_formulas
from sleec_verify.traces.trivial_responses import contested_obligations


class _Contested(InductiveModel):
    """Traces without the responses that can always be met."""

    def obligations(self, clause: Clause) -> tuple[Obligation, ...]:
        return contested_obligations(self.index, clause)


class Continuations:
    """The continuations of one situation: `facts`, as `Situations.facts` gives them.

    `complies` answers for any set of rules. Each fact is an assumption, so that a core names the relevant ones.
    """

    def __init__(self, situations: Situations, facts: Iterable[Fact]) -> None:
        self.situations = situations
        self.model = model = _Contested(situations.index)
        self.facts: dict[Fact, int] = {}
        facts = tuple(facts)
        self.nodes = {situations.now: model.node()}
        self.now = self.nodes[situations.now]
        slots = {int(str(fact[1])) for fact in facts if fact[0] == "slot" and fact[-1]}
        for number in slots:
            self.nodes[situations.slots[number].node] = model.node()
        self._active = {str(fact[1]): model.formula.fresh() for fact in facts if fact[0] == "lasts" and fact[-1]}
        for key in self._active:
            law, _, node = situations.lasting[key]
            if law.duration is not None:
                self.nodes[node] = model.node()
        occurred = {event: model.formula.fresh() for event in situations.occurred}
        model.past.occurred = lambda event: occurred.get(event, -model.formula.true)
        for key in self._active:
            law, _, node = situations.lasting[key]
            model.past.began[key] = lambda at, key=key, law=law, node=node: self._lasts(key, law, node, at)  # type: ignore[misc]
        model.instant(model.formula.true, at=self.now)
        model.after = self.now
        instant = model.instants[self.now]
        for formula in state_formulas(situations.index):
            instant.literal(formula)
        # Ordering measures adds variables, which facts name.
        instant.settle()
        for event in sorted(situations.index.never_in_response - situations.inputs.keys()):
            model.add([-instant.event(event)])
        active = {number: model.formula.fresh() for number in slots}
        came: dict[tuple[int, Occurs], int] = {}
        for number in slots:
            slot = situations.slots[number]
            for leaf, flag in slot.came.items():
                known = flag == -situations.true
                came[number, leaf] = -model.formula.true if known else model.formula.fresh()
            demand = self._pending(slot, number, slot.demand, came)
            model.add([-model.in_force(slot.rule.label), -active[number], demand])
        for fact in facts:
            literal = self._literal(fact, active, came, occurred)
            if literal is not None:
                self.facts[fact] = literal

    def _lasts(self, key: str, law: Lasting, node: int, at: int) -> list[int]:
        """Literals that together say that a relation that began before now binds at an instant."""
        if law.duration is None:
            return [self._active[key]]
        return [self._active[key], self.model.times.at_most(self.nodes[node], at, last_second(law.duration))]

    def _pending(self, slot: Slot, number: int, demand: Demand, came: dict[tuple[int, Occurs], int]) -> int:
        """A literal that implies that a pending demand is met from now on."""
        model = self.model
        assert not isinstance(demand, int), "slots have no literals"
        if isinstance(demand, Occurs):
            later = model.occurs(self.nodes[slot.node], demand)
            flag = came[number, demand]
            return model.formula.every([-flag, later]) if demand.negated else model.formula.any_of([flag, later])
        parts = [self._pending(slot, number, part, came) for part in demand.parts]
        return model.formula.every(parts) if isinstance(demand, Every) else model.formula.any_of(parts)

    def _literal(
        self, fact: Fact, active: dict[int, int], came: dict[tuple[int, Occurs], int], occurred: dict[str, int]
    ) -> int | None:
        """The literal of a fact here; None for a fact without an effect, such as an act that does not occur yet."""
        kind, name, *rest = fact
        value = bool(rest[-1])
        instant = self.model.instants[self.now]
        if kind == "rule" or (kind == "lasts" and not value):
            return None
        if kind == "input":
            if not value and name not in self.situations.index.never_in_response:
                return None
            literal = instant.event(str(name))
        elif kind == "state":
            literal = instant.variables[name]  # type: ignore[index]
        elif kind == "slot":
            literal = active[int(str(name))]
        elif kind == "came":
            literal = came[int(str(name)), rest[0]]  # type: ignore[index]
        elif kind == "gap":
            literal = self._gap(fact)
        elif kind == "occurred":
            literal = occurred[str(name)]
        else:
            literal = self._active[str(name)]
        return literal if value else -literal

    def _gap(self, fact: Fact) -> int:
        _, a, b, most, _ = fact
        return self.model.times.at_most(self.nodes[a], self.nodes[b], most)  # type: ignore[index, arg-type]

    @cached_property
    def relations(self) -> list[str]:
        return [relation_key(relation) for relation in self.situations.index.relations]

    def complies(
        self, rules: Collection[str], but: Collection[Fact] = (), *more: int, relations: Collection[str] | None = None
    ) -> bool:
        """Whether some response complies with `rules`. Facts of `but` are left open. `relations` are the keys of those
        that count, by default all.

        Raises `Undecided`.
        """
        open_facts = frozenset(but)
        literals = [literal for fact, literal in self.facts.items() if fact not in open_facts]
        counting = [*rules, *(self.relations if relations is None else relations)]
        return self.model.ask(*literals, *more, counting=counting)

    def relations_in_core(self) -> list[str]:
        """The keys of the relations in the core of the last answer, which was no."""
        return [key for key in self.model.matter() if key not in self.situations.selected]

    def core(self) -> list[Fact]:
        """The facts in the core of the last answer, which was no."""
        core = self.model.core
        found = [fact for fact, literal in self.facts.items() if literal in core]
        return [*found, *(("rule", key, True) for key in self.model.matter() if key in self.situations.selected)]

    def refutes(self, facts: Collection[Fact]) -> bool:
        """Whether no response complies with the rules of some facts in all situations with these facts. Their
        bounds on times may differ from the original ones. Raises `Undecided`."""
        literals = [self._gap(fact) if fact[0] == "gap" else self.facts.get(fact) for fact in facts]
        rules = [str(fact[1]) for fact in facts if fact[0] == "rule"]
        known = [literal for literal in literals if literal is not None]
        return not self.model.ask(*known, counting=[*rules, *self.relations])

    def gap(self, a: int, b: int) -> int:
        """The time from a node to another one, in seconds, in the last answer, which was yes."""
        times, _ = self.model.schedule()
        return times[self.nodes[b]] - times[self.nodes[a]]
