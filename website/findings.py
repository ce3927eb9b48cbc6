"""A page for each finding code, from `sleec-verify rules`, and an index of them."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import TypedDict

from sleec_runtime.language import parse
from sleec_verify.audit import kinds as audit
from sleec_verify.checks import CHECKS
from sleec_verify.conformance import structure
from sleec_verify.conformance.structure.examples import files_of
from website.running import folder_with, printed

FOLDER = "findings"

_ASKED_FOR = {"realizability": ("--realizable", "2")}
"""The options that enable checks which are off by default."""

_INTRODUCTION = """\
# Findings

Every finding has a code. Its page says what is wrong, why it matters and how to fix it. It has an example with the
problem, and one without. `sleec-verify rules CODE` prints the same text offline.

Errors make `check`, `conform` and `audit` fail. Warnings and notes do so with a lower `--fail-level`.
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
        parts.append(
            f"\n## Findings of `{command}`\n\n| code | severity | problem | check |\n| --- | --- | --- | --- |\n"
        )
        parts += (
            f"| [{k['code']}]({k['code']}.md) | {k['severity']} | {_words(k['title'])} | `{k['check']}` |\n"
            for k in kinds
        )
    return "".join(parts)


def _page(entry: Entry) -> str:
    return "".join(
        (
            # Titles start with the code, because people search for it.
            f"---\ntitle: {entry['code']}\n---\n\n# {entry['code']}: {entry['title']}\n\n",
            f"**{entry['severity'].capitalize()}** of the check `{entry['check']}`: {entry['question']}\n\n",
            f"## What it means\n\n{_words(entry['explanation'])}\n\n",
            f"## How to fix it\n\n{_words(entry['mend'])}\n\n",
            f"## With the problem\n\n{''.join(_example(entry, entry['bad']))}",
            f"## Fixed\n\n{''.join(_example(entry, entry['good']))}",
        )
    )


def _example(entry: Entry, text: str) -> Iterator[str]:
    """The files of an example, and the output of the command."""
    files = example_files(entry, text)
    for name, content in files.items():
        yield f'```{_language(name, content)} title="{name}"\n{content.strip()}\n```\n\n'
    arguments = command_for(entry)
    with folder_with(files):
        said, code = printed(*arguments)
    yield f"```console\n$ sleec-verify {' '.join(arguments)}\n{said.rstrip()}\n$ echo $?\n{code}\n```\n\n"


def example_files(entry: Entry, text: str) -> Mapping[str, str]:
    """The files of one of an entry's examples, by their names."""
    if entry["check"] == audit.NAME:
        return audit.files_of(text)
    return files_of(text) if entry["check"] == structure.NAME else {"rules.sleec": text}


def command_for(entry: Entry) -> tuple[str, ...]:
    """The arguments of the command that makes the finding, in a folder with the files of an example."""
    if entry["check"] in CHECKS:
        return ("check", "rules.sleec", *_ASKED_FOR.get(entry["check"], ()))
    if entry["check"] == audit.NAME:
        return audit.arguments_of(entry["bad"])
    return ("conform", "robot.py", "--ruleset", "rules.sleec")


def _language(name: str, text: str) -> str:
    if name.endswith(".py"):
        return "python"
    if not name.endswith(".sleec"):
        return "toml" if name.endswith(".toml") else "text"
    return "dsl" if parse(text).syntax == "dsl" else "sleec"


def _words(text: str) -> str:
    """A terminal text as Markdown, with `<` and `*` escaped."""
    return text.replace("*", r"\*").replace("<", "&lt;")
