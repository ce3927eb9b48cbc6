"""The pages that are made for the site. `make site` builds it, and so checks every link."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest
from pygments.lexers import get_lexer_by_name
from pygments.token import Error, Generic, Keyword, Name

from tests.support.paths import ROOT
from tests.support.sessions import blocks
from website import commands, copied, findings, lexers, links

ENTRIES = findings.entries()
DOCS = ROOT / "docs"


@cache
def pages() -> dict[str, str]:
    return findings.pages()


def test_every_code_has_a_page() -> None:
    assert set(pages()) == {f"findings/{entry['code']}.md" for entry in ENTRIES} | {"findings/index.md"}
    for entry in ENTRIES:
        assert f"[{entry['code']}]({entry['code']}.md)" in pages()["findings/index.md"]


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry["code"])
def test_a_page_shows_the_finding_in_the_bad_example_and_not_in_the_good_one(entry: findings.Entry) -> None:
    page = pages()[f"findings/{entry['code']}.md"]
    assert re.findall("^## (.*)$", page, re.M) == [
        "What it means",
        "How to fix it",
        "With the problem",
        "Fixed",
    ]
    bad, good = (block.body for block in blocks(page) if block.language == "console")
    assert f"{entry['severity']}[{entry['code']}]" in bad
    assert f"[{entry['code']}]" not in good
    assert good.endswith("$ echo $?\n0\n")


def test_every_command_has_a_page_with_its_options_and_an_example() -> None:
    made = commands.pages()
    for name, command in commands.commands().items():
        page = made[f"commands/{name}.md"]
        assert f"[`{name}`]({name}.md)" in made["commands/index.md"]
        assert f"```console\n$ sleec-verify {name} " in page
        options = [option for parameter in command.params for option in parameter.opts if option.startswith("--")]
        assert all(f"{option}" in page.partition("## Options")[2] for option in options)


def test_every_shipped_ruleset_is_shown() -> None:
    for folder, page in copied.WITH_RULESETS.items():
        for path in (ROOT / folder).glob("*.sleec"):
            assert path.read_text(encoding="utf-8").strip() in copied.pages()[page]


def test_rules_have_colours() -> None:
    lexers.register()
    for path in (ROOT / "rulesets").glob("*.sleec"):
        tokens = list(get_lexer_by_name("sleec").get_tokens(path.read_text(encoding="utf-8")))
        assert (Keyword, "WHEN") in tokens
        assert Error not in {kind for kind, _ in tokens}


def test_what_a_command_prints_is_no_command() -> None:
    lexers.register()
    tokens = list(get_lexer_by_name("console").get_tokens("$ sleec-verify compile\n# dress_assist, default\n"))
    assert [kind for kind, _ in tokens] == [Generic.Prompt, Name, Generic.Output]


@pytest.mark.parametrize("page", sorted(DOCS.rglob("*.md")), ids=lambda path: path.stem)
def test_what_a_page_links_to_is_there(page: Path) -> None:
    """mkdocs looks closer; this needs no mkdocs."""
    made = {*pages(), *commands.pages(), *copied.pages()}
    for link in re.findall(r"\]\(([^)#:]+)(?:#[\w-]+)?\)", page.read_text(encoding="utf-8")):
        target = (page.parent / link).resolve()
        assert target.exists() or (target.is_relative_to(DOCS) and str(target.relative_to(DOCS)) in made), link


def test_links_out_of_the_docs_lead_to_the_same_in_the_site() -> None:
    text = (
        "See [the\nrules](../../rulesets/README.md), "
        "[the paper](../../README.md#the-paper), [it](robot.md#a), [x](../../LICENSE)."
    )
    assert links.within_the_site(text, "tutorials/ci.md") == (
        "See [the\nrules](../rulesets.md), [the paper](../index.md#the-paper), [it](robot.md#a), x."
    )
    assert links.within_the_site("[a](../CHANGELOG.md)", "times.md") == "[a](changelog.md)"
    # A page that is copied from elsewhere has its links from there.
    assert (
        links.within_the_site("[a](docs/ci.md#x) [b](SECURITY.md)", "contributing.md")
        == "[a](ci.md#x) [b](security.md)"
    )


def test_links_by_the_name_of_a_file_say_the_title() -> None:
    assert links.within_the_site("([gate.md](gate.md#in-ci))", "times.md") == (
        "([The gate: may this change be merged?](gate.md#in-ci))"
    )


def test_every_page_is_in_the_navigation() -> None:
    navigation = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:")[2]
    for path in [*DOCS.rglob("*.md"), *(DOCS / name for name in copied.pages())]:
        assert re.search(rf"[ :]{re.escape(str(path.relative_to(DOCS)))}$", navigation, re.M), path


def test_a_decision_has_one_title() -> None:
    """In the navigation and in the list of decisions as on its page."""
    navigation = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    index = (DOCS / "decisions" / "index.md").read_text(encoding="utf-8")
    for path in sorted((DOCS / "decisions").glob("0*.md")):
        title = path.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")
        number, _, decision = title.partition(". ")
        assert f'- "{title}": decisions/{path.name}\n' in navigation
        assert f"| [{number}]({path.name}) | {decision} | " in index
