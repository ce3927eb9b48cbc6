"""Whether a history can go on so that every rule is followed: the question of the check `conflict` for one history."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from sleec_runtime.errors import WrongType
from sleec_runtime.model import Context, Rule, Ruleset
from sleec_verify.encoding.relations import events_of
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.trace_scope import responses_of
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.enumerated_responses import complies, none_complies
from sleec_verify.traces.cone import cone
from sleec_verify.traces.index import TraceIndex, trace_index_of
from sleec_verify.traces.induction import InductiveModel
from sleec_verify.traces.relations import names_of_relation
from sleec_verify.traces.situations import state_formulas
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.sentence import sentence


def blocked_rules(ruleset: Ruleset, history: Sequence[TraceInstant], but: Collection[str] = ()) -> tuple[str, ...]:
    """A minimal set of rules that no continuation of a history complies with, as labels; empty if there is one. The
    rules `but` do not count.

    The last instant is now, where acts can be added. A relation says nothing about conditions and measures without a
    value. In rules, these are false. Raises `Undecided`, also if the evaluator does not confirm the answer.
    """
    whole = trace_index_of(RulesetIndex(ruleset))
    part = cone(whole, (event for moment in history for event in moment.events), ())
    question = _History(part, history)
    labels = [label for label in part.ruleset.by_label if label not in but]
    if question.complies(labels):
        if not complies(question.ruleset(labels), question.trace(), part.untimed):
            raise Undecided(sentence("the evaluator rejected the response that the solver found"))
        return ()
    if not question.complies([]):
        return ()
    for label in list(labels):
        less = [other for other in labels if other != label]
        if not question.complies(less):
            labels = less
    try:
        confirmed = none_complies(question.ruleset(labels), history, part.mere_inputs, part.untimed)
    except WrongType:
        # A measure that gives the length of a window has no value.
        confirmed = None
    if confirmed is not True:
        raise Undecided(sentence("too many responses are possible to try them all"))
    return tuple(labels)


class _History:
    """The continuations of one history."""

    def __init__(self, index: TraceIndex, history: Sequence[TraceInstant]) -> None:
        self._index = index
        self._history = history
        known = set(history[-1].conditions).intersection(*(moment.conditions for moment in history))
        self._relations = [
            key
            for key, one in index.relation_by_key.items()
            if all(kind == "event" or name in known for kind, name in names_of_relation(one))
        ]
        events = {rule.trigger for rule in index.rules} | set(index.naming)
        events |= {one.name for rule in index.rules for one in responses_of(rule)}
        events |= {event for relation in index.relations for event in events_of(relation)}
        model = self._model = InductiveModel(index)
        missing = frozenset(index.ruleset.measures) - known
        self._given: list[int] = []
        self._nodes: list[int] = []
        for moment in history:
            node = model.instant(model.formula.true, missing=missing)
            instant = model.instants[node]
            is_open = moment is history[-1]
            for event in sorted(events):
                if event in moment.events:
                    self._given.append(instant.event(event))
                elif not is_open or event in index.mere_inputs:
                    self._given.append(-instant.event(event))
            for formula in state_formulas(index):
                instant.literal(formula)
            instant.settle()
            self._given += instant.assumptions(Context(moment.events, moment.conditions))
            if self._nodes:
                after = moment.time - history[0].time
                self._given += model.times.within(self._nodes[0], node, after, after)
            self._nodes.append(node)
        model.after = self._nodes[-1]

    def complies(self, rules: Collection[str]) -> bool:
        """Whether a continuation complies with some rules."""
        return self._model.ask(*self._given, counting=[*rules, *self._relations])

    def trace(self) -> list[TraceInstant]:
        """The history and the continuation of the last answer, which was yes."""
        model = self._model
        times, _ = model.schedule()
        start = self._history[0].time - times[self._nodes[0]]
        nodes = sorted((node for node in model.used() if node in model.instants), key=lambda node: times[node])
        given = dict(zip(self._nodes, self._history))
        return [_as_given(model.at(node, times[node] + start), given.get(node)) for node in nodes]

    def ruleset(self, labels: Collection[str]) -> Ruleset:
        """Some of the rules, and the relations that count, for the evaluator."""
        spans = {self._index.relation_by_key[key].span for key in self._relations}
        root = self._index.root.ruleset
        kept = [one for one in root.statements if (one.label in labels if isinstance(one, Rule) else one.span in spans)]
        return replace(root, statements=tuple(kept), inferred=tuple(root.measures.values()))


def _as_given(instant: TraceInstant, given: TraceInstant | None) -> TraceInstant:
    """An instant of a model with the values that are given for it."""
    return instant if given is None else instant._replace(conditions=given.conditions)
