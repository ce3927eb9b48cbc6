"""Situations in which what is due cannot all be done: every distinct cause, each in a smallest situation."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import chain
from math import prod

from sleec_runtime.model import Exclusive, Formula, Not, Obligation, Rule, Span
from sleec_verify.budget import spend
from sleec_verify.checks.base import Check, FindingKind, clause_at, clause_name, guard_at, listed
from sleec_verify.checks.each import each
from sleec_verify.clashes import Clash, Clashes, Exclusion, opposite
from sleec_verify.cone import Cones, Place
from sleec_verify.equation import conjunction
from sleec_verify.finding import ClauseRef, Finding, Witness
from sleec_verify.question import Question
from sleec_verify.witness import smallest_situation

MOST, MOST_PER_RULE = 1_000, 3
"""How many causes are listed: so many, and so many more for each rule. Contradicting clauses multiply, and a ruleset
with more has one problem, not millions."""

MANY_WAYS = 16
"""Ways to oblige the literals of a clash with which it is asked first whether any of them is possible."""

PER_ATTEMPT = 8
"""Steps of a budget for one attempt to complete a cause."""

Cause = tuple[Place, ...]
"""A minimal set of clauses that clash, in the order of the text."""


class Enough(Exception):
    """As many causes are found as are listed, and there may be more."""


def _conflicts(cones: Cones) -> Iterator[Finding]:
    """Unsatisfiable exactly when a set of clauses is no cause: the guards of the clauses, and the situation in which
    their literals clash. A model is a conflicting context."""
    causes: dict[Cause, list[tuple[Clash, Witness]]] = {}
    most = MOST + MOST_PER_RULE * len(cones.rules)

    def look(at: tuple[Cause, Clash]) -> tuple[Finding, ...]:
        cause, clash = at
        situation = _situation(cones, cause, clash)
        if situation is None or not _possible(cones, cause, situation):
            return ()
        witness = smallest_situation(cones, situation)
        if witness is not None:
            causes.setdefault(cause, []).append((clash, witness))
            if len(causes) >= most:
                raise Enough(f"the first {most} causes are listed; there may be more")
        return ()

    try:
        yield from each(_candidates(cones), look)
    finally:
        yield from (_finding(cones, cause, shown) for cause, shown in sorted(causes.items()))


def _candidates(cones: Cones) -> Iterator[tuple[str, tuple[Cause, Clash]]]:
    """The clashes, each with every set of clauses that may be its cause, and the rules of these."""
    found = cones.clashes
    pairs = (pair for exclusion in found.exclusions for pair in _due_together(cones, exclusion))
    for clash in chain(found.listed, pairs):
        ways = prod(len(cones.by_obligation[literal]) for literal in clash.literals)
        if ways > MANY_WAYS and not _all_due(cones, clash):
            continue
        for cause in _covers(cones, clash):
            rules = dict.fromkeys(cones.rules[place.rule].label for place in cause)
            yield listed(rules) if rules else "the constraints", (cause, clash)


def _all_due(cones: Cones, clash: Clash) -> bool:
    """Whether all literals of a clash are due in some situation."""
    rules = {place.rule for literal in clash.literals for place in cones.by_obligation[literal]}
    with Question(cones) as question:
        return question.ask(*question.due(sorted(rules), clash.literals).values())


def _due_together(cones: Cones, exclusion: Exclusion) -> Iterator[Clash]:
    """The pairs of an exclusion that may be due in some situation: all pairs of a literal that is due with another one.
    One formula, satisfiable exactly when there is a further such literal. A model shows one."""
    rules = {place.rule for literal in exclusion.literals for place in cones.by_obligation[literal]}
    with Question(cones) as question:
        encoder = question.encoder
        due = question.due(sorted(rules), set(exclusion.literals))
        counting = {literal: encoder.fresh() for literal in due}
        several = encoder.at_least_two([encoder.both(due[literal], counting[literal]) for literal in due])
        while question.ask(several):
            one = next(
                literal for literal in counting if question.true(due[literal]) and question.true(counting[literal])
            )
            question.exclude(counting.pop(one))
            yield from (exclusion.clash(one, other) for other in counting)


def _covers(cones: Cones, clash: Clash) -> Iterator[Cause]:
    """The minimal sets of clauses, one at most of each rule, that oblige every literal of the clash."""
    literals = sorted(clash.literals, key=str)
    seen: set[Cause] = set()

    def extend(chosen: tuple[Place, ...], covered: frozenset[Obligation]) -> Iterator[tuple[Place, ...]]:
        spend(PER_ATTEMPT)
        missing = next((literal for literal in literals if literal not in covered), None)
        if missing is None:
            yield chosen
            return
        for place in cones.by_obligation[missing]:
            # Two clauses of one rule never decide together.
            if all(place.rule != other.rule for other in chosen):
                yield from extend((*chosen, place), covered.union(clause_at(cones, place).obligations))

    for chosen in extend((), frozenset()):
        cause = tuple(sorted(chosen))
        if cause not in seen and _minimal(cones, cause, clash.literals):
            seen.add(cause)
            yield cause


def _minimal(cones: Cones, cause: Cause, literals: frozenset[Obligation]) -> bool:
    return not any(literals <= _obliged(cones, (other for other in cause if other != place)) for place in cause)


def _obliged(cones: Cones, places: Iterable[Place]) -> set[Obligation]:
    return set(chain.from_iterable(clause_at(cones, place).obligations for place in places))


def _situation(cones: Cones, cause: Cause, clash: Clash) -> Formula | None:
    """Where the clauses decide together and clash, and no part of them clashes already. None if a part always does."""
    conjuncts = [guard_at(cones, place) for place in cause]
    if clash.labels:
        conjuncts.append(clash.situation)
    for place in cause:
        for smaller in cones.clashes.among(_obliged(cones, (other for other in cause if other != place))):
            if not smaller.labels:
                return None
            if smaller != clash:
                conjuncts.append(Not(smaller.situation))
    return conjunction(list(dict.fromkeys(conjuncts)))


def _possible(cones: Cones, cause: Cause, situation: Formula) -> bool:
    """Whether the clauses decide together, by a question that can be recorded. Without recorder and assumptions, the
    search for a smallest situation answers it."""
    if cones.recorder is None and not cones.assumptions:
        return True
    with Question(cones) as question:
        for place in cause:
            question.require(question.guards(place.rule)[place.number])
        question.require_formula(situation)
        return question.ask()


def conflict_in(
    cones: Cones, active: Iterable[Place], declared: Clashes, true: Collection[Formula], witness: Witness
) -> Iterator[Finding]:
    """The conflicts of one context: `active` are the clauses that decide there, `declared` the clashes of constraints,
    `true` the labels of these that its situation makes true."""
    by_literal: dict[Obligation, Place] = {}
    for place in active:
        for literal in clause_at(cones, place).obligations:
            by_literal.setdefault(literal, place)
    direct = [Clash(frozenset((o, opposite(o)))) for o in by_literal if not o.negated and opposite(o) in by_literal]
    causes: dict[Cause, list[tuple[Clash, Witness]]] = {}
    for clash in (*direct, *declared.among(by_literal)):
        if clash.labels <= set(true):
            cause = tuple(sorted({by_literal[literal] for literal in clash.literals}))
            causes.setdefault(cause, []).append((clash, witness))
    for cause, shown in sorted(causes.items()):
        yield _finding(cones, cause, shown)


def _finding(cones: Cones, cause: Cause, shown: list[tuple[Clash, Witness]]) -> Finding:
    rules = [cones.rules[place.rule] for place in cause]
    at_odds = sorted({literal.name for clash, _ in shown for literal in clash.literals})
    origins = [origin for clash, _ in shown for origin in clash.origins]
    names = [clause_name(rule, place.number) for rule, place in zip(rules, cause)]
    spans = [clause_at(cones, place).span for place in cause] + [origin.span for origin in origins]
    notes = [f"{name}: {listed(str(o) for o in clause_at(cones, p).obligations)}" for name, p in zip(names, cause)]
    witness = min((witness for _, witness in shown), key=lambda w: len(w.triggers) + len(w.conditions))
    return CONFLICT.finding(
        f"{_subject(names)}: {'; '.join(dict.fromkeys(_reason(cones, clash) for clash, _ in shown))}",
        spans[0],
        rules=tuple(dict.fromkeys(rule.label for rule in rules)),
        clauses=tuple(ClauseRef(rule.label, place.number) for rule, place in zip(rules, cause)),
        obligations=tuple(at_odds),
        witness=witness,
        note="; ".join(notes) or None,
        help=_help(rules),
        related=tuple(_related(spans[1:], cause, names, origins)),
    )


def _help(rules: list[Rule]) -> str:
    if not rules:
        return "mend the constraints, or ASSUME that the situation cannot be"
    if len(rules) == 1:
        return "mend the response, or ASSUME that the situation cannot be"
    return "decide which should give way, and say so with a hedge; or ASSUME that the situation cannot be"


def _subject(names: list[str]) -> str:
    if not names:
        return "the constraints cannot all be kept"
    if len(names) == 1:
        return f"{names[0]} cannot be kept"
    return f"{listed(names)} cannot {'both' if len(names) == 2 else 'all'} be kept"


def _reason(cones: Cones, clash: Clash) -> str:
    positive = sorted(o.name for o in clash.literals if not o.negated)
    negative = sorted(o.name for o in clash.literals if o.negated)
    if not clash.origins:
        return f"{positive[0]} is due and forbidden at once"
    due = [f"{listed(positive)} {'is' if len(positive) == 1 else 'are'} due"] if positive else []
    due += [f"{listed(negative)} {'is' if len(negative) == 1 else 'are'} forbidden"] if negative else []
    place = cones.ruleset.source.place
    lines = [
        f"the {'EXCLUSIVE' if isinstance(origin, Exclusive) else 'NEVER'} of line {place(origin.span).line}"
        for origin in clash.origins
    ]
    rule = "rules" if len(lines) == 1 else "rule"
    return f"{' and '.join(due)}, and {listed(lines)} {rule} that out" if due else f"{listed(lines)} {rule} out any way"


def _related(
    spans: list[Span], cause: Cause, names: list[str], origins: Sequence[object]
) -> Iterator[tuple[Span, str]]:
    words = names[1:] if cause else []
    words += ["the constraint"] * (len(spans) - len(words))
    yield from zip(spans, words)


CONFLICT = Check(
    "conflict",
    "Is there a situation in which what is due cannot all be done?",
    (
        FindingKind(
            "SLEEC101",
            "error",
            "rules that cannot be kept together",
            "In the situation shown, what the named clauses oblige is at odds: a thing is due and forbidden at once, "
            "or an EXCLUSIVE or NEVER comes true. A robot in this situation must break a rule, and nobody has decided "
            "which. The clauses are a minimal set: without any one of them there is no conflict.",
            "Decide which gives way and say so with a hedge (UNLESS), or state with ASSUME that the situation cannot "
            "be.",
            "RULE privacy\nWHEN CurtainOpenRequest THEN OpenCurtains\nUNLESS UserUndressed IN WHICH CASE "
            "NOT OpenCurtains\nRULE air\nWHEN CurtainOpenRequest AND RoomStuffy THEN OpenCurtains\n",
            "RULE privacy\nWHEN CurtainOpenRequest THEN OpenCurtains\nUNLESS UserUndressed IN WHICH CASE "
            "NOT OpenCurtains\nRULE air\nWHEN CurtainOpenRequest AND RoomStuffy THEN OpenWindow\n",
        ),
    ),
    _conflicts,
)
