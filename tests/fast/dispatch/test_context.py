"""Changes of context: atomic, exact, and only the affected rules are decided again."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.dispatch import snapshot as snapshot_module
from sleec_runtime.errors import SleecError
from sleec_runtime.evaluation import hedge_chain
from sleec_runtime.support.chunked_sequence import Chunks
from tests.support.robots import CURTAINS, listing_2, running

MEASURES = """
MEASURE Risk: low < high
MEASURE Temperature: number
CONDITION Never_used, Asleep
RULE warm WHEN a THEN Open UNLESS Temperature > 36.6 IN WHICH CASE Call
RULE risky WHEN a THEN Open UNLESS Risk = high IN WHICH CASE Call
RULE other WHEN b THEN Wait UNLESS Asleep IN WHICH CASE Leave
"""


@pytest.fixture
def looked_at(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The labels of the rules that are evaluated."""
    labels: list[str] = []
    walk = hedge_chain.walk

    def walked(rule: Any, *rest: Any) -> Any:
        labels.append(rule.label)
        return walk(rule, *rest)

    monkeypatch.setattr(snapshot_module, "walk", walked)
    return labels


def test_only_rules_that_mention_a_changed_condition_are_decided_again(looked_at: list[str]) -> None:
    sleec = running(MEASURES)
    assert sorted(looked_at) == ["other", "risky", "warm"]
    listing_2(sleec)
    looked_at.clear()
    for changes, expected in (
        ({"Temperature": 37}, ["warm"]),
        ({"Temperature": 37.0}, []),
        ({"Never_used": True}, []),
        ({"Risk": "high", "Asleep": True}, ["other", "risky"]),
        ({"Temperature": None}, ["warm"]),
    ):
        sleec.update(changes)
        assert sorted(looked_at) == expected
        looked_at.clear()
        sleec.trigger("a")
        sleec.trigger("a")
        assert looked_at == [], "a dispatch decides nothing anew"


def test_a_change_is_whole_or_not_at_all() -> None:
    sleec = running(MEASURES)
    sleec.update({"Asleep": True})
    for broken in ({"Asleep": False, "Risk": "medium"}, {"Asleep": False, "Awake": True}):
        with pytest.raises(SleecError):
            sleec.update(broken)
        assert dict(sleec.conditions) == {"Asleep": True}
        assert sleec.due("b").obligations == ("Leave",)


def test_who_holds_a_context_keeps_it() -> None:
    sleec = running(CURTAINS)
    before = sleec.conditions
    sleec.update({"UserUndressed": True})
    assert dict(before) == {}
    assert dict(sleec.conditions) == {"UserUndressed": True}
    assert sleec.conditions["UserUndressed"] is True
    assert "UserDistressed" not in sleec.conditions
    assert len(sleec.conditions) == 1
    assert repr(sleec.conditions) == "Conditions({'UserUndressed': True})"
    with pytest.raises(KeyError):
        sleec.conditions["UserDistressed"]
    with pytest.raises(TypeError):
        sleec.conditions["UserDistressed"] = True  # type: ignore[index]


@pytest.mark.parametrize(
    ("value", "known", "call"),
    [
        (36.6, Fraction(183, 5), False),
        (Decimal("36.6"), Fraction(183, 5), False),
        (36.61, Fraction(3661, 100), True),
        (37.0, 37, True),
        (-0.0, 0, False),
        (1e22, 10**22, True),
    ],
)
def test_measures_are_exact(value: object, known: object, call: bool) -> None:
    sleec = running(MEASURES)
    sleec.update({"Temperature": value})
    assert sleec.conditions["Temperature"] == known
    assert sleec.due("a").obligations == (("Call", "Open") if call else ("Open",))


def test_numbers_of_other_libraries_count_by_what_they_print() -> None:
    class Float32(float):
        def __repr__(self) -> str:
            return "float32(36.6)"

    sleec = running(MEASURES)
    sleec.update({"Temperature": Float32(36.6)})
    assert sleec.conditions["Temperature"] == Fraction(183, 5)


def test_a_change_is_told_with_the_rules_concerned() -> None:
    sleec = running(MEASURES)
    told = []
    end = sleec.listen(lambda before, after, rules: told.append((after.number, [rule.label for rule in rules])))
    sleec.update({"Asleep": True})
    sleec.update({"Asleep": True})
    end()
    sleec.update({"Asleep": False})
    assert told == [(1, ["other"])]


@given(st.lists(st.integers()), st.data())
def test_chunks_are_a_sequence_that_is_replaced(items: list[int], data: st.DataObject) -> None:
    chunks = Chunks.of(items)
    places = st.integers(0, len(items) - 1) if items else st.nothing()
    changes = data.draw(st.dictionaries(places, st.integers()))
    after = chunks.replaced(changes)
    assert [chunks[i] for i in range(len(items))] == items
    assert [after[i] for i in range(len(items))] == [changes.get(i, item) for i, item in enumerate(items)]
    for index in range(len(items)):
        row, column = chunks.place(index)
        assert after.rows[row][column] == after[index]
