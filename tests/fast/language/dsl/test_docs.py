"""Every example in the DSL is what its page says it is; so are the tables of docs/dsl.md."""

from __future__ import annotations

import re

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from tests.support.paths import ROOT

DOCS = ROOT / "docs"
PAGE = (DOCS / "dsl.md").read_text(encoding="utf-8")
BLOCKS = [
    block
    for page in sorted(DOCS.rglob("*.md"))
    for block in re.findall(
        r'^```(dsl(?:-bad)?)(?: title="[^"]+")?\n(.*?)^```$', page.read_text(encoding="utf-8"), flags=re.M | re.S
    )
]
RESPONSES = re.findall(r"^\| `(.*?)`(?:, `(.*?)`)? \|", PAGE.split("may say when:")[1].split("An `unless`")[0], re.M)
NAMES = "def_start event A event E event F measure c: boolean measure m: numeric constant K = 5 def_end\n"


@pytest.mark.parametrize("text", [text for kind, text in BLOCKS if kind == "dsl"])
def test_good_examples_parse(text: str) -> None:
    ruleset = parse(text)
    assert parse(print_ruleset(ruleset)) == ruleset


@pytest.mark.parametrize("text", [text for kind, text in BLOCKS if kind == "dsl-bad"])
def test_bad_examples_are_refused(text: str) -> None:
    with pytest.raises(LanguageError):
        parse(text)


def test_there_are_examples_of_both() -> None:
    assert {kind for kind, _ in BLOCKS} == {"dsl", "dsl-bad"}


@pytest.mark.parametrize("response", [response for row in RESPONSES for response in row if response])
def test_responses_of_the_table_are_responses(response: str) -> None:
    ruleset = parse(f"{NAMES}rule_start R1 when A then {response} rule_end")
    assert parse(print_ruleset(ruleset)).rules == ruleset.rules
