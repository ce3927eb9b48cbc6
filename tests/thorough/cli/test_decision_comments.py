"""The comment that records a decision fits every language and layout, and changes no rule."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from sleec_runtime.language import load
from sleec_verify.checks import run_checks
from tests.support.fixes import TWO
from tests.support.resolve import Answer, left

DSL = """\
def_start
    event Bell
    event Speak
    measure Storm: boolean
def_end
rule_start
    R1 when Bell then not Speak
    R2 when Bell and {Storm} then Speak
rule_end
"""


@pytest.mark.parametrize(
    "text",
    [
        DSL,
        TWO.replace("\n", "\r\n"),
        "\ufeff" + TWO,
        TWO.rstrip(),
        TWO.replace("// because", "").replace("\n", " "),
        "\n  WHEN Bell THEN NOT Speak\n  WHEN Bell AND Storm THEN Speak",
        TWO.replace("\n", "\r"),
    ],
    ids=["DSL", "Windows", "mark", "no end", "one line", "no labels", "Mac"],
)
def test_a_comment_fits_every_text(text: str, answer: Answer, tmp_path: Path) -> None:
    number = len(re.findall(r"^ +\d+  ", answer("q", text=text).output, re.MULTILINE))
    assert number > 2
    (before,) = run_checks(load(tmp_path / "a.sleec"), ["conflict"])
    for choice in range(1, number + 1):
        ran = answer(str(choice), "because", "q", text=text)
        assert ran.exception is None
        (line,) = (line for line in left(tmp_path).splitlines() if "// decision " in line)
        assert re.fullmatch(r"\ufeff?\s*// decision [0-9-]+: .*: because", line), line
        (after,) = run_checks(load(tmp_path / "a.sleec"), ["conflict"])
        assert len(after.findings) == len(before.findings) - 1
