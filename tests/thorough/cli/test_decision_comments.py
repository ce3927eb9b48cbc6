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


@pytest.mark.slow
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


DOORS = "EXCLUSIVE Open, Lock\nRULE a\nWHEN Bell THEN Open\nRULE b\nWHEN Night THEN Lock"


@pytest.mark.parametrize("end", ["", "\n", "\n\n// the end\n"])
@pytest.mark.parametrize(
    ("title", "above"),
    [
        ("add `ASSUME NOT (Bell AND Night)`", "ASSUME NOT (Bell AND Night)"),
        ("add to the trigger of rule `a`: `AND NOT Night`", "RULE a"),
        ("add to rule `b`: `UNLESS Bell IN WHICH CASE Open`", "RULE b"),
    ],
)
def test_the_comment_is_above_what_changed(title: str, above: str, end: str, answer: Answer, tmp_path: Path) -> None:
    shown = answer("q", text=DOORS + end).output
    (number,) = re.findall(rf"^ *(\d+)  {re.escape(title)}$", shown, re.MULTILINE)
    answer(number, "", "q", text=DOORS + end)
    lines = left(tmp_path).splitlines()
    (at,) = (number for number, line in enumerate(lines) if line.startswith("// decision "))
    assert lines[at + 1] == above


def test_a_removed_rule_leaves_its_comment(answer: Answer, tmp_path: Path) -> None:
    shown = answer("q").output
    (number,) = re.findall(r"^ *(\d+)  remove rule `air`$", shown, re.MULTILINE)
    answer(number, "", "q")
    lines = left(tmp_path).splitlines()
    assert "`air` gives way to `privacy` and is removed" in lines[3]
    assert lines[4] == "RULE quiet"
