"""The pages on the two languages show every construct, and what their tables say can be written."""

from __future__ import annotations

import re
from dataclasses import fields, is_dataclass

import pytest

from sleec_runtime import model
from sleec_runtime.language import parse
from sleec_runtime.language.dsl import keywords as dsl
from sleec_runtime.language.english import keywords
from tests.support.paths import ROOT

DOCS = ROOT / "docs"
ENGLISH = (DOCS / "language.md").read_text(encoding="utf-8")
RELATIONS = re.findall(r"^\| `(RELATION .*?)` \| `(.*?)` \|$", ENGLISH, re.M)
TIMES = re.findall(r"^\| `((?:NOT )?A (?:WITHIN|EVENTUALLY).*?)` \|", ENGLISH, re.M)
OPERATORS = list(dict.fromkeys(re.findall(r"`([<>=!≤≥≠]+)`", ENGLISH)))
MEANINGS = [
    relation
    for row in (DOCS / "times.md")
    .read_text(encoding="utf-8")
    .split("| relation |")[1]
    .split("\n\n")[0]
    .splitlines()[2:]
    for relation in re.findall(r"`([^`]+)`", row.split(" | ")[0])
]
DEFINED = (
    "def_start event A event B measure p: boolean measure q: boolean measure r: boolean def_end\n"
    "rule_start R0 when A and (p and (q and r)) then B rule_end\n"
)


def examples(page: str, language: str) -> str:
    text = (DOCS / page).read_text(encoding="utf-8")
    return "".join(re.findall(rf"^```{language}\n(.*?)^```$", text, re.M | re.S))


def constructs(value: object) -> set[str]:
    """The classes of the model in a ruleset."""
    found: set[str] = set()
    if is_dataclass(value):
        found.add(type(value).__name__)
        for field in fields(value):
            found |= constructs(getattr(value, field.name))
    elif isinstance(value, (tuple, frozenset)):
        for item in value:
            found |= constructs(item)
    elif hasattr(value, "values"):
        found |= constructs(tuple(value.values()))
    return found


def test_every_keyword_is_in_an_example():
    words = set(re.findall(r"\w+", examples("language.md", "sleec") + "".join(text for text, _ in RELATIONS)))
    assert keywords.KEYWORDS | keywords.RELATION_WORDS | {"BY", "TO"} <= words


def test_every_keyword_of_the_dsl_is_in_an_example_or_in_the_table_of_responses():
    table = (DOCS / "dsl.md").read_text(encoding="utf-8").split("may say when:")[1].split("An `unless`")[0]
    words = set(re.findall(r"\w+", examples("dsl.md", "dsl") + table))
    assert words >= dsl.KEYWORDS | dsl.EVENT_RELATIONS | dsl.EFFECTS


def test_every_class_of_the_model_comes_from_some_example():
    found: set[str] = set()
    for example in re.findall(r"^```sleec\n(.*?)^```$", ENGLISH, re.M | re.S):
        found |= constructs(parse(example))
    classes = {name for name, value in vars(model).items() if isinstance(value, type) and is_dataclass(value)}
    # A situation is no text, `true` is a formula that simplifies, and only the DSL calculates.
    assert classes - found == {"Context", "Calculation"}


@pytest.mark.parametrize(("english", "in_the_dsl"), RELATIONS)
def test_a_relation_is_the_same_in_both_languages(english, in_the_dsl):
    ours = parse(f"WHEN A AND p AND q AND r THEN B\n{english}\n").statements[-1]
    theirs = parse(f"{DEFINED}relation_start {in_the_dsl} relation_end").statements[-1]
    assert ours == theirs
    assert not isinstance(ours, model.Rule)


def test_the_tables_are_read():
    assert len(RELATIONS) == 14
    assert len(TIMES) == 4
    assert len(OPERATORS) == 11
    assert len(MEANINGS) == 14


@pytest.mark.parametrize("response", TIMES)
def test_times_of_the_table_are_times(response):
    assert parse(f"WHEN T THEN {response}").is_timed


@pytest.mark.parametrize("operator", OPERATORS)
def test_comparisons_are_comparisons(operator):
    assert parse(f"WHEN T AND m {operator} 5 THEN A").measures


@pytest.mark.parametrize("relation", MEANINGS)
def test_relations_of_the_page_on_time_are_relations(relation):
    shown = parse(f"{DEFINED}relation_start {relation} relation_end").statements[-1]
    assert not isinstance(shown, model.Rule)
