"""The fingerprint of a finding is the same as long as the statements that it depends on are."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import NOWHERE
from sleec_verify.checks import run_checks
from sleec_verify.results.fingerprint import canonical, fingerprint
from tests.support.timed_strategies import timed_ruleset

TEXT = """MEASURE age: number
CONSTANT adult = 18
RULE a
WHEN t AND age < adult THEN o
RULE b
WHEN t THEN NOT o
RULE c
WHEN u THEN x
ASSUME NOT (d AND e)
"""


def mark(text: str) -> str:
    ruleset = parse(text)
    (result,) = run_checks(ruleset, ["conflict"])
    return fingerprint(ruleset, next(one for one in result.findings if one.rules == ("a", "b")))


@pytest.mark.parametrize(
    "text",
    [
        "# a comment\n\n" + TEXT.replace("THEN o\n", "THEN\n  o  # another one\n"),
        TEXT.replace("u THEN x", "u THEN y"),
        TEXT + "RULE e\nWHEN t THEN z\n",
        TEXT.replace("ASSUME NOT (d AND e)\n", ""),
        TEXT.replace("d AND e", "d AND f"),
    ],
)
def test_what_does_not_matter(text: str) -> None:
    assert mark(text) == mark(TEXT)


@pytest.mark.parametrize(
    "text",
    [
        TEXT.replace(" AND age < adult", ""),
        TEXT.replace("NOT o", "NOT o AND z"),
        TEXT.replace("= 18", "= 19"),
        TEXT.replace("age: number", "age: integer"),
        TEXT + "ASSUME NOT (age < 3 AND sick)\n",
        TEXT + "ASSUME NOT (age < 3 AND sick)\nASSUME NOT (sick AND d)\n",
        TEXT + "EXCLUSIVE o, z\n",
        "READING priority\n" + TEXT,
    ],
)
def test_what_matters(text: str) -> None:
    assert mark(text) != mark(TEXT)


def test_an_assumption_about_an_assumption_matters() -> None:
    one = TEXT + "ASSUME NOT (age < 3 AND sick)\n"
    assert mark(one) != mark(one.replace("d AND e", "d AND sick"))


@pytest.mark.parametrize("seed", range(40))
def test_equal_rules_have_equal_forms_and_others_have_not(seed: int) -> None:
    rules = timed_ruleset(seed, named=True, lengths=True).rules
    for one in rules:
        for other in (*rules, replace(one, label=""), replace(one, span=NOWHERE), replace(one, hedges=())):
            assert (canonical(one) == canonical(other)) == (one == other)
