"""Situations as an abstract state: what a history leaves pending, and the inputs and measures of now.

The state has *slots*. A slot is one pending demand: a response of a clause that decided before now and that the events
so far have neither met nor violated. Responses for which one pending demand does not imply the others get more slots if
a refutation needs them (`add_copies`).

This file does not decide whether a lawful history leads to the state: see `sleec_verify.traces.histories`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType

from sleec_runtime.model import Atom, EventRelation, Lasting, Obligation, leaves
from sleec_runtime.model import Formula as Condition
from sleec_verify.encoding.relations import formulas_of_relation
from sleec_verify.encoding.solver import MiniSat, Undecided
from sleec_verify.traces.act_conditions import Variant
from sleec_verify.traces.demands import Demand, Every, Occurs, last_second
from sleec_verify.traces.difference import Differences
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.instant import Instant, SharedClauses
from sleec_verify.traces.pending_demands import Pending, Slot, alternatives, pending_of
from sleec_verify.traces.relations import relation_key
from sleec_verify.wording.sentence import sentence

Fact = tuple[object, ...]
"""A literal of a situation by its meaning, and True or False: ``("rule", label)``, ``("input", event)``,
``("state", key)``, ``("slot", n)``, ``("came", n, leaf)``, ``("gap", a, b, seconds)`` (node b is at most this
number of seconds after node a), ``("occurred", event)`` or ``("lasts", key)``."""


class Situations:
    """The formula of all abstract states of a component."""

    def __init__(self, index: TraceIndex, variants: Mapping[str, Sequence[Variant]] = MappingProxyType({})) -> None:
        """`variants` are those of the rules whose conditions named acts (`sleec_verify.traces.act_conditions`)."""
        self.index = index
        self.reading = index.ruleset.reading
        self.formula = SharedClauses()
        self.true = self.formula.true
        self.add = self.formula.clauses.append
        self.times = Differences(self.formula.fresh, self.add, self.true)
        self.nodes = 1
        self.now = 0
        self.instant = Instant(self.formula, index.ruleset.measures, self.true)
        self.core: set[int] = set()
        """The literals in the core of the last `find`, if it found none."""
        self._solver = MiniSat()
        self._sent = 0
        for formula in state_formulas(index):
            self.instant.literal(formula)
        self.selected = {rule.label: self.formula.fresh() for rule in index.ruleset.rules}
        self.inputs = {event: self.formula.fresh() for event in sorted({*index.by_trigger, *index.naming})}
        self.guards = {rule.label: self.instant.guards(rule, self.reading, self.true) for rule in index.ruleset.rules}
        self.variant_guards = {
            label: [self.instant.guards(variant.rule, self.reading, self.true) for variant in each]
            for label, each in variants.items()
            if each
        }
        """For each variant of a rule, the literals that its clauses decide now."""
        self.occurred = {
            law.left: self.formula.fresh()
            for law in index.relations
            if isinstance(law, EventRelation) and law.relation == "happenBefore"
        }
        self.active: dict[int, int] = {self.now: self.true}
        """For a node, the literal that something of this time is pending."""
        self.lasting = {
            relation_key(law): (law, self.formula.fresh(), self._node())
            for law in index.relations
            if isinstance(law, Lasting)
        }
        for law, active, node in self.lasting.values():
            self._pending_since(node, active, None if law.duration is None else last_second(law.duration))
        self._present: dict[tuple[str, int, bool], int] = {}
        self._pending: dict[tuple[str, Obligation], int] = {}
        self.slots: list[Slot] = []
        self.several: list[Pending] = []
        """Responses of which a history can leave several demands, none of which implies the others."""
        self.more = self.formula.fresh()
        """The literal "a slot that does not exist yet is active"."""
        for pending in pending_of(index):
            self._add_slot(pending)
            if not pending.is_single:
                self.several.append(pending)
        self._require_inputs()

    def _node(self) -> int:
        self.nodes += 1
        return self.nodes - 1

    # Slots ----------------------------------------------------------------------------------------------------

    def add_copies(self, number: int) -> list[Slot]:
        """Add this number of slots for each response of which a history can leave several demands."""
        more, self.more = self.more, self.formula.fresh()
        added = [self._add_slot(pending) for pending in self.several for _ in range(number)]
        self.add([-more, *(slot.active for slot in added), self.more])
        return added

    def _add_slot(self, pending: Pending) -> Slot:
        slot = Slot(pending, self._node(), self.formula.fresh())
        self._pending_since(slot.node, slot.active, pending.last)
        self._add_flags(slot)
        self.slots.append(slot)
        selected = self.selected[slot.rule.label]
        allowed = self._allows_inputs(slot, slot.demand)
        if allowed != self.true:
            self.add([-slot.active, -selected, allowed])
        label = slot.rule.label
        for forced in (False, True):
            present = self._present.get((label, pending.number, forced))
            if present is not None:
                self.add([-selected, -slot.active, present])
        if (label, pending.obligation) in self._pending:
            self.add([-selected, -slot.active, self._pending[label, pending.obligation]])
        return slot

    def _pending_since(self, node: int, active: int, last: int | None) -> None:
        self.active[node] = active
        self.add([-active, self.times.before(node, self.now)])
        if last is not None:
            self.add([-active, self.times.at_most(node, self.now, last)])

    def _add_flags(self, slot: Slot) -> None:
        """Variables for the atoms that occurred before now, except those that would decide the demand."""
        decisive = set(alternatives(slot.demand))
        for leaf in slot.pending.atoms:
            if (leaf in decisive and not leaf.negated) or (leaf == slot.demand):
                slot.came[leaf] = -self.true
                continue
            came = slot.came[leaf] = self.formula.fresh()
            # There must be time for it, from the instant after the trigger to now.
            self.add([-came, slot.active])
            self.add([-came, -self.times.at_most(slot.node, self.now, max(leaf.start or 0, 0))])
        self.add([-slot.active, self._can_be_met(slot, slot.demand)])

    def _can_be_met(self, slot: Slot, demand: Demand) -> int:
        """A literal that implies that the past alone does not violate a demand."""
        assert not isinstance(demand, int), "slots have no literals"
        if isinstance(demand, Occurs):
            if demand.negated:
                return -slot.came[demand]
            open_still = self.true if demand.end is None else self.times.at_most(slot.node, self.now, demand.end)
            return self.formula.any_of([slot.came[demand], open_still])
        parts = [self._can_be_met(slot, part) for part in demand.parts]
        return self.formula.every(parts) if isinstance(demand, Every) else self.formula.any_of(parts)

    # What a situation is --------------------------------------------------------------------------------------

    def _require_inputs(self) -> None:
        """Some input occurs. Each triggers a selected rule, or a condition of one names it. A clause of a triggered
        rule decides."""
        decides = []
        for event, given in self.inputs.items():
            rules = self.index.by_trigger.get(event, [])
            concerned = [*rules, *self.index.naming.get(event, ())]
            self.add([-given, *(self.selected[rule.label] for rule in concerned)])
            for rule in rules:
                speaks = self.formula.any_of(self.guards[rule.label])
                decides.append(self.formula.every([given, self.selected[rule.label], speaks]))
        self.add(decides)

    def _allows_inputs(self, slot: Slot, demand: Demand) -> int:
        """A literal that implies that no input is forbidden by a slot now."""
        assert not isinstance(demand, int), "slots have no literals"
        if isinstance(demand, Occurs):
            can_be_met = self._can_be_met(slot, demand)
            given = self.inputs.get(demand.event)
            if not demand.negated or given is None:
                return can_be_met
            bounds = self.times.within(slot.node, self.now, demand.start, demand.end)
            return self.formula.every([can_be_met, self.formula.any_of([-given, *(-bound for bound in bounds)])])
        parts = [self._allows_inputs(slot, part) for part in demand.parts]
        return self.formula.every(parts) if isinstance(demand, Every) else self.formula.any_of(parts)

    # Facts ----------------------------------------------------------------------------------------------------

    def literal(self, fact: Fact) -> int:
        """The literal of a fact."""
        kind, name, *rest = fact
        value = bool(rest[-1])
        if kind == "rule":
            literal = self.selected[str(name)]
        elif kind == "input":
            literal = self.inputs[str(name)]
        elif kind == "state":
            literal = self.instant.variables[name]  # type: ignore[index]
        elif kind == "slot":
            literal = self.slots[int(str(name))].active
        elif kind == "came":
            literal = self.slots[int(str(name))].came[rest[0]]  # type: ignore[index]
        elif kind == "gap":
            literal = self.times.at_most(name, rest[0], rest[1])  # type: ignore[arg-type]
        elif kind == "occurred":
            literal = self.occurred[str(name)]
        else:
            literal = self.lasting[str(name)][1]
        return literal if value else -literal

    def facts_of_pending(self) -> Iterator[Fact]:
        """The facts that something is pending, one for each possible pending demand."""
        yield from (("slot", number, True) for number in range(len(self.slots)))
        yield from (("lasts", key, True) for key in self.lasting)

    def nodes_of(self, fact: Fact) -> set[int]:
        """The times that only one fact mentions."""
        if fact[0] == "slot":
            return {self.slots[int(str(fact[1]))].node}
        return {self.lasting[str(fact[1])][2]} if fact[0] == "lasts" else set()

    def exclude(self, facts: Iterable[Fact]) -> None:
        """No further situation has all these facts."""
        self.add([-self.literal(fact) for fact in facts])

    def exclude_pairs(
        self,
        pairs: Iterable[tuple[str, int | None]],
        decided: Mapping[str, Sequence[tuple[int, int | None]]],
        pending: Iterable[tuple[str, Obligation]],
        forced: Collection[str],
    ) -> None:
        """No further situation has all these rules, with their clauses that decide now or decided what is pending; None
        is any. For rules whose conditions name acts, `decided` has for some of the variants the clause that decides
        now, or None, and `pending` has what is pending.

        A rule of `forced` counts wherever its clause decides if the rule is triggered now, even if it is not.
        """
        present = [self._present_literal(label, number, label in forced) for label, number in pairs]
        present += (self._decided_literal(label, tuple(one), label in forced) for label, one in decided.items())
        present += (self._pending_literal(label, obligation) for label, obligation in pending)
        self.add([-literal for literal in present])

    def _present_literal(self, label: str, number: int | None, forced: bool) -> int:
        selected = self.selected[label]
        if number is None:
            return selected
        key = label, number, forced
        if key not in self._present:
            literal = self._present[key] = self.formula.fresh()
            self.add([-selected, *self._untriggered(label, forced), -self.guards[label][number], literal])
            for slot in self.slots:
                if (slot.rule.label, slot.pending.number) == (label, number):
                    self.add([-selected, -slot.active, literal])
        return self._present[key]

    def _decided_literal(self, label: str, decided: tuple[tuple[int, int | None], ...], forced: bool) -> int:
        """A literal that these decisions of a rule that is triggered now imply."""
        literal = self.formula.fresh()
        away: list[int] = []
        for variant, number in decided:
            guards = self.variant_guards[label][variant]
            away += guards if number is None else [-guards[number]]
        self.add([-self.selected[label], *self._untriggered(label, forced), *away, literal])
        return literal

    def _pending_literal(self, label: str, obligation: Obligation) -> int:
        """A literal that is true if the demand of an obligation of a rule is pending."""
        key = label, obligation
        if key not in self._pending:
            literal = self._pending[key] = self.formula.fresh()
            for slot in self.slots:
                if (slot.rule.label, slot.pending.obligation) == key:
                    self.add([-self.selected[label], -slot.active, literal])
        return self._pending[key]

    def _untriggered(self, label: str, forced: bool) -> list[int]:
        return [] if forced else [-self.inputs[self.index.ruleset.by_label[label].trigger]]

    def facts(self) -> list[Fact]:
        """The facts of the situation of the last `find`, without those on which no slot or rule depends."""
        times, _ = self.times.schedule(self.holds, self._used())
        found: list[Fact] = [("rule", label, True) for label, s in self.selected.items() if self.holds(s)]
        found += [("input", event, self.holds(given)) for event, given in self.inputs.items()]
        found += [("state", key, self.holds(variable)) for key, variable in self.instant.state().items()]
        for number, slot in enumerate(self.slots):
            if self.holds(slot.active):
                found.append(("slot", number, True))
                flags = ((leaf, flag) for leaf, flag in slot.came.items() if flag != -self.true)
                found += [("came", number, leaf, self.holds(flag)) for leaf, flag in flags]
                found += self._age(slot.node, times)
        found += [("occurred", event, self.holds(flag)) for event, flag in self.occurred.items()]
        for key, (law, active, node) in self.lasting.items():
            found.append(("lasts", key, self.holds(active)))
            if self.holds(active) and law.duration is not None:
                found += self._age(node, times)
        return found

    def _age(self, node: int, times: dict[int, int]) -> list[Fact]:
        age = times[self.now] - times[node]
        return [("gap", node, self.now, age, True), ("gap", self.now, node, -age, True)]

    def _used(self) -> list[int]:
        return [node for node, active in self.active.items() if self.holds(active)]

    # Solving --------------------------------------------------------------------------------------------------

    def find(self, *assumed: int) -> bool:
        """Whether a situation is left, in which all these literals are true."""
        while True:
            self.instant.settle()
            self._solver.add(self.formula.clauses[self._sent :])
            self._sent = len(self.formula.clauses)
            recorder = self.index.recorder
            answer = self._solver.solve(assumed)
            if answer is None:
                raise Undecided(sentence("the solver reached its limit of conflicts"))
            if not answer:
                self.core = set(self._solver.core())
                return False
            refused = self.times.refused(self.holds, self._used())
            lemma = self.instant.measures.refused(self.holds, recorder is not None)
            refused += [] if lemma is None else [lemma]
            if not refused:
                return True
            self.formula.clauses += refused

    def find_least(self, *assumed: int) -> bool:
        """The same as `find`, with as few active slots as possible."""
        if not self.find(*assumed):
            return False
        inactive = [-slot.active for slot in self.slots if not self.holds(slot.active)]
        for active in [slot.active for slot in self.slots if self.holds(slot.active)]:
            if self.find(*assumed, *inactive, -active):
                inactive.append(-active)
        return self.find(*assumed, *inactive)

    def holds(self, literal: int) -> bool:
        return self._solver.holds(literal)


def state_formulas(index: TraceIndex) -> Iterator[Condition]:
    """All formulas over conditions and measures that decide anything at one instant."""
    for rule in index.ruleset.rules:
        yield from index.formulas(rule)
    for relation in index.relations:
        if isinstance(relation, Lasting) or not isinstance(relation, EventRelation):
            yield from (f for f in formulas_of_relation(relation) if _is_about_state(f))


def _is_about_state(formula: Condition) -> bool:
    return not any(isinstance(leaf, Atom) and leaf.kind != "condition" for leaf in leaves(formula))
