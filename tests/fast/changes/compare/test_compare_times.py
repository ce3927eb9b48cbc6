"""Which response asks for more, with its windows and what is due in its place."""

from __future__ import annotations

from itertools import combinations, product

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.language import parse
from sleec_verify.changes.compare.timing_order import implies

RESPONSES = (
    "X",
    "NOT X",
    "X WITHIN 1 second",
    "X WITHIN [1, 2] seconds",
    "NOT X WITHIN 1 second",
    "X WITHIN 1 second OTHERWISE Y",
    "X WITHIN 1 second OTHERWISE Y WITHIN 1 second",
    "X WITHIN 1 second OTHERWISE NOT Y WITHIN 1 second",
    "X WITHIN 1 second OTHERWISE (X AND Y)",
    "X WITHIN 1 second OTHERWISE X WITHIN 1 second",
    "NOT X WITHIN 1 second OTHERWISE Y",
    "NOT X WITHIN 1 second OTHERWISE NOT X WITHIN 1 second",
    "X ELSE Y",
    "X ELSE NOT X",
    "Y WITHIN 2 seconds ELSE X WITHIN 1 second",
    "X WITHIN 1 second OTHERWISE Y WITHIN 1 second OTHERWISE X",
)


def test_what_asks_for_more_is_what_no_trace_keeps_without_keeping_the_other() -> None:
    """As the evaluator of traces has it, in all traces of as many seconds as the windows can tell apart."""
    rules = [parse(f"RULE r\nWHEN t THEN {response}\nRULE z\nWHEN u THEN V WITHIN 1 second") for response in RESPONSES]
    moments = [frozenset(events) for size in range(3) for events in combinations("XY", size)]
    traces = [
        Trace(tuple(Instant(at, events | ({"t"} if at == 0 else set())) for at, events in enumerate(course)))
        for course in product(moments, repeat=4)
    ]
    kept = [{at for at, trace in enumerate(traces) if not violations(ruleset, trace)} for ruleset in rules]
    said = [ruleset.rules[0].default.obligations[0] for ruleset in rules]
    for one, other in product(range(len(RESPONSES)), repeat=2):
        assert implies(said[one], said[other]) == (kept[one] <= kept[other]), (RESPONSES[one], RESPONSES[other])
