"""Two texts of rules, compared."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from sleec_verify.changes.compare import Relation, compare
from sleec_verify.encoding.trace_scope import speaks_of_traces
from sleec_verify.report.difference import RENDERERS
from sleec_verify.report.difference_report import DifferenceReport, RulesetDifference
from sleec_verify.report.palette import PLAIN
from tests.fuzz.rules import little_budget, read

SEPARATOR = b"====\n"
"""Between the old text and the new one."""

_MIRRORED: dict[Relation, Relation] = {"stricter": "laxer", "laxer": "stricter"}


def diff(data: bytes, folder: Path) -> None:
    """The other way round, the relation is mirrored."""
    before, separator, after = data.partition(SEPARATOR)
    old, new = read(before), read(after if separator else before)
    if old is None or new is None or speaks_of_traces(old) or speaks_of_traces(new):
        return
    difference = compare(old, new)
    back = compare(new, old).relation
    assert back == _MIRRORED.get(difference.relation, difference.relation)
    with little_budget(data):
        assert compare(old, new).relation in (difference.relation, "unknown")
    report = DifferenceReport((RulesetDifference("fuzz.sleec", difference),), 0, ())
    for render in RENDERERS.values():
        assert "".join(render(report, PLAIN))


def seeds() -> Iterator[bytes]:
    texts = (
        b"WHEN T THEN X UNLESS a IN WHICH CASE Y UNLESS m < 3 IN WHICH CASE Z\n",
        b"WHEN T THEN X AND Z UNLESS m <= 3 IN WHICH CASE (Y AND NOT X)\nASSUME a OR m > 1\n",
        b"MEASURE s: low < high\nEXCLUSIVE X, Y\nWHEN T AND s = low THEN X\nWHEN U THEN Y\nNEVER X AND Z\n",
        b"DOMAIN home\nWHEN T THEN X UNLESS a\nDOMAIN ward\nWHEN T THEN Y\nASSUME NOT (T AND U)\nWHEN U THEN X\n",
    )
    yield from (old + SEPARATOR + new for old in texts for new in texts)
