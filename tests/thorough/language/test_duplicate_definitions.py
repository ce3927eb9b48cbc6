"""A name that is defined twice, in every way and with every use, is a list of problems and never another error; if both
definitions are the same, it is a defect of rules that are read."""

from __future__ import annotations

from contextlib import suppress
from itertools import product

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_verify.checks import run_checks
from sleec_verify.exchange.conversion import convert

DSL_DEFINITIONS = (
    "event N",
    "event N as system",
    "measure N: boolean",
    "measure N: numeric",
    "measure N: scale(low, high)",
    "measure N: scale(moderate, severe, fatal)",
    "measure N: scale(high, low)",
    "measure N: scale(low, N)",
    "constant N = 5",
    "constant N = K",
    "constant N = N",
)
_OPERATORS = ("<", "=", "<>", ">=")
_OTHERS = ("low", "severe", "fatal", "other", "someValue", "K", "m", "E", "N", "0", "7", "true", "unknown")
_CONDITIONS = (
    "N",
    "{N}",
    "not N",
    *(f"N = {other}" for other in _OTHERS),
    *(f"{other} < N" for other in _OTHERS),
    *(f"other {operator} {value}" for operator in _OPERATORS for value in ("severe", "low", "fatal")),
    *(f"{one} {operator} m" for operator in _OPERATORS for one in ("severe", "N + 1", "N * N", "severe + 1", "{N}")),
    "severe = low",
    "severe",
)
DSL_USES = (
    "",
    *(f"rule_start R when E and ({condition}) then E rule_end" for condition in _CONDITIONS),
    "rule_start R when N then E rule_end",
    "rule_start R when E then N within N seconds otherwise N rule_end",
    "rule_start R when E then E within ({N} + 1) minutes rule_end",
    "rule_start R when E then E within severe minutes rule_end",
    "rule_start R when E then E unless N then not N unless N = severe rule_end",
    "rule_start N when E then E rule_end",
    "relation_start witness N E mutualExclusive E N relation_end",
    "relation_start measure imply {N = severe} {N > low} causation N {N = fatal} relation_end",
    "relation_start when N then {N = severe} until N and N = severe relation_end",
    "concern_start c exists N and {N = severe} while N within N seconds concern_end",
    "purpose_start p when N and {severe = N} then not N within N seconds purpose_end",
)


@pytest.mark.parametrize("definitions", [*product(DSL_DEFINITIONS, repeat=2)], ids=" / ".join)
def test_a_name_that_the_dsl_defines_twice_is_told_whatever_uses_it(definitions: tuple[str, str]) -> None:
    one, two = definitions
    known = f"{one} {two} event E measure m: numeric measure other: scale(low, someValue) constant K = 3"
    for use in DSL_USES:
        text = f"def_start {known} def_end rule_start Last when E then E rule_end {use}"
        if one == two:
            assert problems(text) == problems(text.replace(f"{one} {two}", f"{one} {' ' * len(two)}"))
            continue
        assert any(message.startswith("`N` is ") for message in problems(text)), (use, problems(text))


def problems(text: str) -> list[str]:
    """What is wrong with a text; of rules that are read, what is a defect, but for repeated definitions."""
    try:
        return [defect.message for defect in parse(text).defects if defect.kind != "repeated-definition"]
    except LanguageError as error:
        return [problem.message for problem in error.problems]


REPEATED = """\
def_start
  event A as environment
  event B
  measure hot: boolean
  measure pain: scale(low, high) // how it feels
  measure heat: numeric
  constant SHORT = 5
  constant LONG = MEDIUM
  constant MEDIUM = 10
  {}
def_end
rule_start
  R1 when A and {{hot}} and ({{pain}} > low) then B within SHORT minutes
    unless ({{heat}} > LONG) then not B within LONG minutes
rule_end
"""


@pytest.mark.parametrize(
    "definition",
    [
        "event A as environment",
        "event B",
        "measure hot: boolean",
        "measure pain: scale(low, high)",
        "measure heat: numeric",
        "constant SHORT = 5",
        "constant LONG = MEDIUM",
    ],
)
def test_a_repeated_definition_is_a_defect_and_changes_nothing(definition: str) -> None:
    name = definition.replace(":", "").split()[1]
    once, twice = parse(REPEATED.format("")), parse(REPEATED.format(f"// again\n  {definition}"))
    (defect,) = twice.defects
    line = next(n for n, text in enumerate(twice.source.text.splitlines(), 1) if f" {name}" in text)
    assert defect.message == f"`{name}` is defined again; the first time in line {line}"
    assert twice.source.text[defect.span.start : defect.span.end] == name
    assert once.rules == twice.rules
    assert len(twice.statements) == len(once.statements) + 1
    assert parse(print_ruleset(twice)) == twice
    english = convert(twice, "english")
    assert english.ruleset.rules == convert(once, "english").ruleset.rules
    assert "again" in english.text
    assert "how it feels" in english.text
    found = [[f.message for r in run_checks(one) for f in r.findings if f.check != "defect"] for one in (once, twice)]
    assert found[0] == found[1]


@pytest.mark.parametrize(
    ("one", "two"),
    [
        ("event N", "event N as system"),
        ("measure N: scale(low, high)", "measure N: scale(high, low)"),
        ("constant N = 5", "constant N = 6"),
        ("constant N = 3", "constant N = K"),
    ],
)
def test_definitions_of_one_name_that_differ_are_refused(one: str, two: str) -> None:
    with pytest.raises(LanguageError, match="`N` is defined twice; the first time in line 1"):
        parse(f"def_start {one} {two} event E constant K = 3 def_end rule_start R when E then E rule_end")


ENGLISH_DEFINITIONS = (
    "TRIGGER N",
    "CONDITION N",
    "OBLIGATION N",
    "MEASURE N: number",
    "MEASURE N: low < high",
    "MEASURE N: moderate < severe < fatal",
    "MEASURE N: high < low",
    "MEASURE N: low < N",
    "CONSTANT N = 5",
    "CONSTANT N = K",
    "CONSTANT N = N",
)
ENGLISH_USES = (
    "",
    "WHEN N THEN E",
    "WHEN E THEN N",
    "WHEN E THEN NOT N",
    "WHEN E AND N THEN F",
    *(f"WHEN E AND N {operator} {other} THEN F" for operator in ("<", "=", "!=", ">=") for other in _OTHERS),
    *(f"WHEN E AND {other} < N THEN F" for other in _OTHERS),
    "WHEN E AND other = severe THEN F",
    "WHEN E THEN F UNLESS N IN WHICH CASE N UNLESS N = severe IN WHICH CASE NOT N",
    "WHEN E THEN F WITHIN N seconds OTHERWISE N",
    "RULE N WHEN E THEN F",
    "EXCLUSIVE N, F",
    "NEVER N AND N = severe",
    "ASSUME NOT (N AND N = severe)",
)


@pytest.mark.parametrize("definitions", [*product(ENGLISH_DEFINITIONS, repeat=2)], ids=" / ".join)
def test_a_name_that_structured_english_defines_twice_never_breaks_the_parser(definitions: tuple[str, str]) -> None:
    known = "\n".join((*definitions, "MEASURE m: number", "MEASURE other: low < someValue", "CONSTANT K = 3"))
    for use in ENGLISH_USES:
        with suppress(LanguageError):
            parse(f"{known}\nWHEN Last THEN G\n{use}\n")
