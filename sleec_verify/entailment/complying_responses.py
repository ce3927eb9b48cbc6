"""The responses that comply with the rules in one situation, with time: the question of the check `conflict`
(docs/times.md) for one situation after which nothing is pending.

The events of the situation occur now, with the values of now. The robot's response is any other events of now that are
not mere inputs, and any later events and values. Events that the relations put before those of the situation have
occurred.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import combinations

from sleec_runtime.model import Context, EventRelation
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.window_lengths import measures_of_lengths
from sleec_verify.traces.demands import Occurs
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.induction import InductiveModel
from sleec_verify.traces.situations import state_formulas
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.sentence import sentence

MOST_INPUTS = 6
"""The most events of a situation whose subsets are looked at."""

MOST_CONFLICTS = 8
"""The most conflicts of one situation that are looked for."""


class ComplyingResponses:
    """The responses in one situation. `index` has the rules and relations that can matter."""

    def __init__(self, index: TraceIndex, context: Context, left_out: Collection[str] = ()) -> None:
        """`left_out` are the keys of relations that do not count, because the situation itself violates them."""
        self.index = index
        self.context = context
        self.relations = [key for key in index.relation_by_key if key not in left_out]
        self.preceding = frozenset(
            law.left
            for law in index.relations
            if isinstance(law, EventRelation) and law.relation == "happenBefore" and law.right in context.triggers
        )
        model = self._model = InductiveModel(index)
        true = model.formula.true
        model.past.occurred = lambda event: true if event in self.preceding else -true
        lengths = {name for rule in index.rules for clause in rule.clauses() for name in measures_of_lengths(clause)}
        missing = frozenset(index.ruleset.measures) - set(context.conditions) - lengths
        self._now = model.instant(true, missing=missing)
        model.after = self._now
        instant = model.instants[self._now]
        for formula in state_formulas(index):
            instant.literal(formula)
        # Ordering measures adds variables, which the situation gives values.
        instant.settle()
        self._given = instant.assumptions(context)

    def complies(self, rules: Collection[str], inputs: Collection[str], *required: int) -> bool:
        """Whether a response to the events `inputs` complies with some rules. Raises `Undecided`."""
        event = self._model.instants[self._now].event
        literals = [event(name) for name in sorted(inputs)]
        literals += [-event(name) for name in sorted(self.index.mere_inputs - frozenset(inputs))]
        return self._model.ask(*self._given, *literals, *required, counting=[*rules, *self.relations])

    def never(self, event: str, negated: bool = False) -> int:
        """The literal "the event does not occur now", or, if `negated`, "it occurs now"."""
        return self._model.occurs(self._now, Occurs(event, 0, 0, not negated))

    def trace(self) -> tuple[TraceInstant, ...]:
        """The trace of the last answer, which was yes: now, and what follows. Times count from now."""
        model = self._model
        times, _ = model.schedule()
        nodes = sorted((node for node in model.used() if node in model.instants), key=lambda node: times[node])
        now, *later = (model.at(node, times[node] - times[self._now]) for node in nodes)
        measures = {n: v for n, v in now.conditions.items() if not isinstance(v, bool)}
        return (now._replace(conditions={**measures, **self.context.conditions}), *later)

    def blocking_relations(self) -> list[str]:
        """The keys of the relations in the core of the last answer, which was no."""
        relations = set(self.relations)
        return [key for key in self._model.matter() if key in relations]

    def conflicts(self) -> Iterator[tuple[frozenset[str], tuple[str, ...]]]:
        """The events and the rules of conflicts in the situation: minimal sets of rules that no response to these
        events complies with.

        A rule that forbids an event that the situation has anyway, whatever the relations say, contradicts no rule and
        is in none of these sets, unless the event concerns it. Raises `Undecided`.
        """
        events = sorted(self.context.triggers & {*self.index.by_trigger, *self.index.naming})
        if len(events) > MOST_INPUTS:
            raise Undecided(sentence("too many events occur at once"))
        labels = list(self.index.ruleset.by_label)
        found: list[tuple[str, ...]] = []
        for size in range(len(events), 0, -1):
            for inputs in map(frozenset, combinations(events, size)):
                if not self.complies([], inputs):
                    continue
                for rules in self._minimal(labels, inputs):
                    is_known = any(set(other) <= set(rules) for other in found)
                    if not is_known and (inputs <= self._concerning(rules) or self._needs_relations(rules, inputs)):
                        found.append(rules)
                        yield inputs, rules
                        if len(found) == MOST_CONFLICTS:
                            return

    def _concerning(self, labels: Collection[str]) -> frozenset[str]:
        """The triggers of some rules, and the events that their conditions name."""
        named = {e for e, rules in self.index.naming.items() if any(rule.label in labels for rule in rules)}
        return frozenset(named).union(self.index.ruleset.by_label[label].trigger for label in labels)

    def _needs_relations(self, rules: Collection[str], inputs: frozenset[str]) -> bool:
        """Whether a response complies with some rules if no relation counts."""
        every, self.relations = self.relations, []
        try:
            return self.complies(rules, inputs)
        finally:
            self.relations = every

    def _minimal(self, rules: Collection[str], inputs: frozenset[str]) -> Iterator[tuple[str, ...]]:
        """The minimal sets of these rules that no response complies with (hitting set tree; R. Reiter, "A theory of
        diagnosis from first principles", Artificial Intelligence 32, 1987)."""
        seen: set[frozenset[str]] = set()
        found: set[tuple[str, ...]] = set()
        waiting = [frozenset(rules)]
        while waiting and len(found) < MOST_CONFLICTS:
            some = waiting.pop(0)
            if some in seen or self.complies(some, inputs):
                continue
            seen.add(some)
            kept = [label for label in rules if label in some]
            for label in list(kept):
                less = [other for other in kept if other != label]
                if not self.complies(less, inputs):
                    kept = less
            if tuple(kept) not in found:
                found.add(tuple(kept))
                yield tuple(kept)
            waiting += [some - {label} for label in kept]

    def needed_relations(self, rules: Collection[str], inputs: Collection[str]) -> tuple[str, ...]:
        """The keys of a minimal set of relations with which no response complies with some rules."""
        every = self.relations
        try:
            for key in list(every):
                less = [other for other in self.relations if other != key]
                kept, self.relations = self.relations, less
                if self.complies(rules, inputs):
                    self.relations = kept
            return tuple(self.relations)
        finally:
            self.relations = every
