"""Definitions and rules in the DSL: what is wrong with one keeps nobody from reading the others."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse

RULES = """
rule_start
  R1 when A and m then B within K minutes
rule_end
"""


def problems_of(definitions: str) -> list[tuple[int, str]]:
    """The line and the message of each problem."""
    with pytest.raises(LanguageError) as caught:
        parse(f"def_start\n{definitions}\ndef_end{RULES}")
    return [(caught.value.source.place(p.span).line, p.message) for p in caught.value.problems]


def misspellings(word: str) -> list[str]:
    """`word` with a letter left out, doubled, in capitals, or changed places with the next."""
    cut = [word[:i] + word[i + 1 :] for i in range(len(word))]
    doubled = [word[:i] + word[i] + word[i:] for i in range(len(word))]
    swapped = [word[:i] + word[i + 1] + word[i] + word[i + 2 :] for i in range(len(word) - 1) if word[i] != word[i + 1]]
    return [*cut, *doubled, *swapped, word.upper(), word.capitalize()]


@pytest.mark.parametrize("separator", ["\n", " "])
@pytest.mark.parametrize("word", ["event", "measure", "constant"])
def test_each_misspelt_keyword_is_told_and_its_definition_read(word: str, separator: str) -> None:
    for misspelling in misspellings(word):
        right = ["event A", "event B", "measure m: boolean", "constant K = 5"]
        written = [line.replace(word, misspelling) for line in right]
        wrong = sum(line != other for line, other in zip(right, written))
        problems = problems_of(separator.join(written))
        message = f"`{misspelling}` is not a keyword; did you mean `{word}`?"
        assert [found for _, found in problems] == [message] * wrong


def test_a_definition_without_a_keyword_is_one_problem() -> None:
    definitions = "event A\nevent B\nm: boolean\nK = 5"
    assert problems_of(definitions) == [(4, "expected the next definition, but found `m`")]


def test_a_definition_of_several_lines_is_no_misspelt_one() -> None:
    parse(
        "def_start event\nA as\nsystem\nevent\nB as environment measure m\n: boolean measure s: scale(\nlow,\nhigh) "
        f"constant K =\nL constant L = 5 def_end{RULES}"
    )


@pytest.mark.parametrize(
    ("definitions", "message"),
    [
        ("constant L = L", "the constant `L` is defined by itself, so it has no value"),
        ("constant L = -> L", "the constant `L` is defined by itself, so it has no value"),
        (
            "constant L = M constant M = L",
            "these constants are defined by each other, so they have no value: `L` = `M` = `L`",
        ),
        (
            "constant L = M constant M = N constant N = O constant O = N",
            "these constants are defined by each other, so they have no value: `N` = `O` = `N`",
        ),
        (
            "".join(f"constant L{n} = L{(n + 1) % 9} " for n in range(9)),
            "these constants are defined by each other, so they have no value: `L0` = `L1` = `L2` = `L3` = ... = `L0`",
        ),
    ],
)
def test_a_circle_of_constants_is_named_once(definitions: str, message: str) -> None:
    others = "event A event B measure m: boolean constant K = 5"
    assert problems_of(f"{others} {definitions}") == [(2, message)]


OTHERS = "event A event B measure m: boolean measure n: numeric constant K = 5"


@pytest.mark.parametrize(
    ("name", "what"), [("A", "an event"), ("m", "a boolean measure"), ("n", "a measure"), ("K", "a constant")]
)
def test_a_value_of_a_scale_is_called_like_nothing_else(name: str, what: str) -> None:
    scale = f"measure s: scale(low, {name})"
    of_scale = "a value of the scale of `s`"
    assert problems_of(f"{OTHERS}\n{scale}") == [(3, f"`{name}` is {of_scale} here, and {what} in line 2")]
    assert problems_of(f"{scale}\n{OTHERS}") == [(3, f"`{name}` is {what} here, and {of_scale} in line 2")]


def test_scales_may_share_values() -> None:
    parse(f"def_start {OTHERS} measure s: scale(low, high) measure t: scale(low, middle, high) def_end{RULES}")


@pytest.mark.parametrize("word", [*(word for word in misspellings("when") if word != "hen"), "if", "whenever"])
def test_each_misspelt_when_is_told_and_its_rule_read(word: str) -> None:
    rules = f"R1 {word} A then B\nR2 when B then A\n  unless m\nR3 {word} B and m then C"
    with pytest.raises(LanguageError) as caught:
        parse(f"def_start {OTHERS} def_end\nrule_start\n{rules}\nrule_end")
    said = f"`{word}` is not a keyword; did you mean `when`?"
    assert [p.message for p in caught.value.problems] == [said, said, "no event is called `C`"]
