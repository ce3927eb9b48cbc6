"""Equation 1 of rules with windows: a response with a window is one atom, and nothing is left out silently."""

from __future__ import annotations

import json
import re

import pytest

from sleec_runtime.language import parse
from sleec_verify.exchange.compilation import FORMS, compile_to
from tests.support.cli import Cli

RULES = """def_start
  event A  event B  event C  event D
  measure busy: boolean  measure patience: numeric
def_end
rule_start
  R1 when A and {busy} then B within 2 minutes otherwise { C within [1, 2] hours unless {busy} then D }
  R2 when A then not B within {patience} minutes unless {busy} then D eventually else C
rule_end
relation_start
  mutualExclusive A C
  happenBefore A C
  when B then {busy} for 10 seconds
relation_end
concern_start
  c1 exists A
concern_end
"""

SYMPY = """# R1, default
Implies(A & busy, B[0,120] | ((C[3720,7320] | busy) & (D[120,120] | ~busy)))
# R2, default
Implies(A & ~busy, ~B[0,60*patience])
# R2, hedge 1
Implies(A & busy, D[0,inf) | due(C))
# mutualExclusive
~A | ~(C | due(C))
# not in Equation 1: happenBefore in line 11, which relates several instants
# not in Equation 1: when ... for in line 12, which relates several instants
# not in Equation 1: concern c1 in line 15, which is a question about traces
"""


def test_windows_are_part_of_the_names() -> None:
    assert compile_to(parse(RULES), "sympy") == SYMPY


def test_latex_shows_windows_as_indices() -> None:
    text = compile_to(parse(RULES), "latex")
    assert r"\mathit{B}_{[0,120]}" in text
    assert r"\mathit{D}_{[0,\infty)}" in text
    assert r"\neg \mathit{B}_{[0,60*patience]}" in text


def test_json_gives_the_event_and_its_window() -> None:
    document = json.loads(compile_to(parse(RULES), "json"))
    windows = {v["name"]: (v["event"], *v["window"]) for v in document["variables"] if "window" in v}
    assert windows == {
        "B[0,120]": ("B", "0", "120"),
        "C[3720,7320]": ("C", "3720", "7320"),
        "D[120,120]": ("D", "120", "120"),
        "B[0,60*patience]": ("B", "0", "60*patience"),
        "D[0,inf)": ("D", "0", None),
    }
    assert [(s["statement"], s["line"]) for s in document["excluded"]] == [
        ("happenBefore", 11),
        ("when ... for", 12),
        ("concern c1", 15),
    ]


@pytest.mark.parametrize("form", FORMS)
def test_no_form_refuses_time(cli: Cli, form: str) -> None:
    ran = cli("compile", "rules.sleec", "--to", form, files={"rules.sleec": RULES})
    assert (ran.code, ran.err) == (0, "")
    statements = ("happenBefore", "when", "c1")
    assert form in ("mtl", "mtl-latex") or all(name in ran.out for name in statements)


def test_the_meaning_of_a_response_without_a_window_is_part_of_its_name() -> None:
    ruleset = parse("RULE a WHEN A THEN B AND NOT C")
    assert "B & ~C" in compile_to(ruleset, "sympy")
    assert "B[0,inf) & ~C[0,inf)" in compile_to(ruleset, "sympy", untimed="eventually")


def test_equal_windows_are_one_atom() -> None:
    text = "RULE a WHEN A THEN B WITHIN 1 minutes\nRULE b WHEN A THEN B WITHIN 60 seconds AND B WITHIN 0 seconds"
    names = [v["name"] for v in json.loads(compile_to(parse(text), "json"))["variables"]]
    assert names == ["A", "B[0,60]", "B"]


def test_dimacs_names_the_windows_and_has_the_clauses_of_json() -> None:
    ruleset = parse(RULES)
    document = json.loads(compile_to(ruleset, "json"))
    rows = compile_to(ruleset, "dimacs").splitlines()
    for variable in document["variables"]:
        assert f"c {variable['variable']} {variable['kind']} {variable['name']}" in rows
    clauses = [list(map(int, row.split()))[:-1] for row in rows if row[0] not in "cp"]
    assert clauses == document["clauses"]
    assert "c not in Equation 1: happenBefore in line 11, which relates several instants" in rows


def test_assertions_of_smtlib_have_different_names() -> None:
    text = RULES.replace("R1 when", "mutualExclusive when")
    names = re.findall(r":named \|(.*?)\|", compile_to(parse(text), "smtlib"))
    assert names == ["mutualExclusive 0", "R2 0", "R2 1", "relation 0: mutualExclusive"]
