"""What `diff` says: what the rules oblige now and did not before, in words, in short, or for programs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.changes.compare.result import by_obligation, relation
from sleec_verify.report.escape import as_text
from sleec_verify.report.outcome import counted
from sleec_verify.results.phrases import given, in_domains, in_short, listed, occurring, quoted, value_text

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Obligation, Ruleset, Source, Span
    from sleec_verify.changes.assertions import Asked
    from sleec_verify.changes.compare.result import (
        Change,
        ConflictChange,
        Deciding,
        Difference,
        Extent,
        Relation,
        SituationChange,
    )
    from sleec_verify.changes.decision_diagram import Part
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import Witness


class Compared(NamedTuple):
    """One ruleset on both sides: what differs, or what is wrong with a side."""

    path: str
    difference: Difference | None
    errors: tuple[SleecError, ...] = ()


class Report(NamedTuple):
    """All that was asked: each ruleset, how many texts are the same on both sides, and the assertions."""

    compared: tuple[Compared, ...]
    unchanged: int = 0
    asked: tuple[Asked, ...] = ()

    @property
    def differences(self) -> list[Difference]:
        return [one.difference for one in self.compared if one.difference is not None]

    @property
    def relation(self) -> Relation:
        """One word for all rulesets together."""
        found = self.differences
        unusable = any(one.errors for one in self.compared)
        return relation(
            any(one.more for one in found),
            any(one.less for one in found),
            any(one.conflicts for one in found),
            unusable or any(one.undecided for one in found),
        )


WORDS: Mapping[Relation, str] = {
    "equivalent": "the new rules oblige the same in every situation",
    "stricter": "the new rules oblige more somewhere, and nowhere less",
    "laxer": "the new rules oblige less somewhere, and nowhere more",
    "incomparable": "the new rules oblige more in some situations and less in others",
    "unknown": "not all of it could be compared",
}
_ROLES: Mapping[Relation, str] = {
    "equivalent": "good",
    "stricter": "warning",
    "laxer": "error",
    "incomparable": "error",
    "unknown": "unknown",
}


# In full --------------------------------------------------------------------------------------------------


def _full(report: Report, palette: Palette) -> Iterator[str]:
    parts = [list(on_difference(found, palette)) for found in report.differences]
    if report.asked:
        parts.append(list(on_assertions(report.asked, palette)))
    if len(report.compared) + report.unchanged > 1:
        parts.append([_in_all(report, palette)])
    for number, part in enumerate(parts):
        yield from ("",) if number else ()
        yield from part


def on_difference(found: Difference, palette: Palette) -> Iterator[str]:
    """The lines on one ruleset."""
    word = palette(_ROLES[found.relation], found.relation)
    yield f"{_called(found.old, found.new)}: {word}: {_why(found)}"
    for change in found.changes:
        yield from _change(found, change, palette)
    for conflict in found.conflicts:
        yield from _conflict(found, conflict, palette)
    for situation in found.situations:
        yield from _situation(situation, palette)
    if found.names or found.renamed or found.rewritten or found.reordered or found.undecided or found.notes:
        yield ""
    yield from _names(found, palette)
    yield from _same_meaning(found, palette)
    for what, why in found.undecided:
        yield f"  {palette('unknown', 'unknown')}: {what}: {why}"
    for note in found.notes:
        yield f"  {palette('note', 'note')}: {note}"


def _called(old: Ruleset, new: Ruleset) -> str:
    return f"{old.source.path} -> {new.source.path}"


def _why(found: Difference) -> str:
    if found.relation == "incomparable" and found.conflicts and not (found.more and found.less):
        return "one side contradicts itself in situations in which the other does not"
    if found.relation in ("stricter", "laxer") and not found.changes:
        more = "more" if found.relation == "stricter" else "fewer"
        return f"the new rules speak of {more} situations, and oblige the same in those of both"
    return WORDS[found.relation]


def _change(found: Difference, change: Change, palette: Palette) -> Iterator[str]:
    yield ""
    yield f"  {palette('strong', _rule(change))}: {_so(change)}"
    yield f"    {witness_text(change.witness)}:"
    yield from _before_and_after(found, change.before, change.after, palette)
    yield f"    {extent_text(change.extent)}{in_domains(change.domains)}"


def _rule(change: Change) -> str:
    old, new = change.old_rule, change.new_rule
    if old is None:
        return f"{new} (new)"
    if new is None:
        return f"{old} (gone)"
    return new if old == new else f"{new} (was {old})"


def change_in_words(change: Change) -> str:
    """``dress_assist: OpenCurtains is no longer due``"""
    return f"{_rule(change)}: {_so(change)}"


def conflict_in_words(conflict: ConflictChange) -> str:
    """``new conflict: a and b: o is now due and forbidden at once``"""
    head = "new conflict" if conflict.way == "added" else "conflict gone"
    return f"{head}: {_conflicting(conflict)}: {_at_odds(conflict)}"


def _conflicting(conflict: ConflictChange) -> str:
    return listed(conflict.rules) if conflict.rules else "the constraints"


def _so(change: Change) -> str:
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


def _before_and_after(
    found: Difference, before: Sequence[Deciding], after: Sequence[Deciding], palette: Palette
) -> Iterator[str]:
    for word, deciding, ruleset in (("before", before, found.old), ("after", after, found.new)):
        lines = [f"{_due(one)}, by {_clause(one)} ({_place(ruleset.source, one.span)})" for one in deciding]
        for at, line in enumerate(lines or ["no rule says anything"]):
            yield f"      {palette('faint', f'{word if at == 0 else str():7}')} {line}"


def _due(one: Deciding) -> str:
    return " AND ".join(map(in_short, one.obligations)) or "nothing"


def _clause(one: Deciding) -> str:
    return f"hedge {one.clause} of {one.rule}" if one.clause else f"the default of {one.rule}"


def _place(source: Source, span: Span) -> str:
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
    over = f", counted over {listed(map(_part, extent.over))}" if extent.over else ""
    return f"in {every} situations{where}{over}"


def _part(part: Part) -> str:
    names = listed(quoted(name) for _, name in part.names)
    if part.orders:
        return f"{names} in {part.ways} orders"
    if part.cuts:
        return f"{names} in {counted(part.ways, 'region')}"
    return names if part.ways == 2 else f"{names} in {part.ways} values"


def _conflict(found: Difference, conflict: ConflictChange, palette: Palette) -> Iterator[str]:
    added = conflict.way == "added"
    ruleset = found.new if added else found.old
    head = palette("error", "new conflict") if added else palette("good", "conflict gone")
    lines = sorted({ruleset.source.place(span).line for span in conflict.origins})
    by = f", by the constraint{'s' if len(lines) > 1 else ''} of line {listed(map(str, lines))}" if lines else ""
    yield ""
    yield f"  {head}: {_conflicting(conflict)}: {_at_odds(conflict)}{by}"
    yield f"    {witness_text(conflict.witness)}:"
    yield from _before_and_after(found, conflict.before, conflict.after, palette)
    yield f"    {extent_text(conflict.extent)}{in_domains(conflict.domains)}"


def _at_odds(conflict: ConflictChange) -> str:
    names = sorted({o.name for o in conflict.literals})
    now = "now" if conflict.way == "added" else "no longer"
    if not names:
        return f"what they forbid is {now} the case, whatever is done"
    if len(names) == 1 and len(conflict.literals) == 2:
        return f"{quoted(names[0])} is {now} due and forbidden at once"
    return f"{listed(str(o) for o in conflict.literals)} are {now} due together, which cannot be"


def _situation(one: SituationChange, palette: Palette) -> Iterator[str]:
    yield ""
    if one.way == "added":
        yield f"  {palette('strong', 'situations')}: no longer taken for granted: {one.what}"
    else:
        yield f"  {palette('strong', 'situations')}: now taken for granted: {one.what}"
    if one.witness is not None and one.extent is not None:
        word = "is now possible" if one.way == "added" else "no longer counts"
        occurs = f"when {occurring(one.witness.triggers)}" if one.witness.triggers else ""
        facts = ", ".join(part for part in (occurs, *given(one.witness.conditions)) if part) or "any situation"
        yield f"    {word}, among others: {facts}"
        yield f"    {extent_text(one.extent)}{in_domains(one.domains)}"


def _names(found: Difference, palette: Palette) -> Iterator[str]:
    for way, title in (("added", "new names"), ("removed", "names gone")):
        names = [f"{quoted(one.name)} ({one.kind})" for one in found.names if one.way == way]
        if names:
            yield f"  {palette('strong', title)}: {listed(names)}"


def _same_meaning(found: Difference, palette: Palette) -> Iterator[str]:
    if found.renamed:
        named = listed(f"{old} is now {new}" for old, new in found.renamed)
        yield f"  {palette('strong', 'renamed')}: {named}, and says the same"
    if found.rewritten:
        rules = listed(labels[-1] for labels in found.rewritten)
        yield f"  {palette('strong', 'rewritten')}: {rules}, and oblige{'s' * (len(found.rewritten) == 1)} the same"
    if found.reordered:
        yield f"  {palette('strong', 'reordered')}: the rules stand in another order, which means nothing"
    if found.old.reading != found.new.reading:
        yield f"  {palette('strong', 'readings')}: {found.old.reading} before, {found.new.reading} after"


def on_assertions(asked: Sequence[Asked], palette: Palette) -> Iterator[str]:
    """The lines on all assertions."""
    if not asked:
        return
    from sleec_verify.changes.assertions import Broken

    for assertion, ruleset, answer in asked:
        path = ruleset.source.path
        if answer is None:
            yield f"{palette('good', 'holds')}: {assertion.text} ({path})"
        elif isinstance(answer, Broken):
            yield f"{palette('error', 'broken')}: {assertion.text} ({path})"
            yield f"  {witness_text(answer.witness)}{in_domains((answer.domain,) if answer.domain else ())}:"
            lines = [f"{_due(one)}, by {_clause(one)} ({_place(ruleset.source, one.span)})" for one in answer.deciding]
            yield from (f"    {line}" for line in lines or ["no rule says anything"])
        else:
            yield f"{palette('unknown', 'unknown')}: {assertion.text} ({path}): {answer}"


def _in_all(report: Report, palette: Palette) -> str:
    word = palette(_ROLES[report.relation], report.relation)
    number = len(report.compared) + report.unchanged
    unusable = sum(bool(one.errors) for one in report.compared)
    parts = [f"{report.unchanged} unchanged"] if report.unchanged else []
    parts += [f"{unusable} unusable"] if unusable else []
    return f"{counted(number, 'ruleset')}{f' ({listed(parts)})' if parts else ''}: {word}: {WORDS[report.relation]}"


# In short -------------------------------------------------------------------------------------------------


def _concise(report: Report, palette: Palette) -> Iterator[str]:
    from sleec_verify.changes.assertions import Broken

    for found in report.differences:
        path = found.new.source.path
        for change, obligation, way in by_obligation(found.changes):
            sign = palette("good", "+") if way == "added" else palette("error", "-")
            yield f"{path}: {sign} {in_short(obligation)} {_short_cause(change)}"
        for conflict in found.conflicts:
            sign = palette("error", "+ conflict") if conflict.way == "added" else palette("good", "- conflict")
            at_odds = ", ".join(map(str, conflict.literals)) or "constraints"
            yield f"{path}: {sign} {at_odds} {_short_cause(conflict)}"
        for situation in found.situations:
            sign = "+" if situation.way == "added" else "-"
            yield f"{path}: {sign} situations: {situation.what}{in_domains(situation.domains)}"
        for way, kind, name in found.names:
            yield f"{path}: {'+' if way == 'added' else '-'} {kind} {name}"
        for what, why in found.undecided:
            yield f"{path}: {palette('unknown', 'unknown')} {what}: {why}"
        yield f"{path}: {palette(_ROLES[found.relation], found.relation)}"
    for assertion, ruleset, answer in report.asked:
        if isinstance(answer, Broken):
            broken = f"{palette('error', 'broken')} {assertion.text}"
            where = in_domains((answer.domain,) if answer.domain else ())
            yield f"{ruleset.source.path}: {broken}: {_short_witness(answer.witness)}{where}"
        elif answer is not None:
            yield f"{ruleset.source.path}: {palette('unknown', 'unknown')} {assertion.text}: {answer}"
    if len(report.compared) + report.unchanged > 1:
        yield f"{counted(len(report.compared) + report.unchanged, 'ruleset')}: {report.relation}"


def _short_cause(one: Change | ConflictChange) -> str:
    count = "" if one.extent.affected is None else f" ({one.extent.affected:,}/{one.extent.possible:,})"
    return f"[{'/'.join(one.rules)}] {_short_witness(one.witness)}{count}{in_domains(one.domains)}"


def _short_witness(witness: Witness) -> str:
    facts = [*witness.triggers, *(f"{name}={value_text(value)}" for name, value in witness.conditions.items())]
    return f"when {', '.join(facts)}"


def _json(report: Report, palette: Palette) -> Iterator[str]:
    from sleec_verify.report.difference_json import render

    yield from render(report, palette)


RENDERERS: Mapping[str, Callable[[Report, Palette], Iterator[str]]] = {
    "full": as_text(_full),
    "concise": as_text(_concise),
    "json": _json,
}
