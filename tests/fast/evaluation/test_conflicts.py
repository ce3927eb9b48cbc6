"""What cannot be done together: contradictions, EXCLUSIVE and NEVER, against every assignment."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.evaluation.conflicts import Conflict, conflict, find_conflict, missing_for
from sleec_runtime.evaluation.formula_truth import Situation, truth
from sleec_runtime.model import (
    And,
    Atom,
    Clause,
    Context,
    Exclusive,
    Formula,
    Never,
    Not,
    Obligation,
    Or,
    Rule,
    Ruleset,
)

NAMES = ("A", "B", "C", "D")
A, B, C, D = (Atom("obligation", name) for name in NAMES)
WET = Atom("condition", "Wet")


def rule(label: str, *texts: str) -> Rule:
    literals = tuple(Obligation(text.lstrip("-"), text.startswith("-")) for text in texts)
    return Rule(label, "T", None, Clause(None, literals), ())


def found(*statements: Rule | Exclusive | Never, **conditions: bool) -> Conflict | None:
    return conflict(Ruleset(statements), Context(frozenset({"T"}), conditions))


def test_positive_obligations_alone_never_conflict() -> None:
    assert found(rule("r1", "A", "B"), rule("r2", "B", "C")) is None


def test_a_name_and_its_negation() -> None:
    contradiction = found(rule("r1", "A", "B"), rule("r2", "C", "-B"))
    assert contradiction == Conflict((Obligation("B"), Obligation("B", negated=True)))


def test_two_of_an_exclusive_set() -> None:
    exclusive = Exclusive(("A", "B", "C"))
    assert found(exclusive, rule("r1", "A", "D")) is None
    assert found(exclusive, rule("r1", "A", "D"), rule("r2", "C")) == Conflict(
        (Obligation("A"), Obligation("C")), (exclusive,)
    )


def test_a_never_counts_where_its_conditions_hold() -> None:
    never = Never(And((A, WET)))
    assert found(never, rule("r1", "A")) is None
    assert found(never, rule("r1", "A", "B"), Wet=True) == Conflict((Obligation("A"),), (never,))


def test_what_is_not_due_may_be_done_to_keep_a_never() -> None:
    needs_b = Never(And((A, Not(B))))
    assert found(needs_b, rule("r1", "A")) is None
    assert found(needs_b, rule("r1", "A", "-B")) is not None
    assert found(needs_b, Exclusive(("B", "C")), rule("r1", "A", "C")) is not None


def test_a_situation_may_be_forbidden_whatever_is_done() -> None:
    never = Never(WET)
    assert found(never, rule("r1", "A"), Wet=True) == Conflict((), (never,))
    assert found(never, rule("r1", "A")) is None


def test_in_the_open_world_a_never_that_may_come_true_counts() -> None:
    never = Never(And((A, WET)))
    open_world = Situation(Context(frozenset({"T"})), absent=None)
    assert find_conflict((Obligation("A"),), (never,), open_world) is not None
    assert find_conflict((Obligation("A", negated=True),), (never,), open_world) is None
    assert missing_for((never, Exclusive(("A", "B"))), open_world) == ("Wet",)


def formulas() -> st.SearchStrategy[Formula]:
    return st.recursive(
        st.sampled_from([A, B, C, D, WET]),
        lambda inner: st.one_of(
            inner.map(Not),
            st.tuples(inner, inner).map(And),
            st.tuples(inner, inner).map(Or),
        ),
        max_leaves=5,
    )


constraints_strategy = st.lists(
    st.one_of(
        formulas().map(Never),
        st.lists(st.sampled_from(NAMES), min_size=2, max_size=4, unique=True).map(
            lambda names: Exclusive(tuple(names))
        ),
    ),
    max_size=4,
)
literals_strategy = st.lists(st.builds(Obligation, st.sampled_from(NAMES), st.booleans()), max_size=4, unique=True)


def has_model(literals: tuple[Obligation, ...], constraints: tuple[Exclusive | Never, ...], context: Context) -> bool:
    """By every assignment of the four obligations."""

    def respects(values: dict[str, bool], constraint: Exclusive | Never) -> bool:
        if isinstance(constraint, Exclusive):
            return sum(values[name] for name in constraint.names) <= 1
        return truth(constraint.formula, Situation(context, obliged=values)) is False

    assignments = (dict(zip(NAMES, bits, strict=True)) for bits in product((False, True), repeat=len(NAMES)))
    return any(
        all(values[literal.name] is not literal.negated for literal in literals)
        and all(respects(values, constraint) for constraint in constraints)
        for values in assignments
    )


@pytest.mark.parametrize("wet", [False, True])
@given(literals=literals_strategy, constraints=constraints_strategy)
def test_a_conflict_is_the_absence_of_a_model_and_its_cause_is_smallest(
    wet: bool, literals: list[Obligation], constraints: list[Exclusive | Never]
) -> None:
    context = Context(frozenset({"T"}), {"Wet": wet})
    cause = find_conflict(literals, constraints, Situation(context))
    assert (cause is None) == has_model(tuple(literals), tuple(constraints), context)
    if cause is not None:
        assert not has_model(cause.literals, cause.constraints, context)
        for literal in cause.literals:
            assert has_model(tuple(x for x in cause.literals if x != literal), cause.constraints, context)
        for constraint in cause.constraints:
            rest = tuple(x for x in cause.constraints if x is not constraint)
            assert has_model(cause.literals, rest, context)
