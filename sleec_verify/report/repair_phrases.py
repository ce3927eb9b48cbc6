"""The effect of a repair in one line: what is lost first, and everything else that changes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.model import Atom, Never
from sleec_verify.report.difference_phrases import effect_text, extent_text, role_text
from sleec_verify.wording.phrases import grouped, in_short, listed, quoted
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Rule, Ruleset
    from sleec_verify.changes.compare import Change, ConstraintChange, Difference, Extent
    from sleec_verify.repairs.effect import Effect
    from sleec_verify.repairs.repair import Repair


def effect_in_words(repair: Repair) -> str:
    """``rule `air`, in 1 of 4 situations in which `Request` occurs: `Open` is no longer required; in the situation of
    the conflict, the rules then require `NOT Open`; nothing else changes``"""
    from sleec_verify.repairs.effect import ABOUT_CONFLICTS

    effect = repair.effect
    found = effect.difference
    is_conflict = repair.finding.check in ABOUT_CONFLICTS
    if effect.keeps_meaning and not is_conflict and not effect.conflicts.resolved:
        return sentence("the rules mean the same")
    parts = [*_losses(found)]
    parts += _of_conflict(effect, excludes=bool(found.situations)) if is_conflict else ()
    parts += _other_conflicts(effect, is_conflict)
    parts += _gains(found)
    if found.undecided:
        parts.append(sentence("the rest of the effect is unknown: {why}", why=found.undecided[0].why))
    else:
        parts.append(sentence("nothing else changes"))
    return joined("; ", dict.fromkeys(parts))


def _losses(found: Difference) -> Iterator[str]:
    """The changes that take a duty or prohibition away, with what they add in the same situations."""
    yield from _changes(found, [change for change in found.changes if change.removed])
    yield from (_of_constraint(found, one) for one in found.constraints if one.way == "removed")
    yield from (_excluded(one.extent) for one in found.situations if one.way == "removed")


def _gains(found: Difference) -> Iterator[str]:
    yield from _changes(found, [change for change in found.changes if not change.removed])
    yield from (_of_constraint(found, one) for one in found.constraints if one.way == "added")
    yield from (_allowed_again(one.extent) for one in found.situations if one.way == "added")


def _changes(found: Difference, changes: list[Change]) -> Iterator[str]:
    """Each change with its rule and situations. The rules of an ALWAYS are one statement."""
    by_words: dict[tuple[str, str], list[Change]] = {}
    for change in changes:
        by_words.setdefault((_subject(found, change), effect_text(change, lost_first=True)), []).append(change)
    for (subject, effect), same in by_words.items():
        where = (
            extent_text(same[0].extent._replace(over=()))
            if len(same) == 1
            else sentence("in situations of {number} triggers", number=len(same))
        )
        yield sentence("{subject}, {situations}: {effect}", subject=subject, situations=where, effect=effect)


def _subject(found: Difference, change: Change) -> str:
    sides = ((found.old, change.old_rule), (found.new, change.new_rule))
    for ruleset, label in sides:
        if label is not None and label in ruleset.by_label:
            return _rule(ruleset, ruleset.by_label[label])
    return sentence("rule {rule}", rule=quoted(change.old_rule or change.new_rule or ""))


def _rule(ruleset: Ruleset, rule: Rule) -> str:
    from sleec_verify.repairs.clause_names import rule_name

    return rule_name(ruleset, rule)


def _of_constraint(found: Difference, change: ConstraintChange) -> str:
    """``` `NEVER raise`, in every situation: `raise` is no longer forbidden ```"""
    side = found.old if change.way == "removed" else found.new
    return sentence(
        "{subject}, {situations}: {effect}",
        subject=quoted(side.source.in_one_line(change.constraint.span)),
        situations=extent_text(change.extent._replace(over=())),
        effect=_forbidden(change),
    )


def _forbidden(change: ConstraintChange) -> str:
    constraint, way = change.constraint, change.way
    if isinstance(constraint, Never) and isinstance(constraint.forbidden, Atom):
        return role_text(1, quoted(constraint.forbidden.name), way == "added", negated=True)
    return sentence("this is no longer forbidden") if way == "removed" else sentence("this is now forbidden")


def _of_conflict(effect: Effect, excludes: bool) -> Iterator[str]:
    """What holds in the situation of the conflict."""
    after = effect.after_conflict
    if after is not None and after.is_conflict:
        yield sentence("in the situation of the conflict, the rules still contradict each other")
    elif after is not None:
        names = dict.fromkeys(quoted(in_short(o)) for o in after.literals)
        response = listed(names) if names else sentence("nothing")
        yield sentence("in the situation of the conflict, the rules then require {response}", response=response)
    elif effect.conflicts.remaining:
        yield plural(
            effect.conflicts.remaining,
            "this conflict is resolved, and {number} other one of its rules remains",
            "this conflict is resolved, and {number} other ones of its rules remain",
        )
    elif not excludes:
        yield sentence("the conflict is resolved")


def _other_conflicts(effect: Effect, is_conflict: bool) -> Iterator[str]:
    number = effect.conflicts.resolved
    if number and is_conflict:
        yield plural(number, "{number} other conflict is resolved", "{number} other conflicts are resolved")
    elif number:
        yield plural(number, "{number} conflict is resolved", "{number} conflicts are resolved")


def _allowed_again(extent: Extent | None) -> str:
    if extent is None or extent.affected is None or extent.possible is None:
        return sentence("an unknown number of situations is allowed again")
    return plural(
        extent.affected,
        "{affected} of {possible} situations is allowed again",
        "{affected} of {possible} situations are allowed again",
        affected=grouped(extent.affected),
        possible=grouped(extent.possible),
    )


def _excluded(extent: Extent | None) -> str:
    if extent is None or extent.affected is None or extent.possible is None:
        return sentence("an unknown number of situations is assumed not to occur")
    return plural(
        extent.affected,
        "{affected} of {possible} situations is assumed not to occur",
        "{affected} of {possible} situations are assumed not to occur",
        affected=grouped(extent.affected),
        possible=grouped(extent.possible),
    )
