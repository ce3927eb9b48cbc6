"""The conflicts of examples computed elsewhere are confirmed: nearly all by all responses of their rules."""

from __future__ import annotations

import json

import pytest

from sleec_runtime.language import parse
from sleec_verify.encoding.solver import Undecided
from sleec_verify.replay import conflicts
from sleec_verify.traces.components import components
from sleec_verify.traces.conflicts import Conflict, ConflictSearch
from sleec_verify.traces.index import TraceIndex
from tests.support.paths import ROOT

EXAMPLES = ROOT.parent / "shared" / "conflict-examples-2.json"


@pytest.mark.slow
@pytest.mark.skipif(not EXAMPLES.exists(), reason="the examples are not there")
def test_the_conflicts_of_the_examples_are_confirmed(monkeypatch: pytest.MonkeyPatch) -> None:
    refuted: list[Conflict] = []
    check_refutation = conflicts._is_refuted

    def counted(conflict: Conflict) -> bool:
        refuted.append(conflict)
        return check_refutation(conflict)

    monkeypatch.setattr(conflicts, "_is_refuted", counted)
    number = 0
    for example in json.loads(EXAMPLES.read_text(encoding="utf-8")):
        index = TraceIndex(parse(example["text"]))
        for component in components(index):
            try:
                for conflict in ConflictSearch(component).find():
                    number += 1
                    assert conflicts.is_confirmed(index, conflict), (example["name"], conflict.rules)
            except Undecided:
                continue
    assert number >= 150
    assert len(refuted) <= number / 20
