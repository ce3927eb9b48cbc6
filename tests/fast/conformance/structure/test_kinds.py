"""Every code of the check has its documentation, rules and code that have it, and some that have nothing."""

from __future__ import annotations

import pytest

from sleec_verify.checks import CHECKS
from sleec_verify.conformance.structure.examples import files_of
from sleec_verify.conformance.structure.kinds import KINDS
from sleec_verify.results.finding import SEVERITIES
from tests.support.structure import kinds


def test_codes_are_unique() -> None:
    codes = [kind.code for kind in KINDS.values()]
    others = {kind.code for check in CHECKS.values() for kind in check.kinds}
    assert len(codes) == len(set(codes))
    assert not others & set(codes)


@pytest.mark.parametrize("name", KINDS)
def test_a_code_is_documented(name: str) -> None:
    kind = KINDS[name]
    assert kind.code.startswith("SLEEC6")
    assert kind.severity in SEVERITIES
    assert kind.title
    assert kind.explanation.endswith(".")
    assert kind.mend.endswith(".")


@pytest.mark.parametrize("name", KINDS)
def test_the_bad_example_has_the_finding_and_no_other(name: str) -> None:
    found = files_of(KINDS[name].bad)
    assert set(kinds(found["rules.sleec"], robot=found["robot.py"])) == {name}


@pytest.mark.parametrize("name", KINDS)
def test_the_good_example_has_none(name: str) -> None:
    found = files_of(KINDS[name].good)
    assert kinds(found["rules.sleec"], robot=found["robot.py"]) == []
