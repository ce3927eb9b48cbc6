"""Words that look like others, in both languages; what mixes scripts; what is invisible; what turns a line."""

from __future__ import annotations

import sys
from unicodedata import name, normalize

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.language import parse
from sleec_verify.checks import CHECKS, checks_for, run_checks
from sleec_verify.checks.skeleton import skeleton
from sleec_verify.checks.unicode_confusables import LOOKALIKES
from sleec_verify.results.finding import Finding

ALIKE, MIXED, ODD, TURNED = (kind.code for kind in CHECKS["confusable"].kinds)
PAIRS = [(plain, other) for plain, others in LOOKALIKES.items() for other in others]
CYRILLIC = "\u041epen"


def found(text: str) -> list[Finding]:
    ruleset = parse(text)
    if "confusable" not in checks_for(ruleset):
        return []
    (result,) = run_checks(ruleset, ["confusable"])
    return list(result.findings)


def codes(text: str) -> set[str]:
    return {finding.code for finding in found(text)}


def dsl(definitions: str, rules: str) -> str:
    return f"def_start\nevent Bell\nevent Other\n{definitions}\ndef_end\nrule_start\n{rules}\nrule_end\n"


PLACES = {
    "obligation": "WHEN Bell THEN Open\nWHEN Bell THEN NOT {}\n",
    "trigger": "WHEN Open THEN Answer\nWHEN {} THEN NOT Answer\n",
    "condition": "WHEN Bell THEN Answer UNLESS Open IN WHICH CASE Wait\nWHEN Bell AND {} THEN NOT Answer\n",
    "phrase": "WHEN Bell THEN Answer UNLESS the Open door IN WHICH CASE Wait\nWHEN the {} door THEN Run\n",
    "measure": "MEASURE Open: number\nWHEN Bell AND Open > 3 THEN A\nWHEN Bell AND {} THEN NOT A\n",
    "value": "MEASURE m: Open < b\nMEASURE n: {} < c\nWHEN Bell AND m = Open THEN A\nWHEN Bell AND n > {} THEN A\n",
    "constant": "MEASURE m: number\nCONSTANT Open = 5\nCONSTANT {} = 3\nWHEN Bell AND m > Open AND m > {} THEN A\n",
    "label": "RULE Open WHEN Bell THEN A\nRULE {} WHEN Bell THEN B\n",
    "dotted label": "RULE a.Open WHEN Bell THEN A\nRULE a.{} WHEN Bell THEN B\n",
    "domain": "DOMAIN Open\nWHEN Bell THEN A\nDOMAIN {}\nWHEN Bell THEN NOT A\n",
    "constraint": "EXCLUSIVE {}, Wait\nWHEN Bell THEN Open AND Wait\n",
    "declaration": "OBLIGATION Open, {}\nWHEN Bell THEN Open\n",
    "DSL event": dsl("event Open\nevent {}", "R1 when Bell then Open\nR2 when Bell then not {}"),
    "DSL measure": dsl("measure Open: boolean\nmeasure {}: boolean", "R1 when Bell and {{Open}} then Other"),
    "DSL value": dsl(
        "measure m: scale(Open, b)\nmeasure n: scale({}, c)", "R1 when Bell and ({{m}} = Open) then Other"
    ),
    "DSL constant": dsl("constant Open = 4\nconstant {} = 5", "R1 when Bell then Other within Open seconds"),
    "DSL label": dsl("", "Open when Bell then Other\n{} when Bell then Other"),
}


@pytest.mark.parametrize("place", PLACES)
def test_a_lookalike_is_found_in_every_place(place: str) -> None:
    assert ALIKE in codes(PLACES[place].format(*[CYRILLIC] * 2))
    assert not found(PLACES[place].format(*["Close"] * 2))
    assert not found(PLACES[place].format(*["\u00d6ffne"] * 2))


def test_a_conflict_that_a_lookalike_hides_is_reported() -> None:
    (finding,) = found(PLACES["obligation"].format(CYRILLIC))
    assert finding.severity == "warning"
    assert finding.message == (
        "`\u041epen` looks like `Open`, but it is a different word: it contains U+041E CYRILLIC CAPITAL LETTER O"
    )
    assert finding.rules == ("rule_2",)
    assert [word for _, word in finding.related] == ["the similar word"]


@pytest.mark.parametrize(("plain", "other"), PAIRS, ids=lambda c: f"{ord(c):x}")
def test_each_lookalike_of_the_table_is_found(plain: str, other: str) -> None:
    if not name(other, ""):
        pytest.skip("the Unicode of this Python does not have it")
    assert ALIKE in codes(f"WHEN Bell THEN a{plain}x\nWHEN Bell THEN NOT a{other}x\n")


@given(st.text(st.sampled_from("OpenDrCl1Iab"), min_size=1, max_size=8).map("x{}".format), st.data())
def test_any_letters_of_a_name_may_be_replaced(word: str, data: st.DataObject) -> None:
    replaced = "".join(data.draw(st.sampled_from([c, *LOOKALIKES.get(c, "")])) for c in word)
    if replaced != word:
        assert skeleton(replaced) == skeleton(word)
        assert found(f"WHEN Bell THEN {word}\nWHEN Bell THEN NOT {replaced}\n")


@pytest.mark.parametrize(
    ("one", "two"),
    [
        ("Caf\u00e9", "Cafe\u0301"),
        ("the user's", "the user\u2019s"),
        ("Op\u034fen", "Open"),
        ("Op\u3164en", "Open"),
        ("\uff2fpen", "Open"),
        ("\U0001d40epen", "Open"),
        ("\ufb01ne", "fine"),
        ("\u0421\u0410\u0422", "CAT"),
        ("\u0391B", "\u0410B"),
    ],
)
def test_words_that_differ_otherwise_look_alike(one: str, two: str) -> None:
    assert ALIKE in codes(f"WHEN Bell THEN {one}\nWHEN Bell THEN NOT {two}\n")


@pytest.mark.parametrize("word", ["Turn1", "Turnl", "\u00d6ffnen1", "\u00d6ffnenl", "modern", "modem", "\u043e"])
def test_words_that_are_not_alike(word: str) -> None:
    """What looks alike in ASCII is left to the reader, and one word is like no other."""
    assert not found(f"WHEN Bell THEN Turn1 AND \u00d6ffnen1 AND modem AND {word}\n")


@pytest.mark.parametrize("keyword", ["AND", "THEN", "unless"])
def test_a_word_that_looks_like_a_keyword(keyword: str) -> None:
    wide = "".join(chr(ord(c) + 0xFEE0) for c in keyword)
    if keyword.isupper():
        (finding,) = found(f"WHEN Bell THEN a {wide} b\n")
    else:
        (finding,) = found(dsl(f"event {wide}", f"R1 when Bell then {wide}"))
    assert finding.code == ALIKE
    assert f"looks like the keyword `{keyword}`" in finding.message
    assert finding.help is not None
    assert keyword in finding.help


@pytest.mark.parametrize(
    "word",
    ["D\u043e\u043er", "ris\u043a", "\u0421\u0442\u0430\u0442\u0443\u0441OK", "\u03b1Level", "\u0414\u03b1", "\u05d0b"],
)
def test_a_word_that_mixes_scripts(word: str) -> None:
    (finding,) = found(f"WHEN Bell THEN {word}\n")
    assert finding.code == MIXED
    assert "U+" in finding.message


@pytest.mark.parametrize(
    "word",
    [
        "\u0394T",
        "CO\u2082Level",
        "\u00c4rger",
        "Caf\u00e9",
        "\u7a93\u3092\u958b\u3051\u308b",
        "T\u30b7\u30e3\u30c4",
        "\u0414\u0432\u0435\u0440\u044c_Open",
        "\u0416-Open",
        "\ucc3d\ubb38Open",
        "x\u00b2",
        "\u05d3\u05dc\u05ea",
        "\u0926\u0930\u0935\u093e\u091c\u093c\u093e",
        "\u0e1b\u0e23\u0e30\u0e15\u0e39",
    ],
)
def test_words_of_the_languages_of_the_world_are_fine(word: str) -> None:
    assert not found(f"WHEN Bell THEN {word}\n")
    assert not found(f"WHEN Bell THEN {normalize('NFC', word)}\n")


@pytest.mark.parametrize(
    "word", ["\uff2fpen", "\u212belm", "\U0001d40epen", "O\u034fpen", "O\u3164pen", "\ufb01ne", "\u212a9"]
)
def test_an_odd_form_of_a_letter(word: str) -> None:
    (finding,) = found(f"WHEN Bell THEN {word}\n")
    assert finding.code == ODD
    assert finding.help == f"write `{normalize('NFKC', word).replace(chr(0x34F), '').replace(chr(0x1160), '')}`"


@pytest.mark.parametrize("control", "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
@pytest.mark.parametrize(
    "text",
    [
        "WHEN Bell THEN Answer // {0}x{0}\n",
        "# {0}x{0}\nWHEN Bell THEN Answer\n",
        dsl("// {0}x{0}", "R1 when Bell then Other"),
        dsl("", "R1 when Bell then Other /* a\n {0}x{0}*/"),
    ],
)
def test_a_control_that_turns_a_line(text: str, control: str) -> None:
    (finding,) = found(text.format(control))
    assert finding.code == TURNED
    assert f"U+{ord(control):04X} {name(control)}" in finding.message


def test_of_many_characters_the_first_are_named() -> None:
    (finding,) = found("WHEN Bell THEN a\u0430\u0431\u0432\u0433\u0434\u0435\u0436\n")
    assert finding.message.endswith("U+0434 CYRILLIC SMALL LETTER DE and 2 more")


def test_a_text_in_ascii_is_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sleec_verify.checks.skeleton", None)
    ruleset = parse("WHEN Bell THEN Open\n")
    assert "confusable" not in checks_for(ruleset)
    assert not run_checks(ruleset, ["confusable"])[0].findings


def test_the_table_has_letters_and_digits_that_look_like_one_another() -> None:
    others = [other for _, other in PAIRS]
    assert len(set(others)) == len(others) > 300
    for plain, other in PAIRS:
        assert plain.isascii()
        assert plain.isalnum()
        assert not other.isascii()
        assert normalize("NFKD", other) == other
