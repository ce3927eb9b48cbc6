"""The indices of a ruleset that questions about traces need, each made once, in time linear in the ruleset."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from typing import TypeVar

from sleec_runtime.model import (
    RELATIONS,
    Agent,
    Assume,
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
)
from sleec_verify.encoding.relations import Relation, events_of
from sleec_verify.encoding.solver import Recorder
from sleec_verify.encoding.trace_scope import Untimed, responses_of
from sleec_verify.encoding.window_lengths import WindowLengths
from sleec_verify.query.memo import Memo
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.traces.demands import Occurs, Responses, occurrences
from sleec_verify.traces.event_conditions import named_events, with_states
from sleec_verify.traces.relations import Name, names_of_relation, names_of_rule, relation_key, required_events

_Indexed = TypeVar("_Indexed", Rule, Relation)


class TraceIndex(Memo):
    """A ruleset under one meaning of responses without a window. `recorder` receives every question."""

    def __init__(
        self,
        ruleset: Ruleset,
        untimed: Untimed = "at",
        recorder: Recorder | None = None,
        whole: TraceIndex | None = None,
    ) -> None:
        """`whole` is the ruleset that this is a part of."""
        super().__init__()
        self.ruleset = ruleset
        self.whole = whole
        if whole is not None:
            self.mere_inputs = whole.mere_inputs
            self.never_in_response = whole.never_in_response
        self.untimed = untimed
        self.recorder = recorder
        self.responses = Responses(untimed, self.lengths)
        self._windows: dict[str, list[Occurs]] = {}
        self._names_ahead: dict[str, tuple[Name, ...]] = {}
        self.impossible: dict[frozenset[str], frozenset[str]] = {}
        """The events that never occur under the counting rules and relations (`sleec_verify.traces.induction`)."""

    @cached_property
    def stated(self) -> TraceIndex:
        """The same with states in place of the inputs that conditions name (`sleec_verify.traces.event_conditions`)."""
        ruleset = with_states(self.ruleset, self.mere_inputs)
        if ruleset is self.ruleset:
            return self
        found = TraceIndex(ruleset, self.untimed, self.recorder)
        # A part of a ruleset has no declarations.
        found.agents = self.root.agents
        found.never_in_response = self.never_in_response
        return found

    def part(self, rules: Iterable[Rule], relations: Iterable[Relation]) -> TraceIndex:
        """Some of the rules and relations. Events keep their roles in the whole ruleset."""
        kept = sorted((*rules, *relations), key=lambda statement: statement.span)
        measures = tuple(self.ruleset.measures.values())
        ruleset = replace(self.ruleset, statements=tuple(kept), inferred=measures)
        return TraceIndex(ruleset, self.untimed, self.recorder, self)

    @property
    def root(self) -> TraceIndex:
        """The ruleset that this is a part of, directly or through other parts."""
        return self if self.whole is None else self.whole.root

    @property
    def rules(self) -> tuple[Rule, ...]:
        return self.ruleset.rules

    def windows(self, rule: Rule) -> list[Occurs]:
        """Every atom that a rule can demand. Raises `Undecided` if the length of a window has no bounds."""
        found = self._windows.get(rule.label)
        if found is None:
            found = self._windows[rule.label] = [
                atom for clause in rule.clauses() for atom in self.atoms(clause.obligations)
            ]
        return found

    def names_ahead(self, rule: Rule) -> tuple[Name, ...]:
        """The events of a rule's responses, and the events, conditions and measures that decide what it requires."""
        found = self._names_ahead.get(rule.label)
        if found is None:
            events = (("event", response.name) for response in responses_of(rule))
            found = self._names_ahead[rule.label] = tuple(dict.fromkeys((*events, *names_of_rule(rule))))
        return found

    def atoms(self, obligations: tuple[Obligation, ...]) -> Iterator[Occurs]:
        """Every atom that obligations can demand. Raises `Undecided` if the length of a window has no bounds."""
        return occurrences(self.responses.of(obligations, lambda inner: [1] * _members(inner)))

    def formulas(self, rule: Rule) -> Iterator[Formula]:
        """The conditions that decide what a rule requires: guards, hedges, and those of the lengths of its windows.

        Raises `Undecided` if the length of a window has no bounds.
        """
        yield from formulas_of(rule)
        for clause in rule.clauses():
            yield from self.lengths.formulas(clause)

    @cached_property
    def lengths(self) -> WindowLengths:
        """The windows for each value of the measures that give their lengths."""
        return WindowLengths(self.ruleset, self._stated_relations) if self.whole is None else self.whole.lengths

    @cached_property
    def _stated_relations(self) -> list[Relation]:
        return [s for s in self.ruleset.statements if isinstance(s, (*RELATIONS, Exclusive, Never, Assume))]

    @cached_property
    def relations(self) -> list[Relation]:
        """Relations and constraints, in the order of the text. One whose duration depends on measures is one relation
        for each of their values, if these have bounds."""
        return [one for relation in self._stated_relations for one in self.lengths.of_relation(relation)]

    @cached_property
    def relation_by_key(self) -> dict[str, Relation]:
        return {relation_key(relation): relation for relation in self.relations}

    @cached_property
    def by_trigger(self) -> dict[str, list[Rule]]:
        return _index((rule.trigger, rule) for rule in self.ruleset.rules)

    @cached_property
    def naming(self) -> dict[str, list[Rule]]:
        """The rules with a guard or a hedge that names an event."""
        return _index((event, rule) for rule in self.ruleset.rules for event in named_events(rule))

    @cached_property
    def obliging(self) -> dict[str, list[Rule]]:
        """The rules with a response, at any depth, that obliges an event."""
        return self._responding(negated=False)

    @cached_property
    def forbidding(self) -> dict[str, list[Rule]]:
        """The rules with a response, at any depth, that forbids an event."""
        return self._responding(negated=True)

    def _responding(self, negated: bool) -> dict[str, list[Rule]]:
        return _index((o.name, rule) for rule in self.ruleset.rules for o in responses_of(rule) if o.negated == negated)

    @cached_property
    def relations_of_name(self) -> dict[Name, list[tuple[str, Relation]]]:
        """The relations that mention an event, condition or measure, with their keys."""
        found: dict[Name, list[tuple[str, Relation]]] = {}
        for key, relation in self.relation_by_key.items():
            for name in dict.fromkeys(names_of_relation(relation)):
                found.setdefault(name, []).append((key, relation))
        return found

    @cached_property
    def relations_of_event(self) -> dict[str, list[Relation]]:
        return _index((event, relation) for relation in self.relations for event in events_of(relation))

    @cached_property
    def is_cyclic(self) -> bool:
        """Whether a response can lead back to its own trigger, also through other rules and relations."""
        graph: TopologicalSorter[str] = TopologicalSorter()
        for rule in self.ruleset.rules:
            graph.add(rule.trigger, *(o.name for o in responses_of(rule) if not o.negated))
        for relation in self.relations:
            for event in required_events(relation):
                for other in events_of(relation):
                    if other != event:
                        graph.add(other, event)
        try:
            graph.prepare()
        except CycleError:
            return True
        return False

    @cached_property
    def agents(self) -> dict[str, Agent]:
        """The agent of each event of a rule: the declared one; otherwise the robot if a response names the event,
        and the environment if not."""
        found: dict[str, Agent] = {}
        for statement in self.ruleset.statements:
            if isinstance(statement, Declaration) and statement.agent is not None:
                found.update(dict.fromkeys(statement.names, statement.agent))
        for rule in self.ruleset.rules:
            for response in responses_of(rule):
                found.setdefault(response.name, "system")
        for rule in self.ruleset.rules:
            for event in (rule.trigger, *named_events(rule)):
                found.setdefault(event, "environment")
        return found

    @cached_property
    def mere_inputs(self) -> frozenset[str]:
        """The events that only the environment causes (docs/times.md)."""
        return frozenset(event for event, agent in self.agents.items() if agent == "environment")

    @cached_property
    def never_in_response(self) -> frozenset[str]:
        """The mere inputs that no rule requires, or that a condition names. Others that a rule requires make no
        conflict by themselves: the check `required-input` reports the rule."""
        return self.mere_inputs - (self.obliging.keys() - self.naming.keys())


def trace_index_of(index: RulesetIndex) -> TraceIndex:
    """The same ruleset, for questions about traces."""
    return index.once(_trace_index)


def _trace_index(index: RulesetIndex) -> TraceIndex:
    return TraceIndex(index.ruleset, index.untimed, index.recorder)


def _members(clause: Clause) -> int:
    return sum(1 for _ in in_text_order(clause))


def _index(pairs: Iterable[tuple[str, _Indexed]]) -> dict[str, list[_Indexed]]:
    """The values of each key, each once, in their order."""
    index: dict[str, list[_Indexed]] = {}
    for key, value in pairs:
        values = index.setdefault(key, [])
        if not values or values[-1] is not value:
            values.append(value)
    return index
