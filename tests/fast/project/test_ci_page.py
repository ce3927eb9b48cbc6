"""What docs/ci.md says of hooks, the action, commands and formats."""

from __future__ import annotations

import re
import shlex
from typing import Any

import yaml

from sleec_verify.cli.commands import sleec_verify
from sleec_verify.report import FORMATS
from tests.support.action import ACTION
from tests.support.paths import ROOT

HOOKS: list[dict[str, Any]] = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
CI = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
EXAMPLES = [yaml.safe_load(text) for text in re.findall(r"```yaml\n(.*?)```", CI, re.DOTALL)]


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
