"""All differences between two rulesets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple, TypeVar, Union

from sleec_runtime.model import Formula, Never, Ruleset, formulas_of
from sleec_verify.changes.compare.comparison import SIDES, Comparison, SideName, other
from sleec_verify.changes.compare.conflicts import conflict_changes
from sleec_verify.changes.compare.constraints import constraint_changes
from sleec_verify.changes.compare.inferred_kinds import with_kinds_of
from sleec_verify.changes.compare.obligations import changes
from sleec_verify.changes.compare.result import (
    Change,
    ConflictChange,
    ConstraintChange,
    Difference,
    SituationChange,
    TimedConflictChange,
    Undecidable,
)
from sleec_verify.changes.compare.sides import condition_names
from sleec_verify.changes.compare.situations import situation_changes
from sleec_verify.changes.compare.timed_conflicts import TimedConflicts
from sleec_verify.changes.compare.vocabulary import name_changes
from sleec_verify.changes.relations import relations_over_time
from sleec_verify.encoding.budget import Undecided, for_file
from sleec_verify.encoding.calculations import calculations, named
from sleec_verify.encoding.trace_scope import Untimed, speaks_of_traces
from sleec_verify.query.question import is_possible
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

_Told = TypeVar("_Told", Change, ConflictChange, SituationChange, ConstraintChange, TimedConflictChange)
_Any = Union[Change, ConflictChange, SituationChange, ConstraintChange, TimedConflictChange, Undecidable, str]


class _Wanted(NamedTuple):
    """What is compared, as the parameters of `compare` say."""

    over_time: bool
    in_conflicts: bool


def compare(
    old: Ruleset,
    new: Ruleset,
    domain: str | None = None,
    untimed: Untimed = "at",
    over_time: bool = True,
    in_conflicts: bool = False,
) -> Difference:
    """The differences in meaning between `old` and `new`, in each domain of either, or only in `domain`.

    Each ruleset is read in its own reading. `untimed` is the meaning of a response without a window in rules with time.
    The result is complete and exact, except for `Difference.undecided`. O(size of the rules) for equal rules. Each
    other rule needs questions about the rules of its trigger (satisfiability, NP-hard and small), and a count that
    stops at the limits of `changes.diagram`. Without `over_time`, conflicts of several instants are not compared. With
    `in_conflicts`, a literal counts as due if a rule obliges it, also in situations with a conflict; constraints are
    compared, and conflicts are not.
    """
    with for_file(len(old.source.text) + len(new.source.text)):
        return _difference(old, new, domain, untimed, _Wanted(over_time, in_conflicts))


def _difference(old: Ruleset, new: Ruleset, domain: str | None, untimed: Untimed, wanted: _Wanted) -> Difference:
    old, new = with_kinds_of(old, new), with_kinds_of(new, old)
    whole = Comparison(old, new, untimed)
    shared = Difference(
        old,
        new,
        names=tuple(name_changes(old, new, whole.aligned)),
        undecided=tuple(_not_comparable(old, new)),
        renamed=tuple(whole.aligned.renamed),
        reordered=whole.aligned.reordered,
        same=len(whole.aligned.same),
        notes=tuple(_notes(whole)),
    )
    calculated = list(dict.fromkeys(one for ruleset in (old, new) for one in calculations(ruleset)))
    if calculated and (old.statements, old.reading) != (new.statements, new.reading):
        why = sentence("calculations with several measures are not compared")
        return shared._replace(undecided=(*shared.undecided, Undecidable(named(calculated), why)))
    if domain is not None:
        domains: Sequence[str] = (domain,)
    else:
        domains = tuple(dict.fromkeys((*old.domains, *new.domains)))
    if domains:
        found = [_compared(Comparison(old.in_domain(one), new.in_domain(one), untimed), one, wanted) for one in domains]
    else:
        found = [_compared(whole, None, wanted)]
    flat = [one for each in found for one in each]
    difference = shared._replace(
        changes=_merged([one for one in flat if isinstance(one, Change)]),
        conflicts=_merged([one for one in flat if isinstance(one, ConflictChange)]),
        timed_conflicts=_merged([one for one in flat if isinstance(one, TimedConflictChange)]),
        situations=_merged([one for one in flat if isinstance(one, SituationChange)]),
        constraints=_merged([one for one in flat if isinstance(one, ConstraintChange)]),
        undecided=tuple(dict.fromkeys((*shared.undecided, *(one for one in flat if isinstance(one, Undecidable))))),
    )
    limits = tuple(dict.fromkeys(one for one in flat if isinstance(one, str)))
    return difference._replace(notes=(*difference.notes, *limits), rewritten=_rewritten(whole, difference))


def _compared(comparison: Comparison, domain: str | None, wanted: _Wanted) -> list[_Any]:
    clashes = [*comparison.vocabulary.clashes, *_conditions_that_are_measures(comparison)]
    if clashes:
        return [*clashes]
    found: list[_Any] = []
    try:
        found += situation_changes(comparison)
        if is_possible(comparison.index):
            if wanted.in_conflicts:
                found += constraint_changes(comparison)
            else:
                found += conflict_changes(comparison)
            found += changes(comparison, wanted.in_conflicts)
            if wanted.over_time:
                found = _with_conflicts_over_time(found, TimedConflicts(comparison))
        elif all(is_possible(comparison.situations_of(which)) for which in comparison.sides):
            why = sentence("no situation is allowed by the assumptions of both versions")
            found.append(Undecidable(sentence("the obligations"), why))
    except Undecided as error:
        found.append(Undecidable(sentence("the rest of the comparison"), error.message))
    if domain is None:
        return found
    return [one if isinstance(one, (Undecidable, str)) else one._replace(domains=(domain,)) for one in found]


def _with_conflicts_over_time(found: Sequence[_Any], timed: TimedConflicts) -> list[_Any]:
    """`found` with the conflicts over time, without those whose rules also conflict at one instant.

    A contradiction at one instant is left out if the rules do not conflict over time, and their changes are reported.
    """
    changed = {label for one in found if isinstance(one, Change) for label in one.rules}
    kept = [
        one
        for one in found
        if not isinstance(one, ConflictChange) or changed.isdisjoint(one.rules) or not timed.denies(one)
    ]
    known = {(one.way, frozenset(one.rules)) for one in kept if isinstance(one, ConflictChange)}
    further = [one for one in timed.changes() if (one.way, frozenset(one.rules)) not in known]
    return [*kept, *further, *timed.undecided, *timed.limits]


def _conditions_that_are_measures(comparison: Comparison) -> Iterator[Undecidable]:
    """Names that are a number or a scale in one text, and true or false in the other."""
    for which in SIDES:
        measures = comparison.sides[other(which)].stated.measures
        for name in sorted(condition_names(_formulas(comparison, which)) & measures.keys()):
            why = sentence("{name} is true or false in one version and a measure in the other", name=quoted(name))
            yield Undecidable(name, why)


def _formulas(comparison: Comparison, which: SideName) -> Iterator[Formula]:
    """The formulas of one side, except those in rules that both sides have."""
    for pair, _ in comparison.changed:
        rule = pair.old if which == "old" else pair.new
        if rule is not None:
            yield from formulas_of(rule)
    yield from (given.formula for given in comparison.sides[which].given)
    yield from (one.formula for one in comparison.sides[which].constraints if isinstance(one, Never))


def _merged(found: Sequence[_Told]) -> tuple[_Told, ...]:
    """Equal findings of several domains, merged."""
    merged: dict[str, list[_Told]] = {}
    for number, one in enumerate(found):
        # Only several domains can have the same entry.
        key = repr(one._replace(domains=())) if one.domains else str(number)
        merged.setdefault(key, []).append(one)
    return tuple(
        same[0]._replace(domains=tuple(chain.from_iterable(s.domains for s in same))) for same in merged.values()
    )


def _rewritten(comparison: Comparison, difference: Difference) -> tuple[tuple[str, ...], ...]:
    """The rules of both sides with another text and the same meaning."""
    if difference.undecided:
        return ()
    at_work = {change.new_rule for change in difference.changes}
    at_work.update(change.old_rule for change in difference.changes)
    at_work.update(label for conflict in difference.all_conflicts for label in conflict.rules)
    return tuple(
        tuple(dict.fromkeys((pair.old.label, pair.new.label)))
        for pair, _ in comparison.changed
        if pair.old is not None and pair.new is not None and at_work.isdisjoint((pair.old.label, pair.new.label))
    )


# Unsupported constructs -----------------------------------------------------------------------------------


def _not_comparable(old: Ruleset, new: Ruleset) -> Iterator[Undecidable]:
    """Relations about several instants that differ between the sides."""
    if not (old.is_timed or new.is_timed):
        return
    from sleec_runtime.model import relation_name

    mine, theirs = relations_over_time(old), relations_over_time(new)
    gone = sentence("it is gone, but its meaning over several moments is not compared")
    added = sentence("it is new, but its meaning over several moments is not compared")
    for one, others, why in ((mine, theirs, gone), (theirs, mine, added)):
        for relation_ in one:
            if relation_ not in others:
                yield Undecidable(sentence("the relation {relation}", relation=relation_name(relation_)), why)


def _notes(comparison: Comparison) -> Iterator[str]:
    old, new = comparison.sides["old"].stated, comparison.sides["new"].stated
    if comparison.vocabulary.whole and old.syntax != new.syntax:
        names = ", ".join(comparison.vocabulary.whole)
        yield sentence("the DSL has only whole numbers, so only whole values of {names} are compared", names=names)
    if speaks_of_traces(old) or speaks_of_traces(new):
        yield sentence(
            "the comparison covers the responses of each rule; it does not cover their consequences through other rules"
        )
    if old.is_timed or new.is_timed:
        from sleec_runtime.model import Claim

        one, other = ([s for s in ruleset.statements if isinstance(s, Claim)] for ruleset in (old, new))
        if any(claim not in other for claim in one) or any(claim not in one for claim in other):
            yield sentence("concerns or purposes changed; they do not change what the rules require")
