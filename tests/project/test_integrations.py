"""The pre-commit hooks, the GitHub action, and what docs/ci.md says of them."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from sleec_verify.cli.commands import sleec_verify
from sleec_verify.report import FORMATS
from tests.cli.repository import Repository

ROOT = Path(__file__).parents[2]
HOOKS: list[dict[str, Any]] = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
STEPS: dict[str, dict[str, Any]] = {step["id"]: step for step in ACTION["runs"]["steps"]}
CI = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
EXAMPLES = [yaml.safe_load(text) for text in re.findall(r"```yaml\n(.*?)```", CI, re.DOTALL)]
CLASH = "WHEN Rung THEN Open\n\nWHEN Storm THEN NOT Open\n"


@pytest.fixture
def program(tmp_path: Path) -> Path:
    """The command, in a folder `bin` of its own."""
    folder = tmp_path / "bin"
    folder.mkdir()
    command = folder / "sleec-verify"
    command.write_text(f'#!/bin/sh\nPYTHONPATH="{ROOT}" exec "{sys.executable}" -m sleec_verify "$@"\n')
    command.chmod(0o755)
    return command


# pre-commit --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("hook", HOOKS, ids=lambda hook: hook["id"])
def test_hooks_have_what_pre_commit_asks_for(hook: dict[str, Any]) -> None:
    assert {"id", "name", "entry", "language"} <= set(hook)
    assert hook["language"] == "python"
    assert re.search(hook["files"], "rules/a.sleec")
    assert not re.search(hook["files"], "rules/a.sleec.bak")


def run_hook(name: str, program: Path, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run a hook as pre-commit does: its entry, its arguments, the files."""
    (hook,) = (hook for hook in HOOKS if hook["id"] == name)
    entry = shlex.split(hook["entry"])
    assert entry[0] == program.name
    return subprocess.run([str(program), *entry[1:], *arguments], cwd=folder, capture_output=True, text=True)


def test_the_check_hook_blocks_conflicts(program: Path, tmp_path: Path) -> None:
    (tmp_path / "clash.sleec").write_text(CLASH)
    (tmp_path / "fine.sleec").write_text("WHEN Rung THEN Open\n")
    assert run_hook("sleec-check", program, tmp_path, "fine.sleec").returncode == 0
    done = run_hook("sleec-check", program, tmp_path, "clash.sleec", "fine.sleec")
    assert done.returncode == 1
    assert done.stdout.startswith("clash.sleec:1:1: error[SLEEC101]")


def test_the_layout_hook_changes_what_is_not_laid_out(program: Path, tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_text("WHEN   Rung THEN Open\n")
    assert run_hook("sleec-fmt", program, tmp_path, "a.sleec").returncode == 0
    assert path.read_text() == "WHEN Rung THEN Open\n"
    path.write_text("WHEN")
    assert run_hook("sleec-fmt", program, tmp_path, "a.sleec").returncode == 2


# The action --------------------------------------------------------------------------------------------------


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


def act(program: Path, folder: Path, **inputs: str) -> tuple[subprocess.CompletedProcess[str], str]:
    """Run the action's step that checks, as GitHub does, with these inputs and the others' defaults; and the outputs
    that it sets."""
    step = STEPS["check"]
    given = {name: value["default"] for name, value in ACTION["inputs"].items()}
    given.update({name.replace("_", "-"): value for name, value in inputs.items()})
    environment = dict(os.environ)
    for name, expression in step["env"].items():
        match = re.fullmatch(r"\$\{\{ (?:inputs\.([\w-]+)|steps\.install\.outputs\.program) \}\}", expression)
        assert match, expression
        environment[name] = str(program) if match[1] is None else given[match[1]]
    outputs = folder / "outputs"
    outputs.write_text("")
    line = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]]
    done = subprocess.run(
        line, cwd=folder, env={**environment, "GITHUB_OUTPUT": str(outputs)}, capture_output=True, text=True
    )
    return done, outputs.read_text()


def test_the_action_annotates_and_fails(program: Path, tmp_path: Path) -> None:
    (tmp_path / "rules").mkdir()
    (tmp_path / "rules" / "clash.sleec").write_text(CLASH)
    done, outputs = act(program, tmp_path)
    assert (done.returncode, outputs) == (1, "exit-code=1\n")
    assert done.stdout.startswith("::error file=rules/clash.sleec,line=1,")


@pytest.mark.parametrize(("text", "code"), [("WHEN Rung THEN Open\n", 0), (CLASH, 1), ("WHEN", 2)])
def test_the_action_passes_the_exit_code_on(text: str, code: int, program: Path, tmp_path: Path) -> None:
    (tmp_path / "a.sleec").write_text(text)
    done, outputs = act(program, tmp_path)
    assert (done.returncode, outputs) == (code, f"exit-code={code}\n")


def test_the_action_takes_paths_and_options_a_line(program: Path, tmp_path: Path) -> None:
    for name in ("a b.sleec", "-c.sleec", "$(touch evil).sleec"):
        (tmp_path / name).write_text(CLASH)
    done, _ = act(
        program,
        tmp_path,
        paths="a b.sleec\n-c.sleec\n\n$(touch evil).sleec\n",
        options="--reading=priority\n--no-cache\n",
        format="json",
        output="out.json",
        fail_level="note",
    )
    assert done.returncode == 1, done.stderr
    report = yaml.safe_load((tmp_path / "out.json").read_text())
    assert [r["path"] for r in report["rulesets"]] == ["a b.sleec", "-c.sleec", "$(touch evil).sleec"]
    assert {r["reading"] for r in report["rulesets"]} == {"priority"}
    assert not (tmp_path / "evil").exists()


def test_a_wrong_input_of_the_action_is_told(program: Path, tmp_path: Path) -> None:
    done, outputs = act(program, tmp_path, format="xml")
    assert (done.returncode, outputs) == (2, "exit-code=2\n")
    assert "'xml' is not one of" in done.stderr


@pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")
def test_with_a_base_the_action_is_the_gate(program: Path, tmp_path: Path) -> None:
    folder = tmp_path / "project"
    folder.mkdir()
    repository = Repository(folder)
    repository.put("sleec-verify.toml", 'rulesets = ["rules"]\n')
    repository.put("rules/a.sleec", "WHEN Rung THEN Open\n")
    repository.put("others/b.sleec", "WHEN")
    repository.commit()
    done, outputs = act(program, folder, base="main")
    assert (done.returncode, outputs) == (0, "exit-code=0\n"), done.stderr
    assert done.stdout.endswith("passed: no rulesets examined, 1 the same as in main\n")
    repository.put("rules/a.sleec", CLASH)
    done, outputs = act(program, folder, base="main", options="--no-cache\n")
    assert (done.returncode, outputs) == (1, "exit-code=1\n")
    assert done.stdout.startswith("::error file=rules/a.sleec,line=1,")
    done, _ = act(program, folder, base="main", paths="others")
    assert done.returncode == 0
    done, _ = act(program, folder, base="--summary=x")
    assert (done.returncode, "there is no revision --summary=x" in done.stderr) == (2, True)


# What docs/ci.md says ----------------------------------------------------------------------------------------


def test_the_examples_name_hooks_and_inputs_that_exist() -> None:
    hooks = [hook for one in EXAMPLES for repo in one.get("repos", ()) for hook in repo["hooks"]]
    assert {hook["id"] for hook in hooks} == {hook["id"] for hook in HOOKS}
    jobs = [job for one in EXAMPLES for job in one.get("jobs", {}).values()]
    uses = [step for job in jobs for step in job["steps"] if "/sleec-verify@" in step["uses"]]
    assert len(uses) == 3
    for step in uses:
        assert set(step["with"]) <= set(ACTION["inputs"])


def test_commands_in_the_examples_have_options_that_exist() -> None:
    scripts = [
        line for one in EXAMPLES for job in one.values() if isinstance(job, dict) for line in job.get("script", ())
    ]
    commands = [shlex.split(line)[1:] for line in scripts if line.startswith("sleec-verify ")]
    assert commands
    for name, *arguments in commands:
        context = sleec_verify.make_context("sleec-verify", [name, *arguments])
        command = sleec_verify.get_command(context, name)
        assert command is not None
        command.make_context(name, arguments)


def test_every_format_is_described() -> None:
    assert re.findall(r"^\| `(\w+)` \|", CI, re.MULTILINE) == list(FORMATS)
