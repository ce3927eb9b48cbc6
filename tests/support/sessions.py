"""The examples of a page, run as a reader would: from top to bottom, in one folder.

    ```LANGUAGE title="FILE"    what is in a file from here on
    ```console                  commands, each behind "$ ", with what they print; `echo $?` shows an exit code

A command is sleec-verify, pytest, python or git. Where it fails, `echo $?` must follow; findings (1 of sleec-verify)
speak for themselves.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from tests.support.paths import ROOT
from website.running import Ran, printed

FENCE = re.compile(r'^```(?P<language>[\w-]*)(?: title="(?P<title>[^"]+)")?\n(?P<body>.*?)^```\n', re.M | re.S)
_SECONDS = re.compile(r"\bin \d+\.\d+s\b")


class Block(NamedTuple):
    """A fenced block of a page."""

    language: str
    title: str | None
    body: str
    start: int
    end: int


def blocks(text: str) -> list[Block]:
    """Every fenced block, in order."""
    return [
        Block(match["language"], match["title"], match["body"], match.start("body"), match.end("body"))
        for match in FENCE.finditer(text)
    ]


def commands(block: Block) -> list[str]:
    """The command lines of a console block."""
    return [line[2:] for line in block.body.splitlines() if line.startswith("$ ")]


def as_printed(text: str) -> str:
    """The page with what its commands print when run in this folder, one after the other."""
    parts, end = [], 0
    for block in blocks(text):
        if block.title is not None:
            path = Path(block.title)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.body, encoding="utf-8")
        elif block.language == "console":
            parts += [text[end : block.start], *_session(commands(block))]
            end = block.end
    return "".join([*parts, text[end:]])


def _session(lines: list[str]) -> Iterator[str]:
    code = 0
    for number, line in enumerate(lines):
        if line == "echo $?":
            out = f"{code}\n"
        else:
            out, code = _run(*shlex.split(line))
            expected = code == 0 or lines[number + 1 : number + 2] == ["echo $?"]
            assert expected or (code == 1 and line.startswith("sleec-verify")), f"{line} exits with {code}:\n{out}"
        yield f"$ {line}\n{_SECONDS.sub('in 1.00s', out)}"


def _run(program: str, *arguments: str) -> Ran:
    if program == "sleec-verify":
        return printed(*arguments)
    if program == "git":
        return _git(*arguments)
    assert program in ("python", "pytest")
    module = ("-m", "pytest", "-p", "no:cacheprovider") if program == "pytest" else ()
    done = subprocess.run(
        [sys.executable, *module, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        env={**_outside_ci(), "PYTHONPATH": str(ROOT), "NO_COLOR": "1", "COLUMNS": "80"},
        timeout=100,
    )
    return Ran(done.stdout, done.returncode)


def _git(*arguments: str) -> Ran:
    """As somebody without settings of their own, but with a name."""
    nobody = {
        f"GIT_{who}_{what}": "nobody@example.org" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")
    }
    settings = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    done = subprocess.run(
        ["git", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        env={**os.environ, **nobody, **settings},
    )
    return Ran(done.stdout, done.returncode)


def _outside_ci() -> dict[str, str]:
    # In CI, pytest prints whole lines however wide the terminal is.
    return {name: value for name, value in os.environ.items() if name not in ("CI", "BUILD_NUMBER")}
