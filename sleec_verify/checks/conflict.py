"""Situations in which what is due cannot all be done: every distinct cause, each in a smallest situation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from sleec_runtime.model import Exclusive, Formula, Not, Obligation, Rule, Span
from sleec_verify.checks.base import Check, FindingKind, clause_at, clause_name, guard_at, listed
from sleec_verify.clashes import Clash, clashes, opposite
from sleec_verify.cone import Cones, Place
from sleec_verify.equation import conjunction
from sleec_verify.finding import ClauseRef, Finding, Witness
from sleec_verify.question import Question
from sleec_verify.witness import smallest_situation

MOST, MOST_PER_RULE = 1_000, 3
"""How many causes are listed: so many, and so many more for each rule. Contradicting clauses multiply, and a ruleset
with more has one problem, not millions."""

Cause = tuple[Place, ...]
"""A minimal set of clauses that clash, in the order of the text."""


class Enough(Exception):
    """As many causes are found as are listed, and there may be more."""


def all_clashes(cones: Cones) -> list[Clash]:
    """Every minimal set of literals that cannot be due together and that the rules can oblige."""
    obliged = cones.by_obligation
    direct = [
        Clash(frozenset((literal, opposite(literal))))
        for literal in obliged
        if not literal.negated and opposite(literal) in obliged
    ]
    return direct + clashes(cones.constraints, obliged)


def _conflicts(cones: Cones) -> Iterator[Finding]:
    """Unsatisfiable exactly when a set of clauses is no cause: the guards of the clauses, and the situation in which
    their literals clash. A model is a conflicting context."""
    causes: dict[Cause, list[tuple[Clash, Witness]]] = {}
    found = all_clashes(cones)
    parts = _Parts(found)
    most = MOST + MOST_PER_RULE * len(cones.rules)
    try:
        for clash in found:
            for cause in _covers(cones, clash):
                situation = _situation(cones, cause, clash, parts)
                if situation is None or not _possible(cones, cause, situation):
                    continue
                witness = smallest_situation(cones, situation)
                assert witness is not None, "the cause is possible"
                causes.setdefault(cause, []).append((clash, witness))
                if len(causes) >= most:
                    raise Enough(f"the first {most} causes are listed; there may be more")
    finally:
        yield from (_finding(cones, cause, shown) for cause, shown in sorted(causes.items()))


def _covers(cones: Cones, clash: Clash) -> Iterator[Cause]:
    """The minimal sets of clauses, one at most of each rule, that oblige every literal of the clash."""
    literals = sorted(clash.literals, key=str)
    seen: set[Cause] = set()

    def extend(chosen: tuple[Place, ...], covered: frozenset[Obligation]) -> Iterator[tuple[Place, ...]]:
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


class _Parts:
    """The clashes by their literals, to find those that a part of a cause gives already."""

    def __init__(self, found: list[Clash]) -> None:
        self._by_literal: dict[Obligation | None, list[Clash]] = {}
        for clash in found:
            for literal in clash.literals or (None,):
                self._by_literal.setdefault(literal, []).append(clash)

    def within(self, literals: set[Obligation]) -> Iterator[Clash]:
        """Every clash that these literals hold."""
        for literal in (None, *literals):
            yield from (clash for clash in self._by_literal.get(literal, ()) if clash.literals <= literals)


def _situation(cones: Cones, cause: Cause, clash: Clash, parts: _Parts) -> Formula | None:
    """Where the clauses decide together and clash, and no part of them clashes already. None if a part always does."""
    conjuncts = [guard_at(cones, place) for place in cause]
    if clash.labels:
        conjuncts.append(clash.situation)
    for place in cause:
        for smaller in parts.within(_obliged(cones, (other for other in cause if other != place))):
            if not smaller.labels:
                return None
            if smaller != clash:
                conjuncts.append(Not(smaller.situation))
    return conjunction(list(dict.fromkeys(conjuncts)))


def _possible(cones: Cones, cause: Cause, situation: Formula) -> bool:
    with Question(cones) as question:
        for place in cause:
            question.require(question.guards(place.rule)[place.number])
        question.require_formula(situation)
        return question.ask()


def conflict_in(cones: Cones, active: Iterable[Place], here: Iterable[Clash], witness: Witness) -> Iterator[Finding]:
    """The conflicts of one context: `active` are the clauses that decide there, `here` the declared clashes that its
    situation allows to come true."""
    by_literal: dict[Obligation, Place] = {}
    for place in active:
        for literal in clause_at(cones, place).obligations:
            by_literal.setdefault(literal, place)
    direct = [Clash(frozenset((o, opposite(o)))) for o in by_literal if not o.negated and opposite(o) in by_literal]
    causes: dict[Cause, list[tuple[Clash, Witness]]] = {}
    for clash in (*direct, *here):
        if all(literal in by_literal for literal in clash.literals):
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
