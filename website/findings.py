"""A page for each finding code, from what `sleec-verify rules` knows of it, and one that lists them all."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import TypedDict

from sleec_runtime.language import parse
from sleec_verify.checks import CHECKS
from sleec_verify.conformance import structure
from sleec_verify.conformance.structure.examples import files_of
from website.running import folder_with, printed

FOLDER = "findings"

_ASKED_FOR = {"realizability": ("--realizable", "2")}
"""The options that have checks made which are made only if asked for."""

_INTRODUCTION = """\
# Findings

Every finding has a code. Its page says what is wrong, why it matters and how to mend it, with an example that has it
and one that has not. `sleec-verify rules CODE` says the same offline.

Errors make `check` and `conform` fail; warnings and notes do so if `--fail-level` asks for it.
"""


class Entry(TypedDict):
    """One object of `sleec-verify rules --format json`."""

    code: str
    check: str
    severity: str
    title: str
    question: str
    explanation: str
    mend: str
    bad: str
    good: str


def entries() -> list[Entry]:
    """Every finding code, in order."""
    found: list[Entry] = json.loads(printed("rules", "--format", "json").out)
    return found


def pages() -> dict[str, str]:
    """The pages by their paths in the site."""
    known = entries()
    return {f"{FOLDER}/index.md": _index(known), **{f"{FOLDER}/{entry['code']}.md": _page(entry) for entry in known}}


def _index(known: list[Entry]) -> str:
    by_command: dict[str, list[Entry]] = {}
    for entry in known:
        by_command.setdefault(command_for(entry)[0], []).append(entry)
    parts = [_INTRODUCTION]
    for command, kinds in by_command.items():
        parts.append(f"\n## What `{command}` finds\n\n| code | | | check |\n| --- | --- | --- | --- |\n")
        parts += (
            f"| [{k['code']}]({k['code']}.md) | {k['severity']} | {_words(k['title'])} | `{k['check']}` |\n"
            for k in kinds
        )
    return "".join(parts)


def _page(entry: Entry) -> str:
    return "".join(
        (
            # Titles begin with the code, which is what people search for.
            f"---\ntitle: {entry['code']}\n---\n\n# {entry['code']}: {entry['title']}\n\n",
            f"**{entry['severity'].capitalize()}** of the check `{entry['check']}`: {entry['question']}\n\n",
            f"## What it says\n\n{_words(entry['explanation'])}\n\n",
            f"## How to mend it\n\n{_words(entry['mend'])}\n\n",
            f"## An example that has it\n\n{''.join(_example(entry, entry['bad']))}",
            f"## Without it\n\n{''.join(_example(entry, entry['good']))}",
        )
    )


def _example(entry: Entry, text: str) -> Iterator[str]:
    """The files of an example, and what the command says of them."""
    files = example_files(entry, text)
    for name, content in files.items():
        yield f'```{_language(name, content)} title="{name}"\n{content.strip()}\n```\n\n'
    arguments = command_for(entry)
    with folder_with(files):
        said, code = printed(*arguments)
    yield f"```console\n$ sleec-verify {' '.join(arguments)}\n{said.rstrip()}\n$ echo $?\n{code}\n```\n\n"


def example_files(entry: Entry, text: str) -> Mapping[str, str]:
    """The files of one of an entry's examples, by their names."""
    return files_of(text) if entry["check"] == structure.NAME else {"rules.sleec": text}


def command_for(entry: Entry) -> tuple[str, ...]:
    """The arguments of the command that makes the finding, in a folder with the files of an example."""
    if entry["check"] in CHECKS:
        return ("check", "rules.sleec", *_ASKED_FOR.get(entry["check"], ()))
    return ("conform", "robot.py", "--ruleset", "rules.sleec")


def _language(name: str, text: str) -> str:
    if name.endswith(".py"):
        return "python"
    return "dsl" if parse(text).syntax == "dsl" else "sleec"


def _words(text: str) -> str:
    """A text of the terminal as Markdown: `<` and `*` mean themselves."""
    return text.replace("*", r"\*").replace("<", "&lt;")
