"""If the assumptions contradict each other, nothing else is reported about the rules."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks

RULES = """RULE a WHEN UserCalls THEN Answer{0} UNLESS Day IN WHICH CASE NOT Answer
RULE b WHEN UserCalls THEN NOT Answer
RULE c WHEN UserCalls AND Day THEN Answer
RULE d WHEN UserCalls THEN Answer
"""

DSL = """def_start event A event B measure p: boolean def_end
rule_start R1 when A and {p} then B R2 when A then B within 2 seconds unless {p} then not B rule_end
concern_start c1 exists A while B concern_end purpose_start p1 exists A while B purpose_end
relation_start measure invariant {p} measure invariant (not {p}) relation_end
"""


@pytest.mark.parametrize(
    "text",
    [
        "ASSUME Day\nASSUME NOT Day\n" + RULES.format(""),
        "ASSUME Day\nASSUME NOT Day\n" + RULES.format(" WITHIN 2 minutes"),
        "RELATION ALWAYS Day\nRELATION ALWAYS NOT Day\n" + RULES.format(""),
        DSL,
    ],
)
def test_nothing_but_the_contradiction_is_reported(text: str) -> None:
    assert {finding.code for result in run_checks(parse(text)) for finding in result.findings} == {"SLEEC103"}
