"""Changes, conflicts and witnesses of `diff` and `gate` in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from sleec_verify.results.phrases import clause_name, counted, given, in_short, listed, occurring, quoted

if TYPE_CHECKING:
    from sleec_runtime.model import Obligation, Ruleset
    from sleec_verify.changes.compare import (
        Change,
        ConflictChange,
        DecidingClause,
        Difference,
        Extent,
        Relation,
        TimedConflictChange,
    )
    from sleec_verify.changes.diagram.variables import Variable
    from sleec_verify.results.finding import Witness


WORDS: Mapping[Relation, str] = {
    "equivalent": "the new rules require the same in every situation",
    "stricter": "the new rules require more in some situations, and less in none",
    "laxer": "the new rules require less in some situations, and more in none",
    "incomparable": "the new rules require more in some situations and less in others",
    "unknown": "the comparison is inconclusive",
}


RELATION_ROLES: Mapping[Relation, str] = {
    "equivalent": "good",
    "stricter": "warning",
    "laxer": "error",
    "incomparable": "error",
    "unknown": "unknown",
}


def relation_text(found: Difference) -> str:
    if found.relation == "incomparable" and found.conflict_ways and not (found.more and found.less):
        return "only one version contradicts itself in some situations"
    if found.relation in ("stricter", "laxer") and not found.changes:
        more = "more" if found.relation == "stricter" else "fewer"
        return f"the new rules allow {more} situations, and require the same in those that both versions allow"
    return WORDS[found.relation]


def change_in_words(change: Change) -> str:
    """``dress_assist: `OpenCurtains` is no longer required``"""
    return f"{rule_text(change)}: {effect_text(change)}"


def rule_text(change: Change) -> str:
    old, new = change.old_rule, change.new_rule
    if old is None:
        return f"{new} (new)"
    if new is None:
        return f"{old} (removed)"
    return new if old == new else f"{new} (was {old})"


def effect_text(change: Change) -> str:
    """```OpenCurtains` is no longer required, `WarnUser` is now required and `LeaveRoom` is now forbidden``"""
    parts = []
    moved = [o for o in (*change.added, *change.removed) if _other_time(change, o) is not None]
    for o in moved:
        times = _when(o), _when(_other_time(change, o) or o)
        now, before = times if o in change.added else times[::-1]
        role = "forbidden" if o.negated else "required"
        parts.append(f"{quoted(o.name)} is now {role} {now} (before: {before})")
    for literals, word in ((change.added, "now"), (change.removed, "no longer")):
        for negated, role in ((False, "required"), (True, "forbidden")):
            names = [_phrase(o) for o in literals if o.negated == negated and o not in moved]
            parts += [f"{listed(names)} {'is' if len(names) == 1 else 'are'} {word} {role}"] if names else []
    # A change that is both a gain and a loss has the same words twice.
    return listed(dict.fromkeys(parts))


def _other_time(change: Change, obligation: Obligation) -> Obligation | None:
    """The obligation or prohibition of the same event by the same rule on the other side, with another window."""
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
    return "immediately" if obligation.timing is None else str(obligation.timing)


def _phrase(obligation: Obligation) -> str:
    """The name, with its window if it has one."""
    timing = "" if obligation.timing is None else f" {obligation.timing}"
    return f"{quoted(obligation.name)}{timing}"


def conflict_in_words(conflict: ConflictChange) -> str:
    """``new conflict: `a` and `b`: `o` is now both required and forbidden``"""
    head = "new conflict" if conflict.way == "added" else "resolved conflict"
    return f"{head}: {conflict_rules(conflict)}: {contradiction_text(conflict)}"


def timed_conflict_in_words(conflict: TimedConflictChange) -> str:
    """``new conflict: rule `a` and rule `b` contradict each other: `o` is both required and forbidden``"""
    return f"{'new' if conflict.way == 'added' else 'resolved'} conflict: {conflict.finding.message}"


def conflict_rules(conflict: ConflictChange) -> str:
    return listed(map(quoted, conflict.rules)) if conflict.rules else "the constraints"


def contradiction_text(conflict: ConflictChange) -> str:
    names = sorted({o.name for o in conflict.literals})
    now = "now" if conflict.way == "added" else "no longer"
    if not names:
        return f"they are {now} impossible to satisfy"
    if len(names) == 1 and len(conflict.literals) == 2:
        return f"{quoted(names[0])} is {now} both required and forbidden"
    return f"{listed(quoted(str(o)) for o in conflict.literals)} {now} contradict each other"


def obligation_text(one: DecidingClause) -> str:
    return " AND ".join(map(in_short, one.obligations)) or "nothing"


def deciding_text(one: DecidingClause, ruleset: Ruleset) -> str:
    """``Greet, by rule `visit` (old.sleec:6)``"""
    name = clause_name(ruleset.by_label[one.rule], one.clause)
    return f"{obligation_text(one)}, by {name} ({ruleset.source.path}:{ruleset.source.place(one.span).line})"


def witness_text(witness: Witness) -> str:
    """``When only `A` occurs, `C` is true (whatever else holds)``"""
    occurs = f"When only {occurring(witness.triggers)}" if witness.triggers else "When nothing occurs"
    return f"{', '.join([occurs, *given(witness.conditions)])} (whatever else holds)"


def extent_text(extent: Extent) -> str:
    """The number of affected situations, and the names by which they differ."""
    where = f" in which {occurring(extent.given)}" if extent.given else ""
    if extent.affected is None or extent.possible is None:
        return f"in an unknown number of situations{where}: {extent.why}"
    if extent.possible == extent.affected == 1:
        return f"in every situation{where}"
    every = (
        f"all {extent.possible:,}"
        if extent.affected == extent.possible
        else f"{extent.affected:,} of {extent.possible:,}"
    )
    over = f" (they differ in {listed(map(_variable, extent.over))})" if extent.over else ""
    return f"in {every} situations{where}{over}"


def _variable(variable: Variable) -> str:
    names = listed(quoted(name) for _, name in variable.names)
    if variable.orders:
        return f"{names} ({variable.ways} orders)"
    if variable.cuts:
        return f"{names} ({counted(variable.ways, 'range')})"
    return names if variable.ways == 2 else f"{names} ({variable.ways} values)"
