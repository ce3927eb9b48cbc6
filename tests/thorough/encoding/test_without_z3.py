"""Without z3, what needs arithmetic is unknown."""

from __future__ import annotations

import sys

import pytest

from sleec_verify.cli import run
from sleec_verify.results.finding import Proved, Unknown
from tests.support.calculations import NEEDS_Z3, TEXT, results


@pytest.fixture
def no_z3(monkeypatch):
    from sleec_verify.encoding import arithmetic

    arithmetic.answer.cache_clear()
    monkeypatch.setitem(sys.modules, "z3", None)
    yield
    arithmetic.answer.cache_clear()


def test_without_z3_the_answer_is_unknown_and_says_of_what(no_z3):
    verdict = results(*NEEDS_Z3)["conflict"]
    assert isinstance(verdict, Unknown)
    line = TEXT[: TEXT.index("%s")].count("\n") + 1
    assert f"`x + y` in line {line}" in verdict.why
    assert "pip install z3-solver" in verdict.why


def test_without_z3_what_needs_no_arithmetic_is_answered(no_z3):
    verdicts = results(
        "R1 when A and (({x} + {y}) < 3) then B",
        "R2 when A and (({x} + {y}) < 2) then B",
    )
    assert isinstance(verdicts["conflict"], Proved)
    assert isinstance(verdicts["dead-rule"], Proved)
    assert [f.rules for f in verdicts["redundant-rule"].findings] == [("R2", "R1")]


def test_without_z3_what_is_near_is_found(no_z3):
    verdicts = results(
        "R1 when A and (({x} + (3 * {y})) = 10 and {y} < 3) then B",
        "R2 when A and (({x} * {y}) > 6 ) then not B",
    )
    assert isinstance(verdicts["dead-rule"], Proved)
    (finding,) = verdicts["conflict"].findings
    assert finding.witness is not None
    x, y = (int(finding.witness.conditions[name]) for name in "xy")
    assert x + 3 * y == 10
    assert x * y > 6


def test_without_z3_the_command_says_unknown(no_z3, tmp_path, capsys):
    path = tmp_path / "rules.sleec"
    path.write_text(TEXT % ("\n".join(NEEDS_Z3), ""))
    assert run(["check", "--no-cache", str(path)]) == 3
    out = capsys.readouterr()
    assert "unknown[conflict]" in out.out + out.err
    assert "x + y" in out.out + out.err
