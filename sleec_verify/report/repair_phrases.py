"""The effect of a repair in one line."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.report.difference_phrases import effect_text, extent_text
from sleec_verify.results.phrases import counted, in_short, listed, quoted

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
        return "the rules mean the same"
    parts = list(_resolved(repair))
    changes = list(_changes(found))
    if is_conflict and not parts and not changes:
        parts.append("the conflict is resolved")
    parts += changes[:_MOST_CHANGES]
    if len(changes) > _MOST_CHANGES:
        parts.append(counted(len(changes) - _MOST_CHANGES, "more change"))
    if found.undecided:
        parts.append(f"the rest of the effect is unknown: {found.undecided[0].why}")
    elif not changes:
        parts.append("nothing else changes")
    return "; ".join(parts)


def _resolved(repair: Repair) -> Iterator[str]:
    """What holds in the situation of the conflict of the finding, and the number of other conflicts that are gone."""
    found = repair.effect.difference
    gone = [conflict for conflict in found.conflicts if conflict.way == "removed"]
    if gone and repair.finding.check not in _CONFLICTS:
        yield f"{counted(len(gone), 'conflict')} {'is' if len(gone) == 1 else 'are'} resolved"
    elif gone:
        own = next((one for one in gone if set(one.rules) == set(repair.finding.rules)), gone[0])
        yield f"in the situation of the conflict, the rules then require {_required(own)}"
        if len(gone) > 1:
            yield f"{counted(len(gone) - 1, 'other conflict')} {'is' if len(gone) == 2 else 'are'} resolved"


def _required(conflict: ConflictChange) -> str:
    """What the new rules require in the situation of a former conflict."""
    names = dict.fromkeys(quoted(in_short(o)) for one in conflict.after for o in one.obligations)
    return listed(names) if names else "nothing"


def _changes(found: Difference) -> Iterator[str]:
    for change in found.changes:
        rule = quoted(change.old_rule or change.new_rule or "")
        yield f"rule {rule}, {extent_text(change.extent._replace(over=()))}: {effect_text(change)}"
    for situation in found.situations:
        word = "allowed again" if situation.way == "added" else "assumed not to occur"
        yield f"{_number(situation.extent)} {word}"


def _number(extent: Extent | None) -> str:
    if extent is None or extent.affected is None or extent.possible is None:
        return "an unknown number of situations is"
    return f"{extent.affected:,} of {extent.possible:,} situations {'is' if extent.affected == 1 else 'are'}"
