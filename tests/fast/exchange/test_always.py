"""ALWAYS in other languages, readings and domains: the result obliges the same in every situation."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import Unsayable
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Ruleset
from sleec_verify.exchange.conversion import convert, of_domain
from tests.support.brute_force import contexts, due

TEXT = "ALWAYS p UNLESS q IN WHICH CASE s UNLESS r\nWHEN a THEN b UNLESS q\nWHEN c THEN d\n"
DOMAINS = "WHEN a THEN b\nDOMAIN x\nWHEN c THEN d\nALWAYS u\nDOMAIN y\nALWAYS p UNLESS q\nWHEN e THEN f\n"


def oblige_the_same(one: Ruleset, other: Ruleset) -> None:
    for context in contexts(one):
        assert due(one, context) == due(other, context), context


def test_the_dsl_has_a_rule_for_each_trigger() -> None:
    ruleset = parse(TEXT)
    converted = convert(ruleset, "legos")
    assert [rule.label for rule in parse(converted.text).rules] == ["always_1_a", "always_1_c", "rule_1", "rule_2"]
    oblige_the_same(ruleset, parse(converted.text))


def test_the_other_reading_keeps_the_statement() -> None:
    ruleset = parse(TEXT)
    converted = convert(ruleset, "english", "priority")
    assert converted.text.count("ALWAYS") == 1
    oblige_the_same(ruleset, parse(converted.text))


def test_one_domain_keeps_the_triggers_of_the_others() -> None:
    ruleset = parse(DOMAINS)
    text = print_ruleset(of_domain(ruleset, "y"))
    assert "ALWAYS p" in text
    assert "ALWAYS u" not in text
    oblige_the_same(ruleset.in_domain("y"), parse(text))


def test_the_dsl_cannot_express_never() -> None:
    with pytest.raises(Unsayable, match="no equivalent of NEVER"):
        convert(parse(f"NEVER b UNLESS q\n{TEXT}"), "legos")
