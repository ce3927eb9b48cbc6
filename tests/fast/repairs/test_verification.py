"""Which candidates are repairs."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import Checking, run_checks
from sleec_verify.encoding.budget import current, limited
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.verification import Rejected, Verification
from sleec_verify.results.finding import Finding

RULES = "RULE a\nWHEN T THEN A\nRULE b\nWHEN T AND c THEN NOT A\n"


def verified(text: str, old: str, new: str) -> None:
    ruleset = parse(text)
    results = run_checks(ruleset)
    (finding,) = (finding for result in results for finding in result.findings if finding.code == "SLEEC101")
    start = text.index(old)
    Verification(ruleset, results).repaired(
        finding, Candidate("response-refinement", "change it", (TextEdit(start, start + len(old), new),))
    )


def test_a_repair_removes_the_finding() -> None:
    verified(RULES, "NOT A", "NOT B")


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("AND c", "AND d", "the finding stays"),
        ("NOT A", "WITHIN", "the text is not a ruleset"),
        ("NOT A", "B\nUNLESS d", "SLEEC503 appears: the exception `UNLESS d` of rule `b` does not say what to do"),
        ("NOT A", "A", "SLEEC301 appears: rule `b`"),
    ],
)
def test_anything_else_is_rejected(old: str, new: str, why: str) -> None:
    with pytest.raises(Rejected, match=why):
        verified(RULES, old, new)


def test_a_finding_without_a_label_is_the_same_when_its_number_changes() -> None:
    text = "WHEN T THEN A\nWHEN T THEN NOT A\nWHEN S THEN B\nUNLESS d\n"
    verified(text, "WHEN T THEN A\n", "")


def test_an_exception_about_a_finding_ends_the_checks_and_their_budgets() -> None:
    def stop(finding: Finding) -> None:
        raise Rejected(finding.code)

    ruleset = parse(RULES)
    with limited(60):
        before = current()
        with pytest.raises(Rejected, match="SLEEC101"):
            Checking(ruleset, seen=stop).results(["conflict"])
        assert current() is before


def test_an_always_beside_a_repair_stays_the_same() -> None:
    """It is a rule for each trigger, and all of these have one place in the text."""
    text = RULES + "RULE d\nWHEN S THEN D\nALWAYS be polite\n"
    verified(text, "NOT A", "NOT B")
