"""Documents: rules, the commands given, what they print and their exit codes, in one file each.

    === file RULES        what is in a file
    === $ COMMAND         a command line, and below it its standard output
    === stderr            its standard error, if it prints any
    === exit CODE         its exit code, if it is not 0

UPDATE_DOCUMENTS=1 writes what is printed now into the documents; the change is then reviewed as a diff.
"""

from __future__ import annotations

import os
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.support.cli import Cli

FOLDER = Path(__file__).parent / "documents"
DOCUMENTS = sorted(FOLDER.rglob("*.txt"))
VARYING = re.compile(r'("seconds": |"version": ")[\w.+-]+')
UPDATE = bool(os.environ.get("UPDATE_DOCUMENTS"))


@dataclass
class Step:
    command: str
    out: str = ""
    err: str = ""
    code: int = 0

    def __str__(self) -> str:
        said = f"=== $ {self.command}\n{self.out}"
        if self.err:
            said += f"=== stderr\n{self.err}"
        return said + (f"=== exit {self.code}\n" if self.code else "")


def parse(text: str) -> tuple[str, dict[str, str], list[Step]]:
    """The words above the first section, the files, and the steps."""
    title, *sections = re.split(r"^=== ", text, flags=re.MULTILINE)
    files: dict[str, str] = {}
    steps: list[Step] = []
    for section in sections:
        head, _, body = section.partition("\n")
        if body and not body.endswith("\n"):
            body += "\n"
        kind, _, rest = head.partition(" ")
        if kind == "file":
            files[rest] = body
        elif kind == "$":
            steps.append(Step(rest, out=body))
        elif kind == "stderr":
            steps[-1].err = body
        else:
            steps[-1].code = int(rest)
    return title, files, steps


@pytest.mark.parametrize("path", DOCUMENTS, ids=[str(p.relative_to(FOLDER).with_suffix("")) for p in DOCUMENTS])
def test_document(path: Path, cli: Cli) -> None:
    text = path.read_text(encoding="utf-8")
    title, files, steps = parse(text)
    assert steps, f"{path} runs nothing"
    seen = []
    for step in steps:
        program, *arguments = shlex.split(step.command)
        assert program == "sleec-verify"
        ran = cli(*arguments, files=files)
        ran = ran._replace(out=VARYING.sub(r"\1…", ran.out))
        files = {}
        seen.append(Step(step.command, ran.out, ran.err, ran.code))
    if UPDATE:
        parts = [title]
        parts += (f"=== file {name}\n{body}" for name, body in parse(text)[1].items())
        path.write_text("".join([*parts, *map(str, seen)]), encoding="utf-8")
    else:
        assert [str(step) for step in seen] == [str(step) for step in steps]
