"""The theorems about the shipped rulesets are about these rulesets, and none is missing.

That they hold is for Coq to say (`make proofs`). The steps of a refutation may be any that Coq accepts, so that they
are not compared: another version of a solver finds others.
"""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from sleec_runtime.language import load, parse
from sleec_verify.certificates.theory import theorems as theorems_module
from sleec_verify.certificates.theory.theorems import assumptions, but_steps, file_of, main, modules, theorems
from sleec_verify.certificates.theory.theory_questions import not_modelled
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Proved
from tests.support.paths import ROOT
from tests.support.theory_oracle import PROOFS

RULESETS = sorted((ROOT / "rulesets").glob("*.sleec"))
WRITTEN = PROOFS / "rulesets"
RENEW = "the rules have changed, or how they are written in Coq: make theorems"


def proved(path: Path) -> bool:
    ruleset = load(path)
    return not_modelled(ruleset, chains=False) is None and isinstance(
        run_checks(ruleset, ["conflict"], chains=False)[0].verdict, Proved
    )


_STEP = r"Add \d+ \[(?:(?:Pos|Neg) \d+(?:; (?:Pos|Neg) \d+)*)?\] \[(?:\d+(?:; \d+)*)?\]"
STEPS = re.compile(rf"Definition steps : list step :=\n  \[ {_STEP}(?:;\n    {_STEP})* \]\.\n\nEnd ")


@pytest.mark.parametrize("path", sorted(WRITTEN.glob("*.v")), ids=lambda path: path.stem)
def test_what_is_not_compared_is_steps_and_nothing_else(path: Path) -> None:
    text = path.read_text("utf-8")
    assert len(STEPS.findall(text)) == text.count("Definition steps") == text.count("Theorem ")
    assert len(but_steps(text)) == len(STEPS.sub("", text))


@pytest.mark.parametrize("path", RULESETS, ids=lambda path: path.stem)
def test_the_theorems_are_those_of_the_rules(path: Path) -> None:
    written = WRITTEN / f"{file_of(path)}.v"
    assert written.exists() == proved(path), RENEW
    if written.exists():
        ruleset = load(path)
        text = theorems(ruleset, dict.fromkeys(modules(ruleset), ()))
        assert but_steps(written.read_text("utf-8")) == but_steps(text), RENEW


def test_no_theorem_is_of_other_rules() -> None:
    files = {file_of(path): list(modules(load(path))) for path in RULESETS if proved(path)}
    assert {path.stem for path in WRITTEN.glob("*.v")} == {*files, "Assumptions"}, RENEW
    assert (WRITTEN / "Assumptions.v").read_text("utf-8") == assumptions(files.items()), RENEW


def test_a_change_of_the_rules_is_seen() -> None:
    text = (RULESETS[0].parent / "household.sleec").read_text("utf-8")
    ruleset = parse(text, "household.sleec")
    steps = dict.fromkeys(modules(ruleset), ())
    before = but_steps(theorems(ruleset, steps))
    for old, new in (("UserUndressed IN", "NOT UserUndressed IN"), ("READING cascade", "READING priority")):
        assert old in text
        changed = parse(text.replace(old, new), "household.sleec")
        assert but_steps(theorems(changed, steps)) != before


def test_without_the_oracle_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(theorems_module, "built", lambda: None)
    assert main([str(RULESETS[0]), "-o", str(tmp_path / "new")]) == 2
    assert "make -C proofs oracle-alone" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


CONFLICTING = "RULE a\nWHEN T THEN X\nRULE b\nWHEN T AND c THEN NOT X\nUNLESS d IN WHICH CASE Y\n"
ODD = """\
MEASURE Age: number
EXCLUSIVE open the door, wave
RULE a.b
WHEN the bell rings THEN (open the door UNLESS not asleep IN WHICH CASE Y)
UNLESS Age < 18 OR Age >= 65 IN WHICH CASE NOT open the door
RULE c
WHEN the bell rings AND Age = 18 AND NOT asleep THEN open the door
"""


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_what_is_written_is_proved_and_only_that(
    oracle: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in (("conflicting", CONFLICTING), ("9-odd", ODD), ("timed", "WHEN T THEN X WITHIN 5 minutes\n")):
        (tmp_path / f"{name}.sleec").write_text(text, encoding="utf-8")
    paths = [str(tmp_path / f"{name}.sleec") for name in ("conflicting", "9-odd", "timed")]
    out = tmp_path / "coq"
    out.mkdir()
    (out / "Stale.v").write_text("")
    assert main([*paths, "-o", str(out)]) == 0
    said = capsys.readouterr().out
    assert "conflicting.sleec: no theorem: it may conflict" in said
    assert "timed.sleec: no theorem: the theory covers neither time" in said
    assert "9-odd.sleec: r_9_odd_conflict_free" in said
    assert {path.name for path in out.glob("*.v")} == {"R_9_odd.v", "Assumptions.v"}
    assert compiled(out, "R_9_odd.v") == ""
    assert compiled(out, "Assumptions.v") == ""

    # The same steps prove nothing of rules that conflict.
    ruleset = load(paths[0])
    (out / "Forged.v").write_text(theorems(ruleset, {"conflicting": [(900, (), (1,))]}), encoding="utf-8")
    assert "Unable to unify" in compiled(out, "Forged.v")


def compiled(folder: Path, name: str) -> str:
    """What Coq complains of."""
    libraries = [
        word
        for library, path in (("Sleec", "theory"), ("Checker", "checker"), ("Oracle", "oracle"))
        for word in ("-R" if library == "Sleec" else "-Q", str(PROOFS / path), library)
    ]
    done = subprocess.run(
        ["coqc", *libraries, "-Q", str(folder), "Rulesets", str(folder / name)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode == 0) == (not done.stderr)
    return done.stderr
