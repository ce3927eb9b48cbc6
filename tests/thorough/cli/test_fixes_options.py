"""`check --fixes` verifies repairs with the options of the command."""

from __future__ import annotations

import pytest

from tests.support.cli import Cli
from tests.support.fixes import changed, findings

HOME = "DOMAIN home\nRULE a\nWHEN Bell THEN Speak\nRULE b\nWHEN Bell AND Late THEN NOT Speak\n"
DOMAINS = f"{HOME}{HOME.replace('home', 'ward').replace('RULE a', 'RULE c').replace('RULE b', 'RULE d')}"
CHAIN = "WHEN Bell THEN Rise\nRULE up\nWHEN Rise THEN Speak\nRULE still\nWHEN Bell AND Late THEN NOT Speak\n"
NESTED = "WHEN Bell THEN Speak UNLESS Late IN WHICH CASE Sing UNLESS Storm IN WHICH CASE Wave\n"
OVERLAPPING = f"{NESTED}RULE still\nWHEN Bell AND Storm THEN NOT Wave\n"
OVERRIDDEN = f"READING cascade\n{NESTED}RULE still\nWHEN Bell AND Storm AND NOT Late THEN NOT Wave\n"
TIMED = "WHEN Bell THEN Speak WITHIN 5 minutes\nRULE b\nWHEN Bell THEN Wave\nRULE c\nWHEN Bell THEN NOT Wave\n"


@pytest.mark.parametrize(
    ("text", "options", "expected"),
    [
        (DOMAINS, ("--domain", "ward"), {("c", "d")}),
        (DOMAINS, (), {("a", "b"), ("c", "d")}),
        (CHAIN, (), {("up", "still")}),
        (CHAIN, ("--no-chains",), {("up", "still")}),
        (OVERLAPPING, ("--reading", "priority"), {("rule_1", "still")}),
        (OVERRIDDEN, ("--reading", "priority"), {("rule_1", "still")}),
        (TIMED, ("--untimed", "eventually"), {("b", "c")}),
    ],
)
def test_repairs_under_each_option(
    text: str, options: tuple[str, ...], expected: set[tuple[str, ...]], cli: Cli
) -> None:
    conflicts = [finding for finding in findings(cli, text, *options) if finding["code"] == "SLEEC101"]
    assert {frozenset(finding["rules"]) for finding in conflicts} == set(map(frozenset, expected))
    for finding in conflicts:
        assert finding["repairs"]
        for repair in finding["repairs"]:
            after = findings(cli, changed(text, repair), *options)
            assert finding["rules"] not in [one["rules"] for one in after if one["code"] == "SLEEC101"]
