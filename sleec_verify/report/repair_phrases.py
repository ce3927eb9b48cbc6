"""The effect of a repair in one line."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.report.difference_phrases import effect_text, extent_text
from sleec_verify.wording.phrases import counted, grouped, in_short, listed, quoted
from sleec_verify.wording.sentence import joined, plural, sentence

if TYPE_CHECKING:
    from sleec_verify.changes.compare import ConflictChange, Difference, Extent
    from sleec_verify.repairs.repair import Repair

_MOST_CHANGES = 2
"""The changes that one line names."""

_CONFLICTS = ("conflict", "vacuous-conflict")
"""The checks that find conflicts."""


def effect_in_words(repair: Repair) -> str:
    """``in the situation of the conflict, the rules then require `NOT Speak`; nothing else changes``"""
    found = repair.effect.difference
    is_conflict = repair.finding.check in _CONFLICTS
    if repair.effect.keeps_meaning and not is_conflict:
        return sentence("the rules mean the same")
    parts = list(_resolved(repair))
    changes = list(_changes(found))
    if is_conflict and not parts and not changes:
        parts.append(sentence("the conflict is resolved"))
    parts += changes[:_MOST_CHANGES]
    if len(changes) > _MOST_CHANGES:
        parts.append(counted(len(changes) - _MOST_CHANGES, "more change"))
    if found.undecided:
        parts.append(sentence("the rest of the effect is unknown: {why}", why=found.undecided[0].why))
    elif not changes:
        parts.append(sentence("nothing else changes"))
    return joined("; ", parts)


def _resolved(repair: Repair) -> Iterator[str]:
    """What holds in the situation of the conflict of the finding, and the number of other conflicts that are gone."""
    found = repair.effect.difference
    gone = [conflict for conflict in found.conflicts if conflict.way == "removed"]
    if gone and repair.finding.check not in _CONFLICTS:
        yield plural(len(gone), "{number} conflict is resolved", "{number} conflicts are resolved")
    elif gone:
        own = next((one for one in gone if set(one.rules) == set(repair.finding.rules)), gone[0])
        yield sentence("in the situation of the conflict, the rules then require {response}", response=_required(own))
        if len(gone) > 1:
            yield plural(len(gone) - 1, "{number} other conflict is resolved", "{number} other conflicts are resolved")


def _required(conflict: ConflictChange) -> str:
    """What the new rules require in the situation of a former conflict."""
    names = dict.fromkeys(quoted(in_short(o)) for one in conflict.after for o in one.obligations)
    return listed(names) if names else sentence("nothing")


def _changes(found: Difference) -> Iterator[str]:
    for change in found.changes:
        yield sentence(
            "rule {rule}, {situations}: {effect}",
            rule=quoted(change.old_rule or change.new_rule or ""),
            situations=extent_text(change.extent._replace(over=())),
            effect=effect_text(change),
        )
    for situation in found.situations:
        yield _allowed_again(situation.extent) if situation.way == "added" else _excluded(situation.extent)


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
