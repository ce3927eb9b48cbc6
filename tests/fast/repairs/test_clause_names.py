"""Titles and decisions name an ALWAYS statement, which stands for several rules, by its text."""

from __future__ import annotations

from datetime import date

from sleec_runtime.language import parse
from sleec_verify.repairs.decision import comment_edit, decision
from sleec_verify.repairs.edit import edited
from tests.support.repairs import repairs_of

POLITE = "ALWAYS be polite\n UNLESS x IN WHICH CASE be rude\nRULE r\nWHEN a AND y THEN NOT be polite\nWHEN b THEN c\n"
DSL = """\
def_start
event A
event B
measure x: boolean
def_end
rule_start
R1 when A then B
/* one
two */ R2 when A and {x} then not B
rule_end
"""


def test_no_repair_names_one_rule_of_an_always() -> None:
    repairs = repairs_of(POLITE, "SLEEC101")
    titles = [repair.candidate.title for repair in repairs]
    assert "add to `ALWAYS be polite`: `UNLESS y IN WHICH CASE NOT be polite`" in titles
    ruleset = parse(POLITE)
    said = [decision(ruleset, repair, date(2026, 11, 23), "") for repair in repairs]
    assert "decision 2026-11-23: `ALWAYS be polite` gives way to `r`" in said
    assert "decision 2026-11-23: `r` gives way to `ALWAYS be polite` and is removed" in said
    assert "always_1" not in " ".join((*titles, *said))


def test_a_decision_is_no_part_of_another_comment() -> None:
    ruleset = parse(DSL)
    repairs = [one for one in repairs_of(DSL, "SLEEC101") if one.candidate.gives_way == "R2"]
    assert repairs
    for repair in repairs:
        changed = repair.repaired.source.text
        written = edited(changed, [comment_edit(ruleset, repair, "decision")])
        assert parse(written).statements == repair.repaired.statements
        place = (
            "/* one\ntwo */\n// decision\n" if repair.candidate.operator == "rule-removal" else "// decision\n/* one"
        )
        assert place in written, repair.candidate.title
