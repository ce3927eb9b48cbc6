"""The questions that one trace answers: is there a trace that satisfies the rules and has this property?"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import NamedTuple

from sleec_runtime.model import Claim, Formula, Length, Rule
from sleec_verify.encoding.budget import begin
from sleec_verify.encoding.mentioned_names import add_claim
from sleec_verify.encoding.relations import events_of
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.trace_scope import responses_of
from sleec_verify.results.found_trace import FoundTrace, Shows
from sleec_verify.traces.cone import cone
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.induction import InductiveModel
from sleec_verify.traces.known_traces import known_traces
from sleec_verify.traces.model import TraceModel
from sleec_verify.traces.relations import names_in, names_of_rule
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.phrases import quoted

What = Callable[[TraceModel, int], Sequence[int]]
"""A function from a model and an instant of it to literals that state the question about the instant."""


class Answer(NamedTuple):
    """`trace` is an example, or None if there is none. Then `matter` is a minimal set of rules and relations that
    prevent it, by labels and keys."""

    trace: tuple[TraceInstant, ...] | None
    matter: tuple[str, ...] = ()
    model: TraceModel | None = None

    def conclude(self, what: str) -> Answer:
        """Record the answer no, as one that decides. `what` is what it shows."""
        if self.model is not None:
            self.model.conclude(what)
        return self


class _Shown(NamedTuple):
    """What a trace shows, about which rule or claim, clause, and rule without a hedge."""

    shows: Shows
    label: str
    number: int | None = None
    changed: Rule | None = None


def find_violation(index: TraceIndex, rule: Rule) -> Answer:
    """A trace that violates `rule` and satisfies everything else. Without one, the rule is redundant."""
    shown = _Shown("violation", rule.label)
    answer = _ask(_about(index, [rule]), shown, lambda model, at: [_broken(model, at, rule)], but=rule)
    return answer.conclude(f"no trace violates {quoted(rule.label)} and nothing else")


def find_difference(index: TraceIndex, rule: Rule, number: int, without: Rule) -> Answer:
    """A trace that violates `rule`, and satisfies everything if `without` is in its place: the rule without its hedge
    `number`. Or the reverse."""
    first = _violation_of_one(index, rule, without, _Shown("violation-with-hedge", rule.label, number, without))
    if first.trace is not None:
        return first
    second = _violation_of_one(index, without, rule, _Shown("violation-without-hedge", rule.label, number, without))
    if second.trace is None:
        hedge = f"hedge {number} of {quoted(rule.label)}"
        first.conclude(f"no trace violates something only with {hedge}")
        second.conclude(f"no trace violates something only without {hedge}")
    return second


def _violation_of_one(index: TraceIndex, rule: Rule, other: Rule, shown: _Shown) -> Answer:
    """A trace that violates `rule`, and satisfies everything with `other` (of the same trigger and label) in its
    place."""
    part = _about(index, [rule, other])
    exchanged = [r for r in part.by_trigger[rule.trigger] if r.label != rule.label]
    rules = {**part.by_trigger, rule.trigger: [*exchanged, other]}
    return _ask(part, shown, lambda model, at: [_broken(model, at, rule)], rules=rules)


def find_trigger(index: TraceIndex, rule: Rule) -> Answer:
    """A trace in which `rule` is triggered and its guard holds. Without one, the rule is vacuous."""
    answer = _ask(
        _about(index, [rule]),
        _Shown("trigger", rule.label),
        lambda model, at: [model.instants[at].event(rule.trigger), model.condition(at, rule.guard)],
    )
    return answer.conclude(f"no trace triggers {quoted(rule.label)} without a violation")


def find_decision(index: TraceIndex, rule: Rule, clause: int) -> Answer:
    """An instant at which a clause of `rule` decides, in a trace that satisfies the relations but not necessarily
    the rules."""
    shown = _Shown("decision", rule.label, clause)
    answer = _ask(_about(index, [rule]), shown, lambda model, at: [model.guards(at, rule)[clause][1]], rules={})
    return answer.conclude(f"clause {clause} of {quoted(rule.label)} decides in no trace")


def find_application(index: TraceIndex, rule: Rule) -> Answer:
    """An instant at which `rule` applies, as `find_decision` of any clause. Without one, the rule is dead."""
    matter: list[str] = []
    for number, _ in enumerate(rule.clauses()):
        answer = find_decision(index, rule, number)
        if answer.trace is not None:
            return answer
        matter += answer.matter
    return Answer(None, tuple(dict.fromkeys(matter)))


def is_constrained(index: TraceIndex, rule: Rule) -> bool:
    """Whether relations or constraints of events can affect where `rule` applies."""
    return any(any(events_of(relation)) for relation in _about(index, [rule]).relations)


def find_claim(index: TraceIndex, claim: Claim) -> Answer:
    """A trace in which a concern or purpose occurs. Its `meanwhile` may occur at any instant."""

    events: set[str] = set()
    formulas: list[Formula] = []
    lengths: list[Length] = []
    add_claim(claim, events, formulas, lengths)
    names = [name for formula in formulas for name in names_in(formula)]
    names += [("measure", measure) for length in lengths for measure in length.measures]
    answer = _ask(
        cone(index, events, names), _Shown(claim.kind, claim.label), lambda model, at: claim_occurs(model, at, claim)
    )
    return answer.conclude(f"the {claim.kind} {quoted(claim.label)} occurs in no trace without a violation")


def claim_occurs(model: TraceModel, at: int, claim: Claim) -> list[int]:
    """Literals that together imply that a concern or purpose occurs at an instant, and its `meanwhile` at any."""

    def at_instant(at: int, part: Claim) -> list[int]:
        return [
            model.instants[at].event(part.event),
            model.condition(at, part.condition),
            *(
                model.demand(at, model.index.responses.of_clause(response, model.chain(at)))
                for response in part.responses
            ),
        ]

    required = at_instant(at, claim)
    for part in _parts(claim)[1:]:
        required.append(model.exists(lambda other, part=part: model.formula.every(at_instant(other, part))))  # type: ignore[misc]
    return required


def _parts(claim: Claim) -> list[Claim]:
    return [claim, *(() if claim.meanwhile is None else _parts(claim.meanwhile))]


def _about(index: TraceIndex, rules: Sequence[Rule]) -> TraceIndex:
    """The cone of the question about some rules."""
    events = {event for rule in rules for event in (rule.trigger, *(o.name for o in responses_of(rule)))}
    return cone(index, sorted(events), [name for rule in rules for name in names_of_rule(rule)])


def _broken(model: TraceModel, at: int, rule: Rule) -> int:
    """A literal that implies that an instant triggers a rule and its response is not met."""
    return model.formula.any_of(
        [
            model.formula.every([guard, model.demand(at, model.due(at, clause.obligations, kept=False))])
            for clause, guard in model.guards(at, rule)
            if clause.obligations
        ]
    )


def _ask(
    index: TraceIndex,
    shown: _Shown,
    what: What,
    but: Rule | None = None,
    rules: Mapping[str, Sequence[Rule]] | None = None,
) -> Answer:
    """Whether some trace has an instant with the property `what`. The rule `but` does not count; `rules` replace those
    of the ruleset.

    Raises `Undecided`.
    """
    begin()
    asked = FoundTrace(index.root.ruleset, shown.shows, ((shown.label, shown.number),), (), shown.changed)
    known = known_traces() if index.recorder is None else None
    if known is not None:
        found = known.still_shown(asked, index.untimed)
        if found is not None:
            return Answer(tuple(TraceInstant(*instant) for instant in found.instants))
    model = InductiveModel(index) if rules is None else TraceModel(index, rules)
    required = list(what(model, model.instant(model.formula.true)))
    counting = [rule.label for rule in index.rules if rule is not but] + list(index.relation_by_key)
    if model.ask(*required, counting=counting):
        trace = _trace(model)
        if index.recorder is not None:
            index.recorder.found(asked._replace(instants=trace))
        if known is not None:
            known.remember(asked._replace(instants=trace))
        return Answer(trace)
    return Answer(None, tuple(_minimal(model, required)), model)


def _minimal(model: TraceModel, required: Sequence[int]) -> list[str]:
    """A minimal set of rules and relations with which the last answer is still no."""
    kept = model.matter()
    for key in list(kept):
        less = [other for other in kept if other != key]
        with suppress(Undecided):
            if not model.ask(*required, counting=less):
                kept = less
    return kept


def _trace(model: TraceModel) -> tuple[TraceInstant, ...]:
    times, _ = model.schedule()
    instants = sorted((node for node in model.used() if node in model.instants), key=lambda node: times[node])
    begin = times[instants[0]]
    return tuple(model.at(node, times[node] - begin) for node in instants)
