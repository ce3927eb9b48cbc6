"""Alignment: the equal rules of two rulesets, and pairs of rules that correspond although they differ.

Equal rules oblige equally, so only the other rules are compared.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from sleec_runtime.model import Clause, Formula, Rule, in_text_order


class RulePair(NamedTuple):
    """A rule before and after; None on the side that has no such rule."""

    old: Rule | None
    new: Rule | None


@dataclass
class Alignment:
    """`same` are equal but for their labels; `changed` are all others, in the order of the new text, gone ones last."""

    same: list[tuple[Rule, Rule]] = field(default_factory=list)
    changed: list[RulePair] = field(default_factory=list)
    reordered: bool = False

    @property
    def renamed(self) -> list[tuple[str, str]]:
        """The labels of equal rules that are called otherwise now; a rule without a label is called by its number."""
        return [(old.label, new.label) for old, new in self.same if old.label != new.label and _labelled(old, new)]


def _labelled(old: Rule, new: Rule) -> bool:
    return old.labelled or new.labelled


def align(old: Sequence[Rule], new: Sequence[Rule], cancels: Callable[[Rule], bool]) -> Alignment:
    """Match the rules of two rulesets. `cancels` says of a rule that stands on both sides whether it means the same on
    both.

    First by label, then by what they say, then rules of one label that differ, then, in their order, rules of one
    trigger. O(size of the rules).
    """
    found = Alignment()
    place: dict[str, int] = {}
    for at, rule in enumerate(new):
        place.setdefault(rule.label, at)
    partner: dict[int, int] = {}
    taken: set[int] = set()
    left: list[int] = []
    for at, rule in enumerate(old):
        other = place.get(rule.label)
        if other is not None and other not in taken and _equal(rule, new[other]):
            partner[at] = other
            taken.add(other)
        else:
            left.append(at)
    open_new = [at for at in range(len(new)) if at not in taken]
    for key in (_said, _label, _trigger):
        left, open_new = _match(old, new, left, open_new, key, partner)
    _sort(found, old, new, partner, cancels)
    found.changed += (RulePair(None, new[at]) for at in open_new)
    order = {id(rule): at for at, rule in enumerate(new)}
    found.changed.sort(key=lambda pair: order[id(pair.new)] if pair.new is not None else len(order))
    found.changed += (RulePair(old[at], None) for at in left)
    return found


def _sort(
    found: Alignment, old: Sequence[Rule], new: Sequence[Rule], partner: dict[int, int], cancels: Callable[[Rule], bool]
) -> None:
    last = -1
    for at in sorted(partner):
        one, other = old[at], new[partner[at]]
        if _equal(one, other) and cancels(one):
            found.same.append((one, other))
            found.reordered = found.reordered or partner[at] < last
            last = max(last, partner[at])
        elif one.trigger == other.trigger:
            found.changed.append(RulePair(one, other))
        else:
            # What the one says of its trigger has nothing to do with what the other says of another.
            found.changed += (RulePair(one, None), RulePair(None, other))


def _match(
    old: Sequence[Rule],
    new: Sequence[Rule],
    left: list[int],
    open_new: list[int],
    key: Callable[[Rule], object],
    partner: dict[int, int],
) -> tuple[list[int], list[int]]:
    if not left or not open_new:
        return left, open_new
    waiting: dict[object, list[int]] = {}
    for at in reversed(open_new):
        waiting.setdefault(key(new[at]), []).append(at)
    unmatched = []
    for at in left:
        others = waiting.get(key(old[at]))
        if others:
            partner[at] = others.pop()
        else:
            unmatched.append(at)
    taken = set(partner.values())
    return unmatched, [at for at in open_new if at not in taken]


def _equal(one: Rule, other: Rule) -> bool:
    return (
        one.trigger == other.trigger
        and one.default == other.default
        and one.hedges == other.hedges
        and one.guard == other.guard
    )


def _said(rule: Rule) -> tuple[str, Formula | None, Clause, tuple[Clause, ...]]:
    return rule.trigger, rule.guard, rule.default, rule.hedges


def _label(rule: Rule) -> object:
    # A number is no name: rules without labels meet by what they say, or by their triggers.
    return rule.label if rule.labelled else rule


def _trigger(rule: Rule) -> str:
    return rule.trigger


def depends_on_reading(rule: Rule) -> bool:
    """Whether a chain of the rule, or of what is due in place of a response, has two hedges or more: only there the
    readings can differ."""
    return len(rule.hedges) > 1 or any(map(_has_several, rule.clauses()))


def _has_several(clause: Clause) -> bool:
    return len(clause.hedges) > 1 or any(
        _has_several(inner)
        for obligation in clause.obligations
        if obligation.timing is not None
        for alternative in obligation.timing.alternatives()
        for inner in in_text_order(alternative)
    )
