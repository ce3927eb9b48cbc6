"""The GitHub action: its steps, run as GitHub runs them."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

import pytest
import yaml

from sleec_verify.report import FORMATS
from tests.support.action import ACTION, STEPS, Runner, act, run_step
from tests.support.hostile import plant
from tests.support.paths import ROOT
from tests.support.repository import Repository
from tests.support.sessions import blocks

CLASH = "WHEN Rung THEN Open\n\nWHEN Storm THEN NOT Open\n"


def test_the_action_is_a_composite_one() -> None:
    assert ACTION["name"]
    assert ACTION["description"]
    assert ACTION["runs"]["using"] == "composite"
    for step in STEPS.values():
        assert ("uses" in step) != ("run" in step)
        assert "run" not in step or step["shell"] == "bash"


def test_nothing_of_others_is_put_into_a_script() -> None:
    assert not any("${{" in step.get("run", "") for step in STEPS.values())


def test_every_input_is_described_and_used() -> None:
    used = set(re.findall(r"inputs\.([\w-]+)", (ROOT / "action.yml").read_text(encoding="utf-8")))
    assert used == set(ACTION["inputs"])
    assert all(given["description"] and "default" in given for given in ACTION["inputs"].values())
    assert ACTION["inputs"]["format"]["default"] in FORMATS


def test_the_action_annotates_and_fails(runner: Runner) -> None:
    (runner.checkout / "rules").mkdir()
    (runner.checkout / "rules" / "clash.sleec").write_text(CLASH)
    ran = act(runner)
    assert (ran.code, ran.outputs) == (1, "exit-code=1\n")
    assert ran.out.startswith("::error file=rules/clash.sleec,line=1,")


@pytest.mark.parametrize(("text", "code"), [("WHEN Rung THEN Open\n", 0), (CLASH, 1), ("WHEN", 2)])
def test_the_action_passes_the_exit_code_on(text: str, code: int, runner: Runner) -> None:
    (runner.checkout / "a.sleec").write_text(text)
    ran = act(runner)
    assert (ran.code, ran.outputs) == (code, f"exit-code={code}\n")


def test_the_action_takes_paths_and_options_a_line(runner: Runner) -> None:
    for name in ("a b.sleec", "-c.sleec", "$(touch evil).sleec"):
        (runner.checkout / name).write_text(CLASH)
    ran = act(
        runner,
        paths="a b.sleec\n-c.sleec\n\n$(touch evil).sleec\n",
        options="--reading=priority\n--no-cache\n",
        format="json",
        output="out.json",
        fail_level="note",
    )
    assert ran.code == 1, ran.err
    report = yaml.safe_load((runner.checkout / "out.json").read_text())
    assert [r["path"] for r in report["rulesets"]] == ["a b.sleec", "-c.sleec", "$(touch evil).sleec"]
    assert {r["reading"] for r in report["rulesets"]} == {"priority"}
    assert not (runner.checkout / "evil").exists()


def test_a_hostile_checkout_runs_nothing_in_the_check(runner: Runner, tmp_path: Path) -> None:
    environment = plant(runner.checkout, tmp_path / "marks")
    (runner.checkout / "clash.sleec").write_text(CLASH)
    ran = act(runner, environment=environment)
    assert (ran.code, ran.outputs) == (1, "exit-code=1\n"), ran.err
    assert not (tmp_path / "marks").exists()


@pytest.mark.slow
@pytest.mark.timeout(600)  # the index may be slow
def test_a_hostile_checkout_runs_nothing_in_the_installation(runner: Runner, tmp_path: Path) -> None:
    """The real installation, from the index: what it installs checks rules, and nothing of the checkout is run."""
    environment = plant(runner.checkout, tmp_path / "marks")
    plant(runner.temp, tmp_path / "marks")
    (runner.checkout / "clash.sleec").write_text(CLASH)
    values = {
        "runner.temp": str(runner.temp),
        "steps.python.outputs.python-path": sys.executable,
        "github.action_path": str(ROOT),
    }
    ran = run_step("install", runner, values, **environment)
    assert ran.code == 0, ran.err
    name, _, python = ran.outputs.strip().partition("=")
    assert name == "python"
    ran = act(runner, python, environment)
    assert (ran.code, ran.outputs) == (1, "exit-code=1\n"), ran.err
    assert ran.out.startswith("::error file=clash.sleec,line=1,")
    assert not (tmp_path / "marks").exists()


def test_the_page_on_security_shows_what_the_action_installs() -> None:
    """The action runs it with more options, which say how and not what."""

    def installed(text: str) -> list[set[str]]:
        lines = re.findall(r"^(?:python -I -m pip install|\"\$\{install\[@\]\}\") (.*)$", text, re.MULTILINE)
        how = {"--no-build-isolation", "--use-pep517"}
        return [{part.strip('"').replace("$SOURCE", ".") for part in line.split()} - how for line in lines]

    shown, _ = blocks((ROOT / "SECURITY.md").read_text(encoding="utf-8"))
    in_the_action = installed(STEPS["install"]["run"].replace("$SOURCE/requirements", "requirements"))
    assert len(in_the_action) == 3
    assert installed(shown.body) == in_the_action


def test_the_installation_runs_outside_the_checkout() -> None:
    """One more wall: the test above passes without it, as long as Python is isolated."""
    assert STEPS["install"]["working-directory"] == "${{ runner.temp }}"


def test_what_the_action_uses_is_pinned_by_commit() -> None:
    for step in STEPS.values():
        if "uses" in step:
            assert re.fullmatch(r"[\w-]+/[\w-]+@[0-9a-f]{40}", step["uses"])


def test_a_wrong_input_of_the_action_is_told(runner: Runner) -> None:
    ran = act(runner, format="xml")
    assert (ran.code, ran.outputs) == (2, "exit-code=2\n")
    assert "'xml' is not one of" in ran.err


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_with_a_base_the_action_is_the_gate(runner: Runner) -> None:
    repository = Repository(runner.checkout)
    repository.put("sleec-verify.toml", 'rulesets = ["rules"]\n')
    repository.put("rules/a.sleec", "WHEN Rung THEN Open\n")
    repository.put("others/b.sleec", "WHEN")
    repository.commit()
    ran = act(runner, base="main")
    assert (ran.code, ran.outputs) == (0, "exit-code=0\n"), ran.err
    assert ran.out.endswith("passed: no rulesets examined, 1 unchanged since main\n")
    repository.put("rules/a.sleec", CLASH)
    ran = act(runner, base="main", options="--no-cache\n")
    assert (ran.code, ran.outputs) == (1, "exit-code=1\n")
    assert ran.out.startswith("::error file=rules/a.sleec,line=1,")
    ran = act(runner, base="main", paths="others")
    assert ran.code == 0
    ran = act(runner, base="--summary=x")
    assert (ran.code, "there is no revision --summary=x" in ran.err) == (2, True)
