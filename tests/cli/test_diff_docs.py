"""The examples of docs/diff.md print what the page shows. UPDATE_DOCUMENTS=1 puts in what they print now."""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path

from tests.cli.conftest import Cli
from tests.cli.test_documents import VARYING

PAGE = Path(__file__).parents[2] / "docs" / "diff.md"
FILE = re.compile(r"`([\w.-]+)`:\n\n```sleec\n(.*?)```\n", re.DOTALL)
SESSION = re.compile(r"```console\n\$ sleec-verify (.+)\n((?:.*\n)*?)```\n")


def test_the_page_shows_what_is_printed(cli: Cli) -> None:
    text = PAGE.read_text(encoding="utf-8")
    files = dict(FILE.findall(text))
    assert set(files) == {"before.sleec", "after.sleec"}

    def session(match: re.Match[str]) -> str:
        ran = cli(*shlex.split(match.group(1)), files=files)
        assert ran.code in (0, 1)
        assert ran.err == ""
        out = VARYING.sub(r"\1…", ran.out)
        return f"```console\n$ sleec-verify {match.group(1)}\n{out}```\n"

    shown = SESSION.sub(session, text)
    if os.environ.get("UPDATE_DOCUMENTS"):
        PAGE.write_text(shown, encoding="utf-8")
    else:
        assert shown == text
    assert len(SESSION.findall(text)) >= 3
