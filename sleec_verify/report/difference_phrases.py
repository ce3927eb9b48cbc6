"""Changes, conflicts and witnesses of `diff` and `gate` in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from sleec_verify.results.phrases import counted, given, in_short, listed, occurring, quoted

if TYPE_CHECKING:
    from sleec_runtime.model import Obligation, Source, Span
    from sleec_verify.changes.compare.result import (
        Change,
        ConflictChange,
        DecidingClause,
        Difference,
        Extent,
        Relation,
    )
    from sleec_verify.changes.diagram.variables import Variable
    from sleec_verify.results.finding import Witness


WORDS: Mapping[Relation, str] = {
    "equivalent": "the new rules oblige the same in every situation",
    "stricter": "the new rules oblige more somewhere, and nowhere less",
    "laxer": "the new rules oblige less somewhere, and nowhere more",
    "incomparable": "the new rules oblige more in some situations and less in others",
    "unknown": "not all of it could be compared",
}


RELATION_ROLES: Mapping[Relation, str] = {
    "equivalent": "good",
    "stricter": "warning",
    "laxer": "error",
    "incomparable": "error",
    "unknown": "unknown",
}


def relation_text(found: Difference) -> str:
    if found.relation == "incomparable" and found.conflicts and not (found.more and found.less):
        return "one side contradicts itself in situations in which the other does not"
    if found.relation in ("stricter", "laxer") and not found.changes:
        more = "more" if found.relation == "stricter" else "fewer"
        return f"the new rules speak of {more} situations, and oblige the same in those of both"
    return WORDS[found.relation]


def change_in_words(change: Change) -> str:
    """``dress_assist: OpenCurtains is no longer due``"""
    return f"{rule_text(change)}: {effect_text(change)}"


def rule_text(change: Change) -> str:
    old, new = change.old_rule, change.new_rule
    if old is None:
        return f"{new} (new)"
    if new is None:
        return f"{old} (gone)"
    return new if old == new else f"{new} (was {old})"


def effect_text(change: Change) -> str:
    """``OpenCurtains is no longer due, WarnUser is now due and LeaveRoom is now forbidden``"""
    parts = []
    moved = [o for o in (*change.added, *change.removed) if _other_time(change, o) is not None]
    for o in moved:
        times = _when(o), _when(_other_time(change, o) or o)
        now, before = times if o in change.added else times[::-1]
        role = "forbidden" if o.negated else "due"
        # With what is due in its place, a time is long.
        no_longer = f" (before: {before})" if "," in before or "," in now else f" and no longer {before}"
        parts.append(f"{quoted(o.name)} is now {role} {now}{no_longer}")
    for literals, word in ((change.added, "now"), (change.removed, "no longer")):
        for negated, role in ((False, "due"), (True, "forbidden")):
            names = [_phrase(o) for o in literals if o.negated == negated and o not in moved]
            parts += [f"{listed(names)} {'is' if len(names) == 1 else 'are'} {word} {role}"] if names else []
    # What asks for more here and for less there is a gain and a loss, of which the words are the same.
    return listed(dict.fromkeys(parts))


def _other_time(change: Change, obligation: Obligation) -> Obligation | None:
    """What the rule itself says on the other side of the same thing, at another time."""
    added = obligation in change.added
    rule, deciding = (change.old_rule, change.before) if added else (change.new_rule, change.after)
    return next(
        (
            o
            for one in deciding
            if one.rule == rule
            for o in one.obligations
            if (o.name, o.negated) == (obligation.name, obligation.negated) and o.timing != obligation.timing
        ),
        None,
    )


def _when(obligation: Obligation) -> str:
    return "at once" if obligation.timing is None else str(obligation.timing)


def _phrase(obligation: Obligation) -> str:
    """The name, with when it is due if that is said."""
    timing = "" if obligation.timing is None else f" {obligation.timing}"
    return f"{quoted(obligation.name)}{timing}"


def conflict_in_words(conflict: ConflictChange) -> str:
    """``new conflict: a and b: o is now due and forbidden at once``"""
    head = "new conflict" if conflict.way == "added" else "conflict gone"
    return f"{head}: {conflict_rules(conflict)}: {contradiction_text(conflict)}"


def conflict_rules(conflict: ConflictChange) -> str:
    return listed(conflict.rules) if conflict.rules else "the constraints"


def contradiction_text(conflict: ConflictChange) -> str:
    names = sorted({o.name for o in conflict.literals})
    now = "now" if conflict.way == "added" else "no longer"
    if not names:
        return f"what they forbid is {now} the case, whatever is done"
    if len(names) == 1 and len(conflict.literals) == 2:
        return f"{quoted(names[0])} is {now} due and forbidden at once"
    return f"{listed(str(o) for o in conflict.literals)} are {now} due together, which cannot be"


def obligation_text(one: DecidingClause) -> str:
    return " AND ".join(map(in_short, one.obligations)) or "nothing"


def clause_text(one: DecidingClause) -> str:
    return f"hedge {one.clause} of {one.rule}" if one.clause else f"the default of {one.rule}"


def place_text(source: Source, span: Span) -> str:
    return f"{source.path}:{source.place(span).line}"


def witness_text(witness: Witness) -> str:
    """``When A occurs, C is true (nothing else occurs, and the rest does not matter)``"""
    occurs = f"When {occurring(witness.triggers)}" if witness.triggers else "When nothing occurs"
    return f"{', '.join([occurs, *given(witness.conditions)])} (nothing else occurs, and the rest does not matter)"


def extent_text(extent: Extent) -> str:
    """How many situations it is, and how they are counted."""
    where = f" in which {occurring(extent.given)}" if extent.given else ""
    if extent.affected is None or extent.possible is None:
        return f"in more situations{where} than were counted: {extent.why}"
    if extent.possible == extent.affected == 1:
        return f"in every situation{where}"
    every = (
        f"all {extent.possible:,}"
        if extent.affected == extent.possible
        else f"{extent.affected:,} of {extent.possible:,}"
    )
    over = f", counted over {listed(map(_variable, extent.over))}" if extent.over else ""
    return f"in {every} situations{where}{over}"


def _variable(variable: Variable) -> str:
    names = listed(quoted(name) for _, name in variable.names)
    if variable.orders:
        return f"{names} in {variable.ways} orders"
    if variable.cuts:
        return f"{names} in {counted(variable.ways, 'region')}"
    return names if variable.ways == 2 else f"{names} in {variable.ways} values"
