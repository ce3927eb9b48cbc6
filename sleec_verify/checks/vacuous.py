"""Rules that can be triggered, but only where the rules conflict."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.model import Atom, Never, Obligation
from sleec_verify.checks.base import Check, FindingKind, listed, literals_of
from sleec_verify.checks.conflict import all_clashes
from sleec_verify.clashes import Clash
from sleec_verify.cone import Cones, names_in, names_of_rule
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
    groups: dict[str, tuple[list[int], list[Clash]]] = {}
    for position, rule in enumerate(cones.rules):
        if rule.trigger not in groups:
            groups[rule.trigger] = _at_stake(cones, rule.trigger, by_literal)
        group, at_stake = groups[rule.trigger]
        others = _always_met(cones, position, group, at_stake) if at_stake else None
        if others is None:
            continue
        labels = [cones.rules[other].label for other in others]
        triggered = [Atom("trigger", rule.trigger), *([] if rule.guard is None else [rule.guard])]
        yield VACUOUS_CONFLICT.finding(
            f"{rule.label} can be triggered, but never without a conflict",
            rule.label_span if rule.labelled else rule.span,
            rules=(rule.label, *labels),
            # Whatever the measures are there is a conflict, but each must be something.
            witness=smallest_situation(cones, conjunction(triggered), _measures(cones, [position, *others])),
            note=f"it always meets {listed(labels)}" if labels else None,
            help="the findings of the conflict check say what is at odds; no situation is left in which to keep it",
        )


def _measures(cones: Cones, group: Sequence[int]) -> set[str]:
    """The measures that decide these rules, or the constraints."""
    named = {name for position in group for _, name in names_of_rule(cones.rules[position])}
    named.update(n for c in cones.constraints if isinstance(c, Never) for _, n in names_in(c.formula))
    return named & set(cones.ruleset.measures)


def _at_stake(
    cones: Cones, trigger: str, by_literal: dict[Obligation | None, list[Clash]]
) -> tuple[list[int], list[Clash]]:
    """The clashes that the rules active with `trigger` can come to, and those of the rules that oblige part of one."""
    group = cones.together_with(trigger, keeping=True)
    due = {literal for other in group for literal in literals_of(cones.clauses[other])}
    # In an order, so that the same rules make the same clauses.
    found = [c for literal in (None, *sorted(due, key=str)) for c in by_literal.get(literal, ()) if c.literals <= due]
    part = {literal for clash in found for literal in clash.literals}
    return [other for other in group if not part.isdisjoint(literals_of(cones.clauses[other]))], found


def _always_met(cones: Cones, position: int, group: Sequence[int], clashes: Sequence[Clash]) -> list[int] | None:
    """A minimal set of other rules with which the rule conflicts wherever it is triggered, or None if it can be kept
    somewhere, or is triggered nowhere."""
    with Question(cones) as question:
        encoder = question.encoder
        # A rule speaks only if it is let in, so that the solver's core names the rules that matter.
        let_in = {other: encoder.fresh() for other in group if other != position}
        literals = encoder.due(
            (clause, encoder.both(guard, let_in[other]) if other != position else guard)
            for other in {*group, position}
            for clause, guard in zip(cones.clauses[other], question.guards(other))
        )
        for clash in clashes:
            question.require(
                *(-literals[o] for o in sorted(clash.literals, key=str)), -encoder.literal(clash.situation)
            )
        triggered = encoder.any_of(question.guards(position))
        if question.ask(triggered, *let_in.values()):
            return None
        core = set(question.core())
        needed = [other for other, literal in let_in.items() if literal in core]
        for other in list(needed):
            without = [kept for kept in needed if kept != other]
            if not question.ask(triggered, *(let_in[kept] for kept in without)):
                needed = without
    with Question(cones) as question:
        return needed if question.ask(question.encoder.any_of(question.guards(position))) else None


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
            "Look at the conflicts that are reported with it: one of them holds wherever the rule is triggered. "
            "Narrow the guard of this rule or of the other, or give one of them a hedge for the case of both.",
            "RULE open\nWHEN UserAsks THEN OpenDoor\nRULE shut\nWHEN UserAsks THEN NOT OpenDoor\n",
            "RULE open\nWHEN UserAsks THEN OpenDoor\nUNLESS NightTime IN WHICH CASE NOT OpenDoor\n",
        ),
    ),
    _vacuous,
)
