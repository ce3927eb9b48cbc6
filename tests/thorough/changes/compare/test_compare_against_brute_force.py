"""What `compare` says of random edits is what brute force over all contexts says: nothing missed, nothing invented, and
the counts exact."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.model import Assume, Never, Rule, Ruleset
from sleec_verify.changes.compare import compare, relation
from tests.support import brute_force as brute
from tests.support.edits import edited, forbidding, forbidding_otherwise, reordered, tied
from tests.support.small_rulesets import small_rulesets

PLAIN = edited(small_rulesets(constraints=False, assumptions=False))
CONSTRAINED = edited(small_rulesets(rules=3))
TIED = edited(tied(small_rulesets(rules=3, hedges=1, nested=False, assumptions=False)))
FORBIDDING = forbidding(small_rulesets(rules=3, hedges=1, nested=False, constraints=False))
MEASURED = edited(small_rulesets(measures=True, rules=2, hedges=1, nested=False))


class Seen:
    """One context, as brute force sees it on both sides."""

    def __init__(self, old: Ruleset, new: Ruleset, context) -> None:
        self.context = context
        self.allowed = [_allows(side, context) for side in (old, new)]
        self.active = [brute.active_clauses(side, context) for side in (old, new)]
        self.due = [frozenset(o for _, _, c in active for o in c.obligations) for active in self.active]
        self.clash = [brute.clash(side, context, due) for side, due in zip((old, new), self.due)]

    @property
    def compared(self) -> bool:
        return all(self.allowed) and not any(self.clash)


def _allows(ruleset, context) -> bool:
    return all(
        brute.value(c.formula, context, measures=ruleset.measures) for c in ruleset.constraints if isinstance(c, Assume)
    )


def every(old: Ruleset, new: Ruleset) -> list[Seen]:
    """All contexts over the names of both, whatever is assumed."""
    both = Ruleset(
        (
            *old.measures.values(),
            *(replace(s, label=f"old_{s.label}") if isinstance(s, Rule) else s for s in old.rules + old.constraints),
            *new.rules,
            *new.constraints,
        )
    )
    free = replace(both, statements=tuple(s for s in both.statements if not isinstance(s, Assume)))
    # The names of assumptions are looked at all the same.
    names = Ruleset((*free.statements, *(Never(s.formula) for s in both.constraints if isinstance(s, Assume))))
    return [Seen(old, new, context) for context in brute.contexts(names)]


def projected(extent, seen: Seen, ruleset: Ruleset):
    """What a context says of the names that an extent counts over."""
    said: list[Any] = []
    for part in extent.over:
        for kind, name in part.names:
            if kind == "trigger":
                said.append(name in seen.context.triggers)
            elif not part.cuts:
                said.append(seen.context.conditions.get(name, False))
        for name, cuts in part.cuts:
            value = seen.context.conditions[name]
            said.append(tuple(value < cut.value or (cut.inclusive and value == cut.value) for cut in cuts))
        for x, y in part.orders:
            a, b = (seen.context.conditions[name] for name in (x, y))
            said.append((a > b) - (a < b))
    return tuple(said)


def agree(old: Ruleset, new: Ruleset) -> None:
    found = compare(old, new)
    assert not found.undecided or not any(all(s.allowed) for s in every(old, new)), found.undecided
    contexts = every(old, new)
    sides = (old, new)

    # Obligations: by rule and literal.
    told = {}
    for change in found.changes:
        for side, label, literals in ((0, change.old_rule, change.removed), (1, change.new_rule, change.added)):
            for literal in literals:
                assert (side, label, literal) not in told
                told[side, label, literal] = change
    expected: dict[tuple[int, str, Any], list[Seen]] = {}
    for seen in contexts:
        if seen.compared:
            for side in (0, 1):
                for label, _, clause in seen.active[side]:
                    for literal in clause.obligations:
                        if literal not in seen.due[1 - side]:
                            expected.setdefault((side, label, literal), []).append(seen)
    assert told.keys() == expected.keys()
    for key, where in expected.items():
        change = told[key]
        extent = change.extent
        assert extent.affected == len({projected(extent, seen, new) for seen in where})
        given_occur = [
            seen for seen in contexts if all(seen.allowed) and seen.context.triggers.issuperset(extent.given)
        ]
        assert extent.possible == len({projected(extent, seen, new) for seen in given_occur})
        shown = Seen(old, new, change.witness.context())
        assert shown.compared
        assert key[2] not in shown.due[1 - key[0]]
        assert key[1] in {label for label, _, clause in shown.active[key[0]] if key[2] in clause.obligations}
        assert {(d.rule, d.clause) for d in change.before} == {(r, n) for r, n, _ in shown.active[0]}
        assert {(d.rule, d.clause) for d in change.after} == {(r, n) for r, n, _ in shown.active[1]}

    # Conflicts.
    for side, way in ((0, "removed"), (1, "added")):
        entries = [one for one in found.conflicts if one.way == way]
        where = [s for s in contexts if all(s.allowed) and s.clash[side] and not s.clash[1 - side]]
        fires = {
            id(one): {
                id(s)
                for s in where
                if set(one.literals) <= _due_by(s, side, one.rules)
                and brute.clash(sides[side], s.context, one.literals)
            }
            for one in entries
        }
        assert {id(s) for s in where} == set().union(*fires.values())
        for one in entries:
            smaller = [
                other for other in entries if other.literals == one.literals and set(other.rules) < set(one.rules)
            ]
            rest = fires[id(one)].difference(*(fires[id(other)] for other in smaller))
            assert rest
            if sum(other.literals == one.literals and other.rules == one.rules for other in entries) == 1:
                fired = [s for s in where if id(s) in rest]
                # Where fewer of these literals clash already, the constraint that the entry is about may hold.
                alone = [s for s in fired if not _fewer_clash(sides[side], s, one.literals)]
                least, most = (len({projected(one.extent, s, new) for s in some}) for some in (alone, fired))
                assert one.extent.affected is not None
                assert least <= one.extent.affected <= most
            shown = Seen(old, new, one.witness.context())
            assert all(shown.allowed)
            assert [shown.clash[side], shown.clash[1 - side]] == [True, False]

    # Situations.
    for side, way in ((1, "removed"), (0, "added")):
        ruled_out = [one for one in found.situations if one.way == way]
        where = [s for s in contexts if s.allowed[1 - side] and not s.allowed[side]]
        assert bool(ruled_out) == bool(where)
        for situation in ruled_out:
            assert situation.witness is not None
            shown = Seen(old, new, situation.witness.context())
            assert shown.allowed[1 - side]
            assert not shown.allowed[side]
        if len(ruled_out) == 1:
            there = ruled_out[0].extent
            assert there is not None
            own = {c.formula for c in sides[side].constraints if isinstance(c, Assume)}
            theirs = {c.formula for c in sides[1 - side].constraints if isinstance(c, Assume)}
            if len(own - theirs) == 1:
                assert there.affected == len({projected(there, s, new) for s in where})

    more = any(side == 1 for side, *_ in expected) or any(s.way == "added" for s in found.situations)
    less = any(side == 0 for side, *_ in expected) or any(s.way == "removed" for s in found.situations)
    assert found.relation == relation(more, less, bool(found.conflicts), bool(found.undecided))


def _fewer_clash(ruleset: Ruleset, seen: Seen, literals) -> bool:
    return any(brute.clash(ruleset, seen.context, set(literals) - {one}) for one in literals)


def _due_by(seen: Seen, side: int, rules) -> set[Any]:
    return {o for label, _, clause in seen.active[side] if label in rules for o in clause.obligations}


@settings(max_examples=100)
@given(PLAIN)
def test_rules(pair) -> None:
    agree(*pair)


@pytest.mark.slow
@settings(max_examples=150)
@given(CONSTRAINED)
def test_constraints_and_assumptions(pair) -> None:
    agree(*pair)


@pytest.mark.slow
@settings(max_examples=100)
@given(TIED)
def test_triggers_that_assumptions_tie(pair) -> None:
    agree(*pair)


@pytest.mark.slow
@settings(max_examples=100)
@given(forbidding_otherwise(FORBIDDING))
def test_constraints_that_leave_nothing_to_do(pair) -> None:
    agree(*pair)


@pytest.mark.slow
@settings(max_examples=100)
@given(st.data(), FORBIDDING)
def test_the_order_of_constraints_and_of_their_literals(data, old) -> None:
    new = data.draw(reordered(old))
    agree(old, new)
    found = compare(old, new)
    assert (found.relation, found.undecided) in (("equivalent", ()), ("unknown", compare(old, old).undecided))


@settings(max_examples=25)
@given(MEASURED)
def test_measures(pair) -> None:
    agree(*pair)


@pytest.mark.long
@settings(max_examples=3000)
@given(CONSTRAINED)
def test_many(pair) -> None:
    agree(*pair)


@pytest.mark.long
@settings(max_examples=2000)
@given(TIED)
def test_many_ties(pair) -> None:
    agree(*pair)


@pytest.mark.long
@settings(max_examples=2000)
@given(forbidding_otherwise(FORBIDDING))
def test_many_constraints_that_leave_nothing_to_do(pair) -> None:
    agree(*pair)


@pytest.mark.long
@settings(max_examples=300)
@given(MEASURED)
def test_many_measures(pair) -> None:
    agree(*pair)
