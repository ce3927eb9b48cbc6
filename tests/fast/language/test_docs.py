"""Every ruleset in the docs is what its page says it is."""

from __future__ import annotations

import re

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from tests.support.paths import ROOT

PAGES = sorted((ROOT / "docs").rglob("*.md"))
BLOCKS = [
    block
    for page in PAGES
    for block in re.findall(
        r'^```(sleec(?:-bad)?)(?: title="[^"]+")?\n(.*?)^```$',
        page.read_text(encoding="utf-8"),
        flags=re.MULTILINE | re.DOTALL,
    )
]


@pytest.mark.parametrize("text", [text for kind, text in BLOCKS if kind == "sleec"])
def test_good_examples_parse(text: str) -> None:
    ruleset = parse(text)
    assert parse(print_ruleset(ruleset)) == ruleset


@pytest.mark.parametrize("text", [text for kind, text in BLOCKS if kind == "sleec-bad"])
def test_bad_examples_are_refused(text: str) -> None:
    with pytest.raises(LanguageError):
        parse(text)


def test_the_docs_have_examples_of_both() -> None:
    assert {kind for kind, _ in BLOCKS} == {"sleec", "sleec-bad"}
