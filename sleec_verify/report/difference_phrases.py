"""Changes, conflicts and witnesses of `diff` and `gate` in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from sleec_verify.wording.phrases import clause_name, counted, given, grouped, in_short, listed, occurring, quoted
from sleec_verify.wording.sentence import joined, plural, sentence

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
    "equivalent": sentence("the new rules require the same in every situation"),
    "stricter": sentence("the new rules require more in some situations, and less in none"),
    "laxer": sentence("the new rules require less in some situations, and more in none"),
    "incomparable": sentence("the new rules require more in some situations and less in others"),
    "unknown": sentence("the comparison is inconclusive"),
}


RELATION_NAMES: Mapping[Relation, str] = {
    "equivalent": sentence("equivalent"),
    "stricter": sentence("stricter"),
    "laxer": sentence("laxer"),
    "incomparable": sentence("incomparable"),
    "unknown": sentence("unknown"),
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
        return sentence("only one version contradicts itself in some situations")
    if found.relation == "stricter" and not found.changes:
        return sentence("the new rules allow more situations, and require the same in those that both versions allow")
    if found.relation == "laxer" and not found.changes:
        return sentence("the new rules allow fewer situations, and require the same in those that both versions allow")
    return WORDS[found.relation]


def change_in_words(change: Change) -> str:
    """``dress_assist: `OpenCurtains` is no longer required``"""
    return joined(": ", [rule_text(change), effect_text(change)])


def rule_text(change: Change) -> str:
    old, new = change.old_rule, change.new_rule
    if old is None:
        return sentence("{rule} (new)", rule=new or "")
    if new is None:
        return sentence("{rule} (removed)", rule=old)
    return new if old == new else sentence("{rule} (was {old})", rule=new, old=old)


def effect_text(change: Change, lost_first: bool = False) -> str:
    """```OpenCurtains` is no longer required, `WarnUser` is now required and `LeaveRoom` is now forbidden``"""
    parts = []
    moved = [o for o in (*change.added, *change.removed) if _other_time(change, o) is not None]
    for o in moved:
        times = _when(o), _when(_other_time(change, o) or o)
        now, before = times if o in change.added else times[::-1]
        parts.append(_other_window(o, now, before))
    ways = ((change.added, True), (change.removed, False))
    for literals, is_added in ways[::-1] if lost_first else ways:
        for negated in (False, True):
            names = [_phrase(o) for o in literals if o.negated == negated and o not in moved]
            if names:
                parts.append(role_text(len(names), listed(names), is_added, negated))
    # A change that is both a gain and a loss has the same words twice.
    return listed(dict.fromkeys(parts))


def _other_window(obligation: Obligation, now: str, before: str) -> str:
    name = quoted(obligation.name)
    if obligation.negated:
        return sentence("{name} is now forbidden {now} (before: {before})", name=name, now=now, before=before)
    return sentence("{name} is now required {now} (before: {before})", name=name, now=now, before=before)


def role_text(number: int, names: str, is_added: bool, negated: bool) -> str:
    """```OpenCurtains` is no longer required``; `number` is that of the names."""
    if is_added and negated:
        return plural(number, "{names} is now forbidden", "{names} are now forbidden", names=names)
    if is_added:
        return plural(number, "{names} is now required", "{names} are now required", names=names)
    if negated:
        return plural(number, "{names} is no longer forbidden", "{names} are no longer forbidden", names=names)
    return plural(number, "{names} is no longer required", "{names} are no longer required", names=names)


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
    return sentence("immediately") if obligation.timing is None else quoted(str(obligation.timing))


def _phrase(obligation: Obligation) -> str:
    """The name with its window, as the rule writes it."""
    return quoted(in_short(obligation).removeprefix("NOT "))


def conflict_in_words(conflict: ConflictChange) -> str:
    """``new conflict: `a` and `b`: `o` is now both required and forbidden``"""
    head = sentence("new conflict") if conflict.way == "added" else sentence("resolved conflict")
    return joined(": ", [head, conflict_rules(conflict), contradiction_text(conflict)])


def timed_conflict_in_words(conflict: TimedConflictChange) -> str:
    """``new conflict: rule `a` and rule `b` contradict each other: `o` is both required and forbidden``"""
    head = sentence("new conflict") if conflict.way == "added" else sentence("resolved conflict")
    return joined(": ", [head, conflict.finding.message])


def conflict_rules(conflict: ConflictChange) -> str:
    return listed(map(quoted, conflict.rules)) if conflict.rules else sentence("the constraints")


def contradiction_text(conflict: ConflictChange) -> str:
    names = sorted({o.name for o in conflict.literals})
    is_new = conflict.way == "added"
    if not names:
        return (
            sentence("they are now impossible to satisfy")
            if is_new
            else sentence("they are no longer impossible to satisfy")
        )
    if len(names) == 1 and len(conflict.literals) == 2:
        name = quoted(names[0])
        return (
            sentence("{name} is now both required and forbidden", name=name)
            if is_new
            else sentence("{name} is no longer both required and forbidden", name=name)
        )
    said = listed(quoted(str(o)) for o in conflict.literals)
    return (
        sentence("{names} now contradict each other", names=said)
        if is_new
        else sentence("{names} no longer contradict each other", names=said)
    )


def obligation_text(one: DecidingClause) -> str:
    return " AND ".join(map(in_short, one.obligations)) or sentence("nothing")


def deciding_text(one: DecidingClause, ruleset: Ruleset) -> str:
    """``Greet, by rule `visit` (old.sleec:6)``"""
    return sentence(
        "{obligations}, by {clause} ({place})",
        obligations=obligation_text(one),
        clause=clause_name(ruleset.by_label[one.rule], one.clause),
        place=f"{ruleset.source.path}:{ruleset.source.place(one.span).line}",
    )


def witness_text(witness: Witness) -> str:
    """``When only `A` occurs, `C` is true (whatever else holds)``"""
    facts = given(witness.conditions)
    if witness.triggers:
        said = joined(", ", [occurring(witness.triggers), *facts])
        return sentence("When only {facts} (whatever else holds)", facts=said)
    said = joined(", ", [sentence("nothing occurs"), *facts])
    return sentence("When {facts} (whatever else holds)", facts=said)


def extent_text(extent: Extent) -> str:
    """The number of affected situations, and the names by which they differ."""
    where = sentence(" in which {events}", events=occurring(extent.given)) if extent.given else ""
    if extent.affected is None or extent.possible is None:
        return sentence("in an unknown number of situations{where}: {why}", where=where, why=extent.why or "")
    if extent.possible == extent.affected == 1:
        return sentence("in every situation{where}", where=where)
    over = sentence(" (they differ in {names})", names=listed(map(_variable, extent.over))) if extent.over else ""
    affected, possible = grouped(extent.affected), grouped(extent.possible)
    if extent.affected == extent.possible:
        return sentence("in all {number} situations{where}{over}", number=possible, where=where, over=over)
    return sentence(
        "in {number} of {possible} situations{where}{over}",
        number=affected,
        possible=possible,
        where=where,
        over=over,
    )


def _variable(variable: Variable) -> str:
    names = listed(quoted(name) for _, name in variable.names)
    if variable.orders:
        return sentence("{names} ({number} orders)", names=names, number=variable.ways)
    if variable.cuts:
        return sentence("{names} ({ranges})", names=names, ranges=counted(variable.ways, "range"))
    return names if variable.ways == 2 else sentence("{names} ({number} values)", names=names, number=variable.ways)
