"""Situations in which not all obligations can be met: every distinct cause, each with a smallest situation.

Rules without time, relations and chains are checked on situations (`checks.untimed_conflicts`), the others on
traces (`traces.conflicts`). Both yield the same kind of finding in the same words.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Formula, Obligation, Rule, Span, literals
from sleec_verify.checks.base import Check, FindingKind, clause_at
from sleec_verify.checks.conflict_wording import (
    both_sides,
    exclusion,
    help_for,
    reason,
    rejection,
    sides_in_words,
    subject,
)
from sleec_verify.checks.questions import ask_each
from sleec_verify.checks.relevant_rules import kind_of, relation_in_words
from sleec_verify.checks.untimed_conflicts import Cause, Enough, causes
from sleec_verify.encoding.budget import Undecided
from sleec_verify.encoding.trace_scope import responses_of
from sleec_verify.query.inconsistent_sets import InconsistentSet, InconsistentSets, opposite
from sleec_verify.query.ruleset_index import ClausePosition, InstantIndex, RulesetIndex
from sleec_verify.results.conflict_freedom import FreeComponent
from sleec_verify.results.finding import ClauseRef, Finding, Witness
from sleec_verify.results.found_trace import FoundTrace
from sleec_verify.traces.partition import partition_of
from sleec_verify.wording.phrases import clause_name, listed, quoted
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_verify.encoding.relations import Relation
    from sleec_verify.results.timeline import Timeline
    from sleec_verify.traces.conflicts import Conflict, Pair
    from sleec_verify.traces.index import TraceIndex
    from sleec_verify.traces.trace import TraceInstant


def _conflicts(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each distinct conflict."""
    parts = partition_of(index)
    if parts.traces is None:
        yield from _of_situations(index, parts.situations)
        return
    from sleec_verify.traces.components import at_one_instant

    traces = parts.traces
    found = components_over_time(index)
    rest = at_one_instant(index, parts)
    named = [(listed(quoted(rule.label) for rule in component.rules), component) for component in found]

    incomplete: list[str] = []

    def of(component: TraceIndex | None) -> Iterator[Finding]:
        return _of_situations(index, rest) if component is None else _of_traces(traces, component, incomplete)

    yield from ask_each([("the rules without time", None), *named], of)
    _refer_to_others(incomplete)


def components_over_time(index: RulesetIndex) -> list[TraceIndex]:
    """The components of a ruleset whose conflicts can need more than one instant, a chain or a relation."""
    from sleec_verify.traces.components import components, needs_traces

    traces = partition_of(index).traces
    # A component of these rules without windows is about situations, too.
    return [] if traces is None else [component for component in components(traces) if needs_traces(component)]


def conflicts_over_time(index: RulesetIndex, component: TraceIndex) -> Iterator[Finding]:
    """A finding for each conflict of one of the `components_over_time`. Raises `Undecided` or `Enough` after the last
    conflict that could be decided."""
    traces = partition_of(index).traces
    assert traces is not None, "it has a component"
    incomplete: list[str] = []
    yield from _of_traces(traces, component, incomplete)
    _refer_to_others(incomplete)


def _refer_to_others(incomplete: Sequence[str]) -> None:
    if incomplete:
        raise Enough(
            sentence(
                "there may be further conflicts of {incomplete} with more rules",
                incomplete=listed(map(quoted, incomplete)),
            )
        )


def _of_situations(whole: RulesetIndex, index: InstantIndex) -> Iterator[Finding]:
    """The conflicts of some rules at one instant, in the words of the whole ruleset. Raises `Undecided` after the last
    one if some are not confirmed."""
    positions = dict(whole.labelled())
    rejected = []
    for cause, shown in causes(index):
        places = tuple(ClausePosition(positions[index.rules[place.rule].label], place.number) for place in cause)
        finding = _finding(whole, places, shown)
        if _is_confirmed(whole, finding):
            yield finding
        else:
            rejected.append(rejection(finding))
    if rejected:
        raise Undecided(joined("; ", rejected))


def _is_confirmed(index: RulesetIndex, finding: Finding) -> bool:
    if not index.ruleset.is_timed:
        return True
    from sleec_verify.replay.conflicts import is_confirmed_at_once

    return is_confirmed_at_once(index, finding)


def _of_traces(whole: TraceIndex, component: TraceIndex, incomplete: list[str]) -> Iterator[Finding]:
    """The conflicts of a component. Adds to `incomplete` the rules of conflicts that may be part of others."""
    from sleec_verify.replay.conflicts import is_confirmed
    from sleec_verify.traces.conflicts import ConflictSearch

    search = ConflictSearch(component)
    rejected = []
    for conflict in search.find():
        finding = _of_trace(whole, conflict)
        if not is_confirmed(whole, conflict):
            rejected.append(rejection(finding))
            continue
        if whole.recorder is not None:
            instants = (*conflict.history, conflict.now)
            found = FoundTrace(
                whole.root.ruleset,
                "conflict",
                conflict.pairs,
                instants,
                now=len(conflict.history),
                inputs=conflict.now.events,
            )
            whole.recorder.found(found)
            for one in conflict.responses:
                response = found._replace(shows="response", instants=one.instants, rules=one.rules, now=one.now)
                whole.recorder.found(response)
        yield finding
    if rejected:
        raise Undecided(joined("; ", rejected))
    if whole.recorder is not None and search.templates is not None:
        labels = tuple(rule.label for rule in component.rules)
        whole.recorder.conflict_free(FreeComponent(whole.root.ruleset, labels, search.templates))
    if search.may_be_more:
        incomplete += (label for label in search.chained if label not in incomplete)


def conflict_in(
    index: RulesetIndex,
    active: Iterable[ClausePosition],
    declared: InconsistentSets,
    true: Collection[Formula],
    witness: Witness,
) -> Iterator[Finding]:
    """The conflicts of one context. `active` are the clauses that decide there, `declared` the inconsistent sets of
    constraints, and `true` the labels of these that hold in the situation."""
    by_literal: dict[Obligation, ClausePosition] = {}
    for place in active:
        for literal in clause_at(index, place).obligations:
            by_literal.setdefault(literal, place)
    direct = [
        InconsistentSet(frozenset((o, opposite(o)))) for o in by_literal if not o.negated and opposite(o) in by_literal
    ]
    causes: dict[Cause, list[tuple[InconsistentSet, Witness]]] = {}
    for clash in (*direct, *declared.among(by_literal)):
        if clash.labels <= set(true):
            cause = tuple(sorted({by_literal[literal] for literal in clash.literals}))
            causes.setdefault(cause, []).append((clash, witness))
    for cause, shown in sorted(causes.items()):
        yield _finding(index, cause, shown)


class _Deciding(NamedTuple):
    """A clause of a conflict: its rule and number, its name for messages, and its place in the text."""

    rule: Rule
    number: int
    name: str
    span: Span

    @property
    def obligations(self) -> tuple[Obligation, ...]:
        return list(self.rule.clauses())[self.number].obligations


def _finding(index: RulesetIndex, cause: Cause, shown: list[tuple[InconsistentSet, Witness]]) -> Finding:
    clauses = [
        _Deciding(rule, place.number, clause_name(rule, place.number), clause_at(index, place).span)
        for place in cause
        for rule in [index.rules[place.rule]]
    ]
    origins = [origin for clash, _ in shown for origin in clash.origins]
    return _conflict(
        clauses,
        joined("; ", dict.fromkeys(reason(index.ruleset, clash) for clash, _ in shown)),
        sorted({literal.name for clash, _ in shown for literal in clash.literals}),
        [(origin.span, sentence("the constraint")) for origin in origins],
        min((witness for _, witness in shown), key=lambda w: len(w.triggers) + len(w.conditions)),
    )


def conflict_over_time(
    traces: TraceIndex, pairs: tuple[Pair, ...], now: TraceInstant, relations: tuple[str, ...]
) -> Finding:
    """The finding of a conflict in one situation, with nothing pending: the rules with the clauses that decide, what
    occurs now, and the keys of the relations that matter."""
    from sleec_verify.encoding.solver import Refutation
    from sleec_verify.traces.conflicts import Conflict

    return _of_trace(traces, Conflict(pairs, (), now, relations, frozenset(), Refutation((), ()), ()))


def _of_trace(traces: TraceIndex, conflict: Conflict) -> Finding:
    from sleec_verify.replay.timeline import timeline_of
    from sleec_verify.traces.conflicts import LATER
    from sleec_verify.traces.trivial_responses import cannot_be_met

    rules = traces.ruleset.by_label
    now = conflict.now
    clauses = []
    # A rule that is triggered now comes first.
    for pair in sorted(conflict.pairs, key=lambda pair: rules[pair.rule].trigger not in now.events):
        rule = rules[pair.rule]
        if pair.clause == LATER:
            span = rule.heading_span
            clauses.append(_Deciding(rule, LATER, clause_name(rule, 0), span))
        else:
            span = list(rule.clauses())[pair.clause].span
            clauses.append(_Deciding(rule, pair.clause, clause_name(rule, pair.clause), span))
    # A relation whose duration a measure gives has a key for each value.
    relations = list({one.span: one for one in map(traces.relation_by_key.__getitem__, conflict.relations)}.values())
    required, forbidden = _sides(clauses)
    ends_early = any(cannot_be_met(traces, one.rule) for one in clauses)
    at_odds = _at_odds(relations, required, forbidden, now.events)
    is_instant = not conflict.history and not any(one.number == LATER for one in clauses)
    is_instant = is_instant and all(_is_immediate(traces, one) for one in clauses)
    labels = [one.rule.label for one in clauses]
    return _conflict(
        clauses,
        _reason_of_trace(traces, relations, required, forbidden, at_odds, ends_early),
        sorted(at_odds),
        [(relation.span, sentence("the {kind}", kind=kind_of(relation))) for relation in relations],
        Witness(tuple(sorted(now.events)), now.conditions),
        path=_path(traces, conflict),
        timeline=None if is_instant else timeline_of(traces, [*conflict.history, now], len(conflict.history), labels),
    )


def _is_immediate(traces: TraceIndex, clause: _Deciding) -> bool:
    """Whether all obligations of a clause concern only the instant of its trigger."""
    return all(atom.is_immediate for atom in traces.atoms(clause.obligations))


def _sides(clauses: Iterable[_Deciding]) -> tuple[set[str], set[str]]:
    """The events that the clauses of a conflict require, and those that they forbid."""
    sides: dict[bool, set[str]] = {False: set(), True: set()}
    for one in clauses:
        # Without a number, any clause of the rule may decide.
        every = list(one.rule.clauses())
        for clause in every if one.number < 0 else [every[one.number]]:
            for response in literals(clause):
                sides[response.negated].add(response.name)
    return sides[False], sides[True]


def _at_odds(
    relations: Sequence[Relation], required: set[str], forbidden: set[str], given: Collection[str]
) -> set[str]:
    from sleec_verify.encoding.relations import events_of

    related = {event for relation in relations for event in events_of(relation)}
    at_odds = (required | forbidden) & related if relations else forbidden & (required | set(given))
    return at_odds or required


def _reason_of_trace(
    traces: TraceIndex,
    relations: Sequence[Relation],
    required: set[str],
    forbidden: set[str],
    at_odds: set[str],
    ends_early: bool,
) -> str:
    if relations:
        due = sides_in_words(sorted(at_odds & required), sorted(at_odds & forbidden))
        return exclusion(due, [relation_in_words(traces.ruleset, relation) for relation in relations])
    names = sorted(at_odds & forbidden & required)
    if names:
        return both_sides(names)
    names = sorted(at_odds & forbidden)
    if names:
        return plural(
            len(names),
            "{names} occurs but is forbidden",
            "{names} occur but are forbidden",
            names=listed(map(quoted, names)),
        )
    if ends_early:
        return sentence(
            "{required} is required in a window that ends before it begins",
            required=listed(map(quoted, sorted(required))),
        )
    return sentence(
        "{required} would have to occur again and again without end", required=listed(map(quoted, sorted(required)))
    )


def _path(traces: TraceIndex, conflict: Conflict) -> str:
    """How the response triggers rules of the conflict: ``because `TurnOnLight` triggers rule `dark_rooms` ``."""
    rules = [traces.ruleset.by_label[label] for label in conflict.rules]
    occurred = {event for moment in (*conflict.history, conflict.now) for event in moment.events}
    steps = [
        sentence("{trigger} triggers rule {rule}", trigger=quoted(rule.trigger), rule=quoted(rule.label))
        for rule in rules
        if rule.trigger not in occurred
        and any(o.name == rule.trigger and not o.negated for other in rules for o in responses_of(other))
    ]
    return sentence(" because {steps}", steps=listed(steps)) if steps else ""


def _conflict(
    clauses: Sequence[_Deciding],
    reason: str,
    at_odds: Sequence[str],
    origins: Sequence[tuple[Span, str]],
    witness: Witness,
    path: str = "",
    timeline: Timeline | None = None,
) -> Finding:
    spans = [*((one.span, one.name) for one in clauses), *origins]
    obliging = [one for one in clauses if one.number >= 0 and one.obligations]
    notes = [
        sentence(
            "{clause}: {obligations}", clause=one.name, obligations=quoted(" AND ".join(map(str, one.obligations)))
        )
        for one in obliging
    ]
    rules = list(dict.fromkeys(one.rule.label for one in clauses))
    return CONFLICT.finding(
        sentence("{subject}{path}: {reason}", subject=subject([one.name for one in clauses]), path=path, reason=reason),
        spans[0][0],
        rules=tuple(rules),
        clauses=tuple(ClauseRef(one.rule.label, one.number) for one in clauses if one.number >= 0),
        obligations=tuple(at_odds),
        witness=witness,
        note=joined("; ", notes) or None,
        help=help_for(rules),
        related=tuple(spans[1:]),
        timeline=timeline,
    )


CONFLICT = Check(
    "conflict",
    "Is there a situation in which the rules contradict each other?",
    (
        FindingKind(
            "SLEEC101",
            "error",
            "rules that contradict each other",
            "In the situation shown, the named rules and exceptions contradict each other: something is both required "
            "and forbidden, or an EXCLUSIVE or NEVER is violated. A robot in this situation must break a rule, and "
            "nobody has decided which one. The named clauses are a minimal set: without any one of them there is no "
            "conflict. If a response triggers another rule, the finding says so. If more than one moment matters, a "
            "timeline shows what happens.",
            "Choose which rule wins, and add an exception (UNLESS) to the other. If the situation cannot occur, "
            "exclude it with ASSUME.",
            "RULE privacy\nWHEN CurtainOpenRequest THEN OpenCurtains\nUNLESS UserUndressed IN WHICH CASE "
            "NOT OpenCurtains\nRULE air\nWHEN CurtainOpenRequest AND RoomStuffy THEN OpenCurtains\n",
            "RULE privacy\nWHEN CurtainOpenRequest THEN OpenCurtains\nUNLESS UserUndressed IN WHICH CASE "
            "NOT OpenCurtains\nRULE air\nWHEN CurtainOpenRequest AND RoomStuffy THEN OpenWindow\n",
        ),
    ),
    _conflicts,
)
