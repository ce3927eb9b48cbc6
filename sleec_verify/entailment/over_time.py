"""The answer in one situation for rules with windows, alternatives, relations, chains or conditions that name events.

It is the question of the check `conflict` for this situation, with nothing pending: is there a response that complies
with the rules, and what do all of them contain? Both are confirmed by the evaluator of traces: a response that complies
by its trace, and that none complies by the traces of all responses. What is not confirmed is unknown.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import combinations

from sleec_runtime.errors import WrongType
from sleec_runtime.model import (
    RELATIONS,
    Assume,
    Clause,
    Context,
    EventRelation,
    MeasureRelation,
    Obligation,
    Rule,
    Ruleset,
    Statement,
    obligation_text,
)
from sleec_verify.checks.conflict import conflict_over_time
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.trace_scope import Untimed, responses_of
from sleec_verify.entailment.active_clauses import active_clauses
from sleec_verify.entailment.answer import ActiveClause, Alternative, Entailment
from sleec_verify.entailment.complying_responses import ComplyingResponses
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.enumerated_responses import complies, none_complies
from sleec_verify.results.finding import Finding
from sleec_verify.traces.cone import cone
from sleec_verify.traces.conflicts import LATER, Pair
from sleec_verify.traces.index import TraceIndex, trace_index_of
from sleec_verify.traces.relations import names_of_relation, names_of_rule
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import sentence

MOST_OPEN = 4
"""The most acts that conditions name and that responses may have or not."""


def over_time(ruleset: Ruleset, context: Context, answer: Entailment, untimed: Untimed) -> Entailment:
    """The answer for rules with time. `answer` has the active clauses of the situation."""
    index = RulesetIndex(ruleset, untimed=untimed)
    whole = trace_index_of(index)
    part = cone(whole, context.triggers, ())
    if not _needs_traces(part, untimed):
        return answer
    acts = sorted(set(part.naming) - part.mere_inputs - context.triggers)
    about = {name for finding in answer.conflicts for name in finding.obligations}
    if answer.conflicts and not acts and untimed == "at" and about.isdisjoint(context.triggers):
        # They contradict each other at once, whatever else the robot does. If what they contradict each other about
        # occurs already, one of the rules forbids an input, which is no contradiction of rules.
        return answer
    try:
        return _Situation(whole, part, context, answer).answered(acts)
    except Undecided as error:
        return replace(_stated(answer), consistent=None, conflicts=(), undecided=str(error))


def _needs_traces(part: TraceIndex, untimed: Untimed) -> bool:
    """Whether a window, an alternative, a relation, a chain or an event in a condition can matter."""
    if untimed == "eventually" or part.naming:
        return True
    responses = (response for rule in part.rules for response in responses_of(rule))
    if any(response.timing is not None or response.name in part.by_trigger for response in responses):
        return True
    return any(isinstance(one, RELATIONS) and not isinstance(one, MeasureRelation) for one in part.relations)


def _stated(answer: Entailment) -> Entailment:
    """The answer with all obligations that its active clauses state."""
    stated = {what for because in answer.because for what in because.without_choice}
    return replace(
        answer,
        obligations=tuple(sorted(what for what in stated if not what.startswith("NOT "))),
        prohibitions=tuple(sorted(what.removeprefix("NOT ") for what in stated if what.startswith("NOT "))),
    )


class _Situation:
    """One situation, with the part of the ruleset that matters there."""

    def __init__(self, whole: TraceIndex, part: TraceIndex, context: Context, answer: Entailment) -> None:
        self._whole = whole
        self._part = part
        self._context = context
        self._answer = answer
        excluding = {one.span for one in (*answer.broken_assumptions, *answer.unsettled)}
        missing = {("measure", name) for name in part.ruleset.measures if name not in context.conditions}
        left_out = [
            key
            for key, one in part.relation_by_key.items()
            # A relation says nothing about a measure that is not given.
            if one.span in excluding or not missing.isdisjoint(names_of_relation(one))
        ]
        self._responses = ComplyingResponses(part, context, left_out)
        self._labels = [rule.label for rule in part.rules]

    def answered(self, acts: Sequence[str]) -> Entailment:
        answer, responses = self._answer, self._responses
        inputs = self._context.triggers
        if not responses.complies([], inputs):
            blocking = responses.blocking_relations()
            broken = [self._part.relation_by_key[key] for key in blocking]
            known = [one for one in broken if isinstance(one, (*RELATIONS, Assume))]
            laws = tuple(dict.fromkeys((*answer.broken_assumptions, *known)))
            return replace(_stated(answer), consistent=True, conflicts=(), broken_assumptions=laws)
        if not responses.complies(self._labels, inputs):
            conflicts = [self._conflict(events, rules) for events, rules in responses.conflicts()]
            if conflicts:
                return replace(
                    answer,
                    consistent=False,
                    obligations=(),
                    prohibitions=(),
                    consequences=(),
                    conflicts=tuple(conflicts),
                    alternatives=(),
                )
            # Rules forbid events that occur anyway: these are `at_odds`.
            return replace(_stated(answer), consistent=True, conflicts=())
        if not self._confirmed():
            raise Undecided(sentence("the evaluator rejected the response that the solver found"))
        answer = replace(_stated(self._with_acts(acts)), consistent=True, conflicts=())
        required, forbidden = set(answer.obligations), set(answer.prohibitions)
        for alternative in answer.alternatives:
            for way in alternative.options:
                for one in way:
                    said = forbidden if one.negated else required
                    if one.name not in said and self._in_every(one.name, one.negated):
                        said.add(one.name)
        return replace(answer, obligations=tuple(sorted(required)), prohibitions=tuple(sorted(forbidden)))

    def _with_acts(self, acts: Sequence[str]) -> Entailment:
        """The active clauses in every complying response, if conditions name `acts`."""
        if not acts:
            return self._answer
        if len(acts) > MOST_OPEN:
            raise Undecided(sentence("conditions name too many events that are also responses"))
        forced = frozenset(act for act in acts if self._in_every(act, False))
        possible = [act for act in acts if act not in forced and not self._in_every(act, True)]
        cases = [
            active_clauses(
                self._whole.ruleset,
                Context(self._context.triggers.union(forced, some), self._context.conditions),
            )
            for size in range(len(possible) + 1)
            for some in combinations(possible, size)
        ]
        triggered = {rule.label for rule in self._part.rules if rule.trigger in self._context.triggers}
        decide = [{(one.rule, one.clause) for one in case.because} for case in cases]
        always = set.intersection(*decide)
        first = cases[0]

        def kept(one: ActiveClause | Alternative) -> bool:
            return one.rule in triggered and (one.rule, one.clause) in always

        because = tuple(one for one in first.because if kept(one))
        windowed = {text for one in because for text in one.in_words()}
        return replace(
            self._answer,
            because=because,
            alternatives=tuple(one for one in first.alternatives if kept(one)),
            timed=tuple(one for one in first.timed if obligation_text(one) in windowed),
        )

    def _in_every(self, event: str, negated: bool) -> bool:
        """Whether the event occurs now in every complying response; `negated`: in none. Confirmed by the evaluator."""
        responses = self._responses
        if responses.complies(self._labels, self._context.triggers, responses.never(event, negated)):
            return False
        trigger = min(self._context.triggers)
        opposite = Rule("", trigger, None, Clause(None, (Obligation(event, not negated),)), ())
        return self._none_complies(self._labels, responses.relations, self._context.triggers, [opposite])

    def _confirmed(self) -> bool:
        """Whether the evaluator accepts the response that the solver found."""
        ruleset = self._ruleset(self._labels, self._responses.relations)
        return complies(ruleset, self._responses.trace(), self._part.untimed)

    def _conflict(self, events: frozenset[str], rules: tuple[str, ...]) -> Finding:
        """The finding of a conflict that the evaluator confirms. Raises `Undecided` if it does not."""
        relations = self._responses.needed_relations(rules, events)
        if not self._none_complies(rules, relations, events, ()):
            raise Undecided(
                sentence(
                    "the solver finds a contradiction of {rules}, but too many responses are possible to try them all",
                    rules=listed(map(quoted, rules)),
                )
            )
        pairs = []
        decided = {one.rule: one.clause for one in self._answer.because}
        for label in rules:
            rule = self._part.ruleset.by_label[label]
            clause = decided.get(label, LATER) if rule.trigger in events else LATER
            pairs.append(Pair(label, clause))
        names = {name for label in rules for _, name in names_of_rule(self._part.ruleset.by_label[label])}
        names |= {name for key in relations for _, name in names_of_relation(self._part.relation_by_key[key])}
        values = {name: value for name, value in self._context.conditions.items() if name in names}
        return conflict_over_time(self._whole, tuple(pairs), TraceInstant(0, events, values), relations)

    def _none_complies(
        self, labels: Collection[str], relations: Collection[str], events: frozenset[str], more: Sequence[Rule]
    ) -> bool:
        """Whether the evaluator rejects all responses to `events`."""
        ruleset = self._ruleset(labels, relations, more)
        now = TraceInstant(0, events, self._context.conditions)
        try:
            return none_complies(ruleset, [now], self._part.mere_inputs, self._part.untimed) is True
        except WrongType:
            # A measure that gives the length of a window has no value.
            return False

    def _ruleset(self, labels: Collection[str], relations: Collection[str], more: Sequence[Rule] = ()) -> Ruleset:
        """Some of the rules and relations, for the evaluator. What has occurred before now needs no predecessor."""
        spans = {self._part.relation_by_key[key].span for key in relations}
        kept: list[Statement] = [
            one
            for one in self._part.root.ruleset.statements
            if (one.label in labels if isinstance(one, Rule) else one.span in spans and not self._precedes(one))
        ]
        return replace(
            self._whole.ruleset, statements=(*kept, *more), inferred=tuple(self._whole.ruleset.measures.values())
        )

    def _precedes(self, statement: Statement) -> bool:
        return (
            isinstance(statement, EventRelation)
            and statement.relation == "happenBefore"
            and statement.left in self._responses.preceding
        )
