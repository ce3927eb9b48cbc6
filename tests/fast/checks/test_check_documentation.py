"""Every finding code has its documentation, an example that has the finding, and one that has none of the check's."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import CHECKS, checks_for, run_checks
from sleec_verify.results.finding import SEVERITIES, Proved

KINDS = [(check, kind) for check in CHECKS.values() for kind in check.kinds]


def test_codes_are_unique():
    codes = [kind.code for _, kind in KINDS]
    assert len(codes) == len(set(codes))


@pytest.mark.parametrize(("check", "kind"), KINDS, ids=lambda value: getattr(value, "code", None))
def test_a_code_is_documented(check, kind):
    assert check.question.endswith("?")
    assert kind.code.startswith("SLEEC")
    assert kind.severity in SEVERITIES
    assert kind.title
    assert kind.explanation.endswith(".")
    assert kind.mend.endswith(".")


@pytest.mark.parametrize(("check", "kind"), KINDS, ids=lambda value: getattr(value, "code", None))
def test_the_bad_example_has_the_finding(check, kind):
    (result,) = run_checks(parse(kind.bad), [check.name])
    assert kind.code in {finding.code for finding in result.findings}


@pytest.mark.parametrize(("check", "kind"), KINDS, ids=lambda value: getattr(value, "code", None))
def test_the_good_example_has_nothing_of_it_and_nothing_grave(check, kind):
    ruleset = parse(kind.good)
    results = {result.name: result for result in run_checks(ruleset, [*checks_for(ruleset), check.name])}
    assert isinstance(results[check.name].verdict, Proved)
    assert not [f for result in results.values() for f in result.findings if f.severity != "note"]
