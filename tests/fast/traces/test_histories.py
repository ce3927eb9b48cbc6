"""Histories that lead to a situation, also if the search for a smaller one is not decided."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from sleec_runtime.language import parse
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.traces.components import components
from sleec_verify.traces.conflicts import Conflict, ConflictSearch
from sleec_verify.traces.histories import Histories
from sleec_verify.traces.index import trace_index_of

TEXT = """
RULE R1
WHEN A THEN X WITHIN 3 minutes
RULE R2
WHEN B THEN NOT X WITHIN 2 minutes
"""


def _conflicts() -> Iterator[Conflict]:
    for component in components(trace_index_of(RulesetIndex(parse(TEXT)))):
        yield from ConflictSearch(component).find()


def test_a_history_has_no_unnecessary_events() -> None:
    (conflict,) = _conflicts()
    assert [sorted(moment.events) for moment in conflict.history] == [["A"]]


@pytest.mark.parametrize("answered", [0, 1, 2])
def test_a_history_stays_if_it_is_undecided_whether_an_event_is_needed(
    answered: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`answered` is the number of questions about a smaller history that are answered."""
    ask, history = Histories.ask, Histories.history
    left = [0]

    def undecided(self: Histories, *required: int, **more: object) -> bool:
        if left[0] == 0:
            raise Undecided("the solver reached its limit of conflicts")
        left[0] -= 1
        return ask(self, *required)

    def limited(self: Histories) -> tuple[list[object], int]:
        left[0] = answered
        with monkeypatch.context() as patch:
            patch.setattr(Histories, "ask", undecided)
            return history(self)  # type: ignore[return-value]

    monkeypatch.setattr(Histories, "history", limited)
    (conflict,) = _conflicts()
    assert [moment.events for moment in conflict.history if "A" in moment.events]
    assert conflict.now.events == {"B"}
