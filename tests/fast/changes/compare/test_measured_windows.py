"""Which response requires more, if measures give the lengths of windows: in which situations."""

from __future__ import annotations

from itertools import combinations, product

import pytest

from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_verify.changes.compare import compare
from sleec_verify.changes.compare.measured_windows import implied_where
from sleec_verify.encoding.measure_ranges import MeasureRanges

RESPONSES = (
    "X WITHIN 1 second",
    "NOT X WITHIN 1 second",
    "X WITHIN x seconds",
    "X WITHIN x TO y seconds",
    "NOT X WITHIN x seconds",
    "NOT X WITHIN x TO y seconds",
    "X WITHIN x seconds OTHERWISE Y WITHIN y seconds",
    "X WITHIN y seconds OTHERWISE Y WITHIN 1 second",
)
HEAD = "MEASURE x: integer\nMEASURE y: integer\nASSUME x >= 0 AND x <= 2 AND y >= 0 AND y <= 1\n"


def test_one_implies_the_other_where_every_trace_says_so() -> None:
    rules = [parse(f"{HEAD}RULE r WHEN t THEN {response}") for response in RESPONSES]
    moments = [frozenset(events) for size in range(2) for events in combinations("XY", size)]
    ranges = MeasureRanges(rules[0].constraints, rules[0].measures)
    said = [ruleset.rules[0].default.obligations[0] for ruleset in rules]
    for x, y in product(range(3), range(2)):
        values = {"x": x, "y": y}
        traces = [
            Trace(
                tuple(Instant(at, events | ({"t"} if at == 0 else set()), values) for at, events in enumerate(course))
            )
            for course in product(moments, repeat=4)
        ]
        kept = [{at for at, trace in enumerate(traces) if not violations(ruleset, trace)} for ruleset in rules]
        context = Context(frozenset(), values)
        for one, other in product(range(len(RESPONSES)), repeat=2):
            where = implied_where(said[one], said[other], "at", ranges)
            assert where is not None
            expected = kept[one] <= kept[other]
            assert holds(where, context, rules[0].measures) == expected, (RESPONSES[one], RESPONSES[other], values)


PATIENT = "EVENT Smoke, Call\nMEASURE patience: integer\nASSUME patience >= 1 AND patience <= 30\n"
WAIT = "RULE r WHEN Smoke THEN Call WITHIN patience minutes"


@pytest.mark.parametrize(
    ("window", "relation", "values"),
    [
        ("30 minutes", "laxer", [1]),
        ("31 minutes", "laxer", [1]),
        ("1 minute", "stricter", [2]),
        ("10 minutes", "incomparable", [1, 11]),
        ("patience hours", "laxer", [1]),
        ("1 TO patience minutes", "stricter", [1]),
    ],
)
def test_the_relation_counts_every_value(window: str, relation: str, values: list[int]) -> None:
    old, new = parse(PATIENT + WAIT), parse(PATIENT + WAIT.replace("patience minutes", window))
    found = compare(old, new)
    assert found.relation == relation
    assert [change.witness.conditions.get("patience", 1) for change in found.changes] == values


def test_without_a_range_the_relation_is_unknown() -> None:
    text = PATIENT.replace("ASSUME patience >= 1 AND patience <= 30\n", "")
    found = compare(parse(text + WAIT), parse(text + WAIT.replace("patience", "10")))
    assert found.relation == "unknown"
    assert compare(parse(text + WAIT), parse(text + WAIT)).relation == "equivalent"
