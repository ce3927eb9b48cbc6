"""Edits of a text, and where the rest of it is afterwards."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_verify.repairs.edit import OffsetMap, OverlappingEdits, TextEdit, edited, in_order, joined

TEXT = "0123456789"


def test_everything_else_stays() -> None:
    assert edited(TEXT, [TextEdit(8, 9, ""), TextEdit(2, 2, "ab"), TextEdit(3, 5, "c")]) == "01ab2c5679"


@pytest.mark.parametrize(
    "edits", [(TextEdit(1, 4, ""), TextEdit(3, 5, "x")), (TextEdit(2, 2, "a"), TextEdit(2, 2, "b"))]
)
def test_edits_of_the_same_place_overlap(edits: tuple[TextEdit, ...]) -> None:
    with pytest.raises(OverlappingEdits, match="the same part of the text"):
        edited(TEXT, edits)


def test_insertions_at_one_place_are_one_in_their_order() -> None:
    edits = joined([TextEdit(2, 2, "b"), TextEdit(0, 1, ""), TextEdit(2, 2, "a")])
    assert edited(TEXT, edits) == "1ba23456789"


@given(
    st.lists(st.integers(0, 10), min_size=2, max_size=8, unique=True), st.lists(st.text("xy", max_size=3), min_size=4)
)
def test_a_character_is_found_after_the_edits(borders: list[int], texts: list[str]) -> None:
    ordered = sorted(borders)
    edits = in_order(TextEdit(start, end, text) for start, end, text in zip(ordered[::2], ordered[1::2], texts))
    after = edited(TEXT, edits)
    offsets = OffsetMap(edits)
    for offset, character in enumerate(TEXT):
        place = offsets.after(offset)
        if place is None:
            assert any(edit.start <= offset < edit.end for edit in edits)
        else:
            assert after[place] == character
