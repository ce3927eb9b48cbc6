"""Each kind of finding of an audit has examples that show it."""

from __future__ import annotations

import json
import re

import pytest

from sleec_verify.audit.findings import INCONCLUSIVE
from sleec_verify.audit.kinds import KINDS, arguments_of, files_of
from tests.support.cli import Cli


def test_codes_are_in_order() -> None:
    codes = [kind.code for kind in KINDS.values()]
    assert codes == [f"SLEEC{number}" for number in range(701, 701 + len(codes))]


@pytest.mark.parametrize("name", KINDS)
def test_the_example_shows_the_finding_and_no_other(name: str, cli: Cli) -> None:
    kind = KINDS[name]
    ran = cli(*arguments_of(kind.bad), "--format", "json", files=files_of(kind.bad))
    report = json.loads(ran.out)
    (ruleset,) = report["rulesets"]
    assert {finding["code"] for finding in ruleset["findings"]} == {kind.code}
    assert ran.code == (1 if kind.severity == "error" else 3 if name in INCONCLUSIVE else 0)


@pytest.mark.parametrize("name", KINDS)
def test_the_fixed_example_has_no_finding(name: str, cli: Cli) -> None:
    good = KINDS[name].good
    ran = cli(*arguments_of(good), files=files_of(good))
    assert ran.code == 0
    assert not re.search("SLEEC7", ran.out)
