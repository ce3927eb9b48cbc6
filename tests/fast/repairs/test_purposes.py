"""Repairs of a purpose that the rules block."""

from __future__ import annotations

from tests.support.repairs import repairs_of, texts_after

REST = """def_start
  event Call
  event Answer
  event Ring
  measure asleep: boolean
  measure urgent: boolean
def_end
rule_start
  R1 when Call then Ring // at once
  R2 when Ring and {asleep} then not Answer // rest
rule_end
purpose_start
  p1 exists Call and ({asleep} and {urgent}) while Answer
purpose_end
"""


def test_a_rule_gives_way_where_the_purpose_applies() -> None:
    changed = texts_after(REST, repairs_of(REST, "SLEEC105"))
    for old, new in (
        (" and {asleep} then", " and ({asleep} and (not (Call and {urgent}))) then"),
        ("// rest", "// rest\n      unless (Call and {urgent}) then Answer"),
        (" then Ring", " and (not ({asleep} and {urgent})) then Ring"),
    ):
        assert REST.replace(old, new) in changed


def test_structured_english() -> None:
    text = "RULE loud\nWHEN Call THEN Ring\n\nRULE soft\nWHEN Knock AND quiet THEN Open\n"
    text += "PURPOSE p EXISTS Call AND quiet WHILE NOT Ring\n"
    found = texts_after(text, repairs_of(text, "SLEEC105"))
    assert text.replace("THEN Ring", "THEN Ring\nUNLESS quiet IN WHICH CASE NOT Ring") in found
    assert text.replace("WHEN Call THEN", "WHEN Call AND NOT quiet THEN") in found


def test_a_rule_that_always_blocks_a_purpose_is_removed() -> None:
    text = "RULE loud\nWHEN Call THEN Ring\n\nRULE night\nWHEN Night THEN Ring\n\n"
    text += "RULE day\nWHEN Call AND quiet THEN Open\n"
    text += "PURPOSE p WHEN Call THEN NOT Ring\n"
    (changed,) = texts_after(text, repairs_of(text, "SLEEC105"))
    assert changed == text.replace("RULE loud\nWHEN Call THEN Ring\n\n", "")
