"""The documentation follows tools/prose.toml, and the linter finds what it should."""

from __future__ import annotations

import re

import pytest

from tests.support.paths import ROOT
from tools import prose

PATHS = [str(path.relative_to(ROOT)) for path in prose.files()]


@pytest.mark.parametrize("path", PATHS)
def test_the_wording_is_plain(path: str) -> None:
    found = list(prose.problems(path, (ROOT / path).read_text(encoding="utf-8")))
    assert not found, "\n".join(map(str, found))


def test_the_documentation_is_checked() -> None:
    assert {"README.md", "CHANGELOG.md", "docs/index.md", "docs/tutorials/robot.md", "docs/decisions/index.md"} <= set(
        PATHS
    )


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("It will be\nmended.", ['avoid "will be": present tense', 'avoid "mended": fix']),
        ("A row | of a table, i.e. this | one", ['avoid "i.e.": that is']),
        ("`i.e.` is code, and [utilize](utilize.md) is not.", ['avoid "utilize": use']),
        ("```text\nThis will be shown.\n```", []),
        ("There is no file, and no longer a problem.", []),
        ("This is no file.", ['avoid "is no": is not a']),
        ("A sentence. " + "Word " * 40, ["sentence of 40 words"]),
        ("- An item " + "word " * 20 + "\n- An item " + "word " * 20, []),
        ("<!-- prose: allow mended, because the paper says so -->\nIt is mended.", []),
        ("<!-- prose: allow mended, because -->\nIt is mended.", ['avoid "mended": fix']),
        ("<!-- prose: allow anew, because the paper says so -->\nIt is mended.", ['avoid "mended": fix']),
    ],
)
def test_pages_are_read_as_prose(text: str, found: list[str]) -> None:
    messages = [problem.message for problem in prose.problems("docs/page.md", text)]
    assert len(messages) == len(found)
    assert all(message.startswith(start) for message, start in zip(messages, found)), messages


def test_a_problem_has_its_line() -> None:
    (problem,) = prose.problems("docs/page.md", "# Title\n\nOne line,\nand it is mended here.\n")
    assert str(problem) == 'docs/page.md:4: avoid "mended": fix'


def test_docstrings_and_messages_are_read_as_prose() -> None:
    code = '"""It is told of here."""\nraise Error(f"{name} is not known and {other} is no file")\nname = "is no"\n'
    assert [problem.line for problem in prose.problems("module.py", code)] == [1, 2]


def test_some_words_are_for_some_pages_only() -> None:
    (page, *_) = next(rule.pages for rule in prose.substitutions() if rule.pages)
    assert list(prose.problems(page, "This hedge applies."))
    assert not list(prose.problems("docs/semantics.md", "This hedge applies."))


def test_pages_with_words_of_their_own_exist() -> None:
    assert all((ROOT / page).is_file() for rule in prose.substitutions() for page in rule.pages or ())


def test_no_substitution_suggests_what_another_one_avoids() -> None:
    rules = [rule for rule in prose.substitutions() if rule.pages is None]
    assert not [(rule.use, other.avoid.pattern) for rule in rules for other in rules if other.avoid.search(rule.use)]
    assert all(re.search(r"[a-z]", rule.use) for rule in rules)
