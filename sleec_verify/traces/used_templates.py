"""The templates of a refutation as evidence: each with a situation that it fits, after a lawful history, so that an
evaluator of traces can confirm that the continuation complies with the rules there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from sleec_runtime.model import Clause, Rule
from sleec_verify.encoding.budget import as_far_as_decided, share
from sleec_verify.results.conflict_freedom import Example, LaterInstant, UsedTemplate
from sleec_verify.traces.demands import conjuncts
from sleec_verify.traces.histories import Histories
from sleec_verify.traces.pending_demands import Pending
from sleec_verify.traces.situations import Fact, Situations
from sleec_verify.traces.templates import Later, Template
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.traces.trivial_responses import contested_obligations

PART = 1 / 10
"""The part of the budget that examples may spend."""


def used_templates(
    situations: Situations, templates: Iterable[tuple[Template, int, tuple[Fact, ...]]]
) -> tuple[UsedTemplate, ...]:
    """The templates, each given with the literal that leaves only the situations that it does not fit, and the facts of
    a situation that it fits, if one is known."""
    found = []
    with share(PART):
        for template, defeat, facts in templates:
            example = None
            with as_far_as_decided():
                example = _example(situations, template, defeat, facts)
            later = tuple(_instant(_name(situations, node), one) for node, one in template.later)
            policies = tuple(
                (_response(pending), tuple(_instant("its trigger", one) for one in plan))
                for pending, plan in template.policies
            )
            found.append(UsedTemplate(tuple(sorted(template.acts)), later, policies, example))
    return tuple(found)


def _instant(after: str, later: Later) -> LaterInstant:
    return LaterInstant(after, later.seconds, later.events, dict(sorted(later.state)))


def _name(situations: Situations, node: int) -> str:
    """The time of a node, in words."""
    if node == situations.now:
        return "now"
    for slot in situations.slots:
        if slot.node == node:
            return _response(slot.pending)
    return next(key for key, (_, _, own) in situations.lasting.items() if own == node)


def _response(pending: Pending) -> str:
    return f"{pending.rule.label}.{pending.number} {pending.obligation}"


# Examples -----------------------------------------------------------------------------------------------------


def _example(s: Situations, template: Template, defeat: int, origin: tuple[Fact, ...]) -> Example | None:
    """A situation that the template fits, with its continuation there, if one is found at once."""
    if s.index.stated is not s.index:
        return None
    for assumed in _choices(s, template, origin):
        if not s.find(-s.more, *assumed):
            continue
        facts, continuation = s.facts(), _continuation(s, template)
        rules = [rule for rule in s.index.rules if s.holds(s.selected[rule.label])]
        values = s.instant.values(s.holds)
        inactive = [slot.active for slot in s.slots if not s.holds(slot.active)]
        others = [literal for label, literal in s.selected.items() if not s.holds(literal)]
        same = (*map(s.literal, facts), *(-literal for literal in (*inactive, *others)))
        if continuation is None or s.find(defeat, *same):
            continue
        histories = Histories(s, facts, [rule.label for rule in rules])
        if histories.exist():
            moments, now = histories.history()
            events, later = continuation
            instants = [*moments, TraceInstant(now, events, values)]
            instants += (TraceInstant(now + time, one.events, dict(sorted(one.state))) for time, one in later)
            return Example(tuple(contested_rule(s, rule) for rule in rules), tuple(instants), len(moments))
    return None


def _choices(s: Situations, template: Template, origin: tuple[Fact, ...]) -> Iterator[list[int]]:
    """Assumptions about a situation: that it is the one in which the template was found; that something is pending for
    each instant of the template; that nothing is; that some input occurs."""
    if origin:
        yield [s.literal(fact) for fact in origin]
    without_policies = [-slot.active for slot in s.slots if template.policy(slot.pending)]
    yield [*without_policies, *(s.active[node] for node, _ in template.later)]
    yield [-active for active in s.active.values() if active != s.true]
    yield from ([*without_policies, given] for given in s.inputs.values())


def _continuation(s: Situations, template: Template) -> tuple[frozenset[str], list[tuple[int, Later]]] | None:
    """The continuation of a template in the situation of the last `find`: the events of now, and the later instants
    with their times after now. None if a policy applies."""
    if any(s.holds(slot.active) and template.policy(slot.pending) for slot in s.slots):
        return None
    active = [node for node, literal in s.active.items() if s.holds(literal)]
    times, _ = s.times.schedule(s.holds, active)
    later = [(times[node] - times[s.now] + one.seconds, one) for node, one in template.later if node in active]
    return _events_now(s, template.acts), later


def _events_now(s: Situations, acts: frozenset[str]) -> frozenset[str]:
    """The inputs, `acts`, and what the selected rules require at once."""
    events = {event for event, given in s.inputs.items() if s.holds(given)} | acts
    required = [
        (rule.trigger, what.event)
        for rule in s.index.rules
        if s.holds(s.selected[rule.label])
        for clause, guard in zip(rule.clauses(), s.guards[rule.label])
        if s.holds(guard)
        for what in conjuncts(s.index.responses.of(contested_obligations(s.index, clause), _undecided))
        if what.is_immediate and not what.negated and what.event not in s.index.never_in_response
    ]
    grew = True
    while grew:
        fresh = {event for trigger, event in required if trigger in events} - events
        events |= fresh
        grew = bool(fresh)
    return frozenset(events)


def _undecided(clause: Clause) -> list[int]:
    """A literal for each clause of a separate chain, of which nothing is known."""
    return [1] * sum(1 for _ in _members(clause))


def _members(clause: Clause) -> Iterator[Clause]:
    yield clause
    for hedge in clause.hedges:
        yield from _members(hedge)


def contested_rule(s: Situations, rule: Rule) -> Rule:
    """A rule without the responses that can always be met."""

    def reduced(clause: Clause) -> Clause:
        obligations = contested_obligations(s.index, clause)
        return replace(clause, obligations=obligations, hedges=tuple(map(reduced, clause.hedges)))

    return replace(rule, default=reduced(rule.default), hedges=tuple(map(reduced, rule.hedges)))
