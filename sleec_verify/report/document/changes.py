"""What changed since another version of the rules, in sentences."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.report.difference_phrases import (
    conflict_in_words,
    effect_text,
    extent_text,
    relation_text,
    timed_conflict_in_words,
    witness_text,
)
from sleec_verify.wording.phrases import error_summary, quoted
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_verify.changes.compare import Change, ConflictChange, Difference
    from sleec_verify.report.difference_report import RulesetDifference


def summary(compared: RulesetDifference) -> str:
    """The relation of the new rules to the old ones; why there is none if a version cannot be read."""
    if compared.difference is None:
        return sentence("The versions cannot be compared: {why}.", why=error_summary(compared.errors[0]))
    return sentence("{relation}.", relation=_relation(compared.difference))


def _relation(found: Difference) -> str:
    if found.conflict_ways == {"added"}:
        return sentence("the new rules contradict each other in situations in which the earlier ones do not")
    if found.conflict_ways == {"removed"}:
        return sentence("the earlier rules contradict each other in situations in which the new ones do not")
    return relation_text(found)


def changes(compared: RulesetDifference) -> Iterator[str]:
    """Each change, each comparison that is undecided, and what is not compared."""
    if compared.difference is not None:
        for text in _changes(compared.difference):
            yield sentence("{text}.", text=text)


def _changes(found: Difference) -> Iterator[str]:
    if found.old.reading != found.new.reading:
        yield sentence("the reading was {old} and is now {new}", old=found.old.reading, new=found.new.reading)
    for change in found.changes:
        yield _with_example(_change(change), change)
    for conflict in found.conflicts:
        yield _with_example(conflict_in_words(conflict), conflict)
    yield from map(timed_conflict_in_words, found.timed_conflicts)
    for situations in found.situations:
        if situations.way == "added":
            yield sentence("more situations are possible, without the assumption: {what}", what=situations.what)
        else:
            yield sentence("fewer situations are possible, with the new assumption: {what}", what=situations.what)
    for open_question in found.undecided:
        yield sentence("unknown: {what}: {why}", what=open_question.what, why=open_question.why)
    yield from found.notes


def _change(change: Change) -> str:
    old, new, effect = change.old_rule, change.new_rule, effect_text(change)
    if old is None:
        return sentence("new rule {rule}: {effect}", rule=quoted(new or ""), effect=effect)
    if new is None:
        return sentence("removed rule {rule}: {effect}", rule=quoted(old), effect=effect)
    return sentence("rule {rule}: {effect}", rule=quoted(new), effect=effect)


def _with_example(what: str, change: Change | ConflictChange) -> str:
    """The change, the number of situations that it affects, and one of them."""
    where = extent_text(change.extent._replace(over=()))
    return sentence(
        "{change}, {extent}. Example: {situation}", change=what, extent=where, situation=witness_text(change.witness)
    )
