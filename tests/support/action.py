"""The GitHub action's steps, run as GitHub runs them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import yaml

from tests.support.paths import ROOT

ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
STEPS: dict[str, dict[str, Any]] = {step["id"]: step for step in ACTION["runs"]["steps"]}


@dataclass(frozen=True)
class Runner:
    """The folders of a job: the checkout, which a pull request writes, and the runner's own."""

    checkout: Path
    temp: Path

    @property
    def outputs(self) -> Path:
        return self.temp / "outputs"


class Ran(NamedTuple):
    code: int
    out: str
    err: str
    outputs: str


def run_step(name: str, runner: Runner, values: dict[str, str], **environment: str) -> Ran:
    """Run a step's script as GitHub does, with these values of the expressions in it."""
    step = STEPS[name]

    def value(text: str) -> str:
        return re.sub(r"\$\{\{ ([\w.-]+) \}\}", lambda match: values[match[1]], text)

    runner.outputs.write_text("")
    done = subprocess.run(
        ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]],
        cwd=value(step["working-directory"]) if "working-directory" in step else runner.checkout,
        env={
            **os.environ,
            **environment,
            **{variable: value(expression) for variable, expression in step["env"].items()},
            "RUNNER_TEMP": str(runner.temp),
            "GITHUB_OUTPUT": str(runner.outputs),
        },
        capture_output=True,
        text=True,
    )
    return Ran(done.returncode, done.stdout, done.stderr, runner.outputs.read_text())


def act(runner: Runner, python: str = sys.executable, environment: dict[str, str] | None = None, **inputs: str) -> Ran:
    """Run the step that checks, with these inputs, the others' defaults, and this Python."""
    values = {f"inputs.{name}": str(given["default"]) for name, given in ACTION["inputs"].items()}
    values.update({f"inputs.{name.replace('_', '-')}": given for name, given in inputs.items()})
    return run_step("check", runner, {**values, "steps.install.outputs.python": python}, **(environment or {}))


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    job = Runner(tmp_path / "checkout", tmp_path / "temp")
    job.checkout.mkdir()
    job.temp.mkdir()
    return job
