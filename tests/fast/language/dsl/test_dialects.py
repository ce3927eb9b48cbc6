"""Keywords that only LEGOS's dialect has are names in SLEEC-TK's."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError, Unsayable
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.language.dsl.keywords import LEGOS_KEYWORDS
from sleec_verify.exchange.conversion import convert

AS_EVENT = """def_start
    event {0}
    event B
    measure m: boolean
def_end

rule_start
    R1 when {0} then B within 2 minutes otherwise {0}
    R2 when B and m then {0}
        unless not m then not {0} within 2 seconds
    R3 when {0} then {0}
rule_end
"""
AS_MEASURE = """def_start
    event A
    measure {0}: boolean
    constant K = 5
def_end

rule_start
    R1 when A and {0} then A
        unless not {0} or {0} then A
rule_end
"""
AS_CONSTANT = """def_start
    event A
    measure m: numeric
    constant {0} = 5
    constant K = {0}
def_end

rule_start
    R1 when A and {0} < m and m > {0} then A within {0} minutes
rule_end
"""
AS_VALUE = """def_start
    event A
    measure s: scale(low, {0}, high)
def_end

rule_start
    R1 when A and s = {0} then A
rule_end
"""


@pytest.mark.parametrize("text", [AS_EVENT, AS_MEASURE, AS_CONSTANT, AS_VALUE])
@pytest.mark.parametrize("word", sorted(LEGOS_KEYWORDS))
def test_a_keyword_of_claims_and_relations_may_be_a_name(word: str, text: str) -> None:
    written = text.format(word)
    ruleset = parse(written)
    assert ruleset.dialect == "sleec-tk"
    assert print_ruleset(ruleset) == written
    assert convert(convert(ruleset, "english").ruleset, "dsl").ruleset == ruleset
    for other in (ruleset, convert(ruleset, "english").ruleset):
        with pytest.raises(Unsayable, match=f"`{word}` is a keyword of LEGOS"):
            convert(other, "legos")


@pytest.mark.parametrize(
    "beside",
    ["purpose_start p1 exists A purpose_end", "relation_start when A then m until A relation_end"],
)
def test_in_a_text_of_legos_it_stays_a_keyword(beside: str) -> None:
    text = f"def_start event A event for measure m: boolean def_end rule_start R1 when A then for rule_end {beside}"
    with pytest.raises(LanguageError, match="found the keyword `for`"):
        parse(text)


@pytest.mark.parametrize("rest", ["until A", "for 5 minutes", "while m", "meanwhile (exists A)"])
def test_one_without_a_definition_is_no_name(rest: str) -> None:
    text = f"def_start event A measure m: boolean def_end rule_start R1 when A and m then A {rest} rule_end"
    with pytest.raises(LanguageError, match="expected `within`, `otherwise`, `unless` or the next rule"):
        parse(text)
