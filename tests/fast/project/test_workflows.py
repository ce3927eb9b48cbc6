"""The workflows, our own and those that the documentation shows: what they may do, and what they run."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.support.action import Runner, act
from tests.support.paths import ROOT
from tests.support.pyprojects import VERIFY
from tests.support.sessions import blocks

OWN = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / ".github" / "workflows").iterdir()}
SHOWN = {
    f"{page.relative_to(ROOT)}:{number}": block.body
    for page in sorted((ROOT / "docs").rglob("*.md"))
    for number, block in enumerate(blocks(page.read_text(encoding="utf-8")))
    if block.language == "yaml" and "\njobs:" in block.body
}
WORKFLOWS = {name: yaml.safe_load(text) for name, text in (OWN | SHOWN).items()}


def steps(workflow: dict[str, Any]) -> list[dict[str, Any]]:
    return [step for job in workflow["jobs"].values() for step in job["steps"]]


@pytest.mark.parametrize("name", WORKFLOWS)
def test_a_workflow_has_the_least_rights(name: str) -> None:
    workflow = WORKFLOWS[name]
    uploads = any("upload-sarif" in step.get("uses", "") for step in steps(workflow))
    assert workflow["permissions"] == {"contents": "read"} | ({"security-events": "write"} if uploads else {})
    assert not any("permissions" in job for job in workflow["jobs"].values())
    assert "pull_request_target" not in str(workflow[True])  # `on`, as YAML reads it
    for step in steps(workflow):
        if step.get("uses", "").startswith("actions/checkout@"):
            assert step["with"]["persist-credentials"] is False
        assert "${{" not in step.get("run", "")


@pytest.mark.parametrize("name", OWN | SHOWN)
def test_actions_are_pinned_by_commit(name: str) -> None:
    for used in re.findall(r"uses: (.*)", (OWN | SHOWN)[name]):
        assert re.fullmatch(r"\./|OWNER/sleec-verify@REVISION|[\w./-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+", used), used


def test_one_version_of_an_action_is_used() -> None:
    text = "\n".join([*OWN.values(), *SHOWN.values(), (ROOT / "action.yml").read_text(encoding="utf-8")])
    used = {tuple(use.split("@")) for use in re.findall(r"uses: ([\w./-]+@[0-9a-f]{40}.*)", text)}
    assert len({action for action, _ in used}) == len(used)


def test_ci_runs_on_every_python() -> None:
    job = WORKFLOWS["ci.yml"]["jobs"]["test"]
    supported = [
        classifier.rpartition(" ")[2]
        for classifier in VERIFY["project"]["classifiers"]
        if re.search(r":: 3\.\d+$", classifier)
    ]
    assert job["strategy"]["matrix"]["python"] == supported
    assert job["steps"][-1] == {"run": ".ci/run"}


def checked() -> list[dict[str, Any]]:
    """The inputs of our own action in our own workflow, but for the gate."""
    return [
        {name.replace("-", "_"): value for name, value in step["with"].items()}
        for step in steps(WORKFLOWS["ci.yml"])
        if step.get("uses") == "./" and "base" not in step["with"]
    ]


def test_the_action_passes_on_our_rulesets_but_for_the_one_with_conflicts(runner: Runner) -> None:
    shutil.copytree(ROOT / "rulesets", runner.checkout / "rulesets")
    passing, failing = checked()
    ran = act(runner, **passing)
    assert ran.code == 0, ran.out
    ran = act(runner, **failing)
    assert (ran.code, ran.outputs) == (1, "exit-code=1\n")
    named = f"{passing['paths']}\n{failing['paths']}".split()
    assert {Path(path).name for path in named} == {path.name for path in (ROOT / "rulesets").glob("*.sleec")}
