"""Rules that can be triggered, but only where the rules conflict."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.model import Atom, Obligation
from sleec_verify.checks.base import Check, FindingKind, listed, literals_of
from sleec_verify.checks.conflict import all_clashes
from sleec_verify.clashes import Clash
from sleec_verify.cone import Cones, names_of_rule
from sleec_verify.equation import conjunction
from sleec_verify.finding import Finding
from sleec_verify.question import Question
from sleec_verify.witness import smallest_situation


def _vacuous(cones: Cones) -> Iterator[Finding]:
    """Unsatisfiable exactly when the rule is vacuous: it is triggered, and nothing that is due clashes. A model is a
    situation in which the rule can be kept."""
    by_literal: dict[Obligation | None, list[Clash]] = {}
    for clash in all_clashes(cones):
        by_literal.setdefault(min(clash.literals, key=str, default=None), []).append(clash)
    for position, rule in enumerate(cones.rules):
        group = cones.together_with(rule.trigger)
        if not _vacuous_among(cones, position, group, by_literal):
            continue
        for other in list(group):
            rest = [kept for kept in group if kept != other]
            if other != position and _vacuous_among(cones, position, rest, by_literal):
                group = rest
        others = [cones.rules[other].label for other in group if other != position]
        triggered = [Atom("trigger", rule.trigger), *([] if rule.guard is None else [rule.guard])]
        yield VACUOUS_CONFLICT.finding(
            f"{rule.label} can be triggered, but never without a conflict",
            rule.label_span if rule.labelled else rule.span,
            rules=(rule.label, *others),
            # Whatever the measures are there is a conflict, but each must be something.
            witness=smallest_situation(cones, conjunction(triggered), _measures(cones, group)),
            note=f"it always meets {listed(others)}" if others else None,
            help="the findings of the conflict check say what is at odds; no situation is left in which to keep it",
        )


def _measures(cones: Cones, group: Sequence[int]) -> set[str]:
    named = {name for position in group for _, name in names_of_rule(cones.rules[position])}
    return named & set(cones.ruleset.measures)


def _vacuous_among(
    cones: Cones, position: int, group: Sequence[int], by_literal: dict[Obligation | None, list[Clash]]
) -> bool:
    due = {literal for other in group for literal in literals_of(cones.clauses[other])}
    relevant = [c for literal in (None, *due) for c in by_literal.get(literal, ()) if c.literals <= due]
    if not relevant:
        return False
    with Question(cones) as question:
        encoder = question.encoder
        literals = question.due(group, due)
        for clash in relevant:
            question.require(*(-literals[o] for o in clash.literals), -encoder.literal(clash.situation))
        kept = encoder.any_of(question.guards(position))
        question.require(kept)
        if question.ask():
            return False
    with Question(cones) as question:
        return question.ask(question.encoder.any_of(question.guards(position)))


VACUOUS_CONFLICT = Check(
    "vacuous-conflict",
    "Can every rule that is triggered somewhere be kept somewhere?",
    (
        FindingKind(
            "SLEEC102",
            "error",
            "a rule that is triggered only in situations that conflict",
            "The rule can be triggered, but in each such situation what is due cannot all be done. There is no way to "
            "keep it: it is written down and never lived by.",
            "RULE open\nWHEN UserAsks THEN OpenDoor\nRULE shut\nWHEN UserAsks THEN NOT OpenDoor\n",
            "RULE open\nWHEN UserAsks THEN OpenDoor\nUNLESS NightTime IN WHICH CASE NOT OpenDoor\n",
        ),
    ),
    _vacuous,
)
