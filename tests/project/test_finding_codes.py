"""Every finding code is documented, and its examples are what they claim to be."""

from __future__ import annotations

import re

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import CHECKS, Check, FindingKind, run_checks

KINDS = [(check, kind) for check in CHECKS.values() for kind in check.kinds]
EACH_KIND = pytest.mark.parametrize(("check", "kind"), KINDS, ids=[kind.code for _, kind in KINDS])


def codes(text: str) -> set[str]:
    return {finding.code for result in run_checks(parse(text)) for finding in result.findings}


def test_codes_are_unique() -> None:
    assert len({kind.code for _, kind in KINDS}) == len(KINDS)


def test_checks_of_the_design_are_there() -> None:
    assert set(CHECKS) >= {
        "conflict",
        "vacuous-conflict",
        "dead-rule",
        "dead-hedge",
        "redundant-rule",
        "redundant-hedge",
        "reading",
        "unused-name",
        "empty-hedge",
    }


@EACH_KIND
def test_code_is_documented(check: Check, kind: FindingKind) -> None:
    assert re.fullmatch(r"SLEEC[1-9]\d\d", kind.code)
    assert check.question.endswith("?")
    assert kind.title == kind.title.strip(". ")
    assert len(kind.explanation) > 80
    assert kind.explanation.endswith(".")


@EACH_KIND
def test_bad_example_has_it_and_good_example_has_not(check: Check, kind: FindingKind) -> None:
    assert kind.code in codes(kind.bad)
    assert kind.code not in codes(kind.good)


@EACH_KIND
def test_good_example_has_nothing_graver(check: Check, kind: FindingKind) -> None:
    graver = {other.code for _, other in KINDS if other.severity == "error"}
    assert not codes(kind.good) & graver
