"""Assumptions that are cut down say the same of every situation that matters, by brute force and case by case."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.language import parse
from sleec_runtime.model import And, Atom, Comparison, Context, MeasureRef, Not, Number, Or, Truth
from sleec_verify.changes.compare import compare
from sleec_verify.query.assumption_slicing import AssumptionSlicing, conjuncts, without
from tests.support import brute_force as brute

A, B, C, D = (Atom("trigger", name) for name in "ABCD")
X, Y = (Atom("condition", name) for name in "XY")
WARM = Comparison(MeasureRef("Room"), ">", Number(20))


def implied(one, other):
    return Or((Not(one), other))


@pytest.mark.parametrize(
    ("assumed", "kept", "anywhere", "with_a"),
    [
        pytest.param([Not(And((A, B)))], "", "", "A", id="what is only ever kept from occurring need not occur"),
        pytest.param([implied(A, B), implied(B, C)], "", "", "ABC", id="what follows may have to occur"),
        pytest.param([implied(B, A)], "", "", "A", id="what it follows from need not occur"),
        pytest.param(
            [Or((A, Not(B))), Or((B, Not(A)))], "", "", "AB", id="two that only occur together need not occur"
        ),
        pytest.param([implied(B, C)], "B", "BC", "ABC", id="what is kept may occur with all that follows"),
        pytest.param([Or((B, X)), implied(B, C)], "", "BC", "ABC", id="what may come of no trigger"),
        pytest.param([implied(X, B)], "", "B", "AB", id="what a condition may bring about"),
        pytest.param([Or((X, Not(And((A, Not(B))))))], "", "", "AB", id="signs are those of the whole formula"),
        pytest.param([WARM, Truth(True)], "", "", "A", id="what speaks of no trigger asks for none"),
    ],
)
def test_triggers_that_may_have_to_occur(assumed, kept, anywhere, with_a) -> None:
    cutting = AssumptionSlicing(assumed, kept)
    assert cutting.anywhere == set(anywhere)
    assert cutting.occurring_with("A") == set(with_a)


@pytest.mark.parametrize(
    ("formula", "cut"),
    [
        (A, A),
        (B, Truth(False)),
        (X, X),
        (WARM, WARM),
        (Truth(True), Truth(True)),
        (Not(B), Truth(True)),
        (Not(A), Not(A)),
        (And((A, B)), Truth(False)),
        (And((A, X, Not(B))), And((A, X))),
        (And((Not(B), Not(C))), Truth(True)),
        (Or((B, X)), X),
        (Or((B, C)), Truth(False)),
        (Or((X, Not(B))), Truth(True)),
        (Or((X, And((Y, Not(B))), B)), Or((X, Y))),
    ],
    ids=str,
)
def test_where_nothing_but_a_occurs(formula, cut) -> None:
    assert without(formula, {"A"}) == cut


def test_conjunctions_are_taken_apart() -> None:
    parts = conjuncts([And((A, Not(Or((B, Not(C)))))), Not(Not(And((X, Y)))), Or((A, X))])
    assert list(parts) == [A, Not(B), C, X, Y, Or((A, X))]
    assert AssumptionSlicing([And((X, Y)), And((Y, X))], ()).formulas == [X, Y]


def test_what_shares_names_only_through_triggers_that_do_not_occur_is_left_out() -> None:
    cutting = AssumptionSlicing([Not(And((A, B, X))), implied(A, X), implied(X, Y), Or((D, WARM))], ())
    names = [("trigger", "A")]
    assert cutting.about(names, {"A"}) == [implied(A, X), implied(X, Y)]
    # The last one does not hold of nothing, so that a situation that is shown must name something for it.
    assert cutting.kept_by(names, {"A"}) == [implied(A, X), implied(X, Y), WARM]
    # What names B is found by that name, and says nothing where B does not occur.
    assert cutting.about([("trigger", "B")], {"A"}) == []


_literals = st.one_of(st.sampled_from([A, B, C, D, X, Y]), st.sampled_from([A, B, C, D, X, Y]).map(Not))
_formulas = st.recursive(
    _literals,
    lambda inner: st.one_of(
        inner.map(Not),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: And(tuple(parts))),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: Or(tuple(parts))),
    ),
    max_leaves=4,
)


@given(st.lists(_formulas, max_size=4), st.sets(st.sampled_from("ABCD"), max_size=2))
def test_all_other_triggers_can_be_taken_out_of_a_possible_situation(assumed, triggers) -> None:
    """The promise: whoever takes them out of a situation that the assumptions allow has one that they allow."""
    cutting = AssumptionSlicing(assumed, ())
    kept = cutting.occurring_with(triggers)
    assert triggers | cutting.anywhere <= kept
    cut = cutting.about([("trigger", name) for name in "ABCD"] + [("condition", name) for name in "XY"], kept)
    # Assumptions that leave no situation at all name nothing by which they could be found.
    refused = any(without(formula, kept) == Truth(False) for formula in cutting.formulas)
    for occur in product((False, True), repeat=4):
        for x, y in product((False, True), repeat=2):
            occurring = {name for name, yes in zip("ABCD", occur) if yes}
            whole, left = (Context(frozenset(some), {"X": x, "Y": y}) for some in (occurring, occurring & kept))
            if all(brute.value(formula, whole) for formula in assumed):
                assert all(brute.value(formula, left) for formula in [*assumed, *cut])
            if occurring <= kept and not refused:
                possible = all(brute.value(formula, whole) for formula in assumed)
                assert possible == all(brute.value(formula, whole) for formula in cut)


def _compared(text: str, added: str):
    return compare(parse(text + "\n"), parse(text + added + "\n"))


def test_a_trigger_that_a_constraint_brings_about_counts() -> None:
    """Where A is due, c9 must be false, and so Storm occurs, whose rule has Lock due anyway."""
    found = _compared(
        "NEVER A AND c9\nASSUME c9 OR Storm\nRULE two\nWHEN Storm THEN Lock\nRULE one\nWHEN Rung THEN A", " AND Lock"
    )
    assert (found.relation, found.changes) == ("equivalent", ())


def test_a_situation_names_no_trigger_that_need_not_occur() -> None:
    """Some name must stand for the first assumption; with another rule's trigger, Lock would be due anyway."""
    rules = "ASSUME Awake OR Alarm\nRULE two\nWHEN Alarm THEN Lock\nRULE one\nWHEN Rung THEN Open"
    for text in (rules, rules.replace("Awake", "Zz"), rules.replace("Alarm", "Zz")):
        (change,) = _compared(text, " AND Lock").changes
        assert change.witness.triggers == ("Rung",)
        assert [one.rule for one in (*change.before, *change.after)] == ["one", "one"]


def test_an_assumption_over_hundreds_of_triggers_costs_nothing() -> None:
    names = [f"T{number}" for number in range(600)]
    rules = "\n".join(f"WHEN {name} THEN O{name}" for name in names)
    text = f"ASSUME NOT (Asleep AND ({' OR '.join(names)}))\n{rules}"
    (change,) = _compared(text, " AND Lock").changes
    assert change.witness.triggers == ("T599",)
    assert (change.extent.affected, change.extent.possible) == (1, 1)


def test_an_assumption_that_is_new_says_nothing_of_other_triggers() -> None:
    names = [f"T{number}" for number in range(600)]
    rules = "\n".join(f"WHEN {name} THEN Act" for name in names)
    rest = f"ASSUME NOT (Asleep AND ({' OR '.join(names)}))\n{rules}\n"
    (change,) = compare(parse(rest), parse(f"ASSUME NOT (T1 AND T2)\n{rest}")).situations
    assert change.witness is not None
    assert change.witness.triggers == ("T1", "T2")
    assert change.extent is not None
    # T1, T2 and Asleep: asleep none of them occurs, so that 4 + 1 are possible.
    assert (change.extent.affected, change.extent.possible) == (1, 5)


def test_counting_is_given_up_past_a_number_of_names() -> None:
    """Each name is a step of a recursion, which must not end in an error."""
    chain = "\n".join(f"ASSUME NOT C{number} OR C{number + 1}" for number in range(260))
    (change,) = compare(
        parse(f"{chain}\nWHEN T THEN A\n"), parse(f"{chain}\nWHEN T THEN A UNLESS C257 IN WHICH CASE A AND B\n")
    ).changes
    assert change.extent.affected is None
    assert change.extent.why == "it depends on more than 250 names"
