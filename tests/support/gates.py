"""Rulesets and configurations for tests of `gate`."""

from __future__ import annotations

import json
import re
from typing import Any

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.fingerprint import fingerprint
from tests.support.cli import Cli
from tests.support.repository import Repository
from tests.support.schemas import validator

GATE = validator("gate")
OLD = "RULE a\nWHEN t THEN o\nUNLESS c IN WHICH CASE p\n"
CLASH = OLD + "RULE b\nWHEN t THEN NOT o\n"
DEAD = OLD + "UNLESS NOT c IN WHICH CASE q\n"
LOST = "RULE a\nWHEN t THEN o\n"
TIMED = "MEASURE n: integer\nRULE a\nWHEN t THEN o WITHIN n minutes OTHERWISE p\n"
TIMED_ELSE = TIMED.replace("OTHERWISE p", "OTHERWISE q")
CASES = '[[case]]\nwhen = ["t"]\nobligations = ["o"]\n'
BOTH = CASES + '[[case]]\nwhen = ["t"]\ngiven = { c = true }\nobligations = ["p"]\n'


def with_fingerprints(text: str) -> str:
    """The text with the fingerprint of the only finding of its code or check in place of each ``@?``."""
    ruleset = parse(text)
    findings = [finding for result in run_checks(ruleset) for finding in result.findings]

    def of(match: re.Match[str]) -> str:
        (mark,) = {fingerprint(ruleset, one) for one in findings if match[1] in (one.code, one.check)}
        return f"{match[1]}@{mark}"

    return re.sub(r"([\w-]+)@\?", of, text)


def config(repository: Repository, *lines: str, block: str = "") -> None:
    """A configuration with these lines, and those of what blocks, in the base."""
    blocks = f"[tool.sleec-verify.block]\n{block}\n" if block else ""
    repository.put("pyproject.toml", "\n".join(["[tool.sleec-verify]", *lines, blocks]))
    repository.keep("pyproject.toml")


def gated(cli: Cli, *arguments: str, base: str = "main") -> tuple[int, dict[str, Any]]:
    """The exit code and the JSON, after it was held against the published schema."""
    ran = cli("gate", "--base", base, "--format", "json", *arguments)
    said = json.loads(ran.out)
    GATE.validate(said)
    assert (said["status"] == "unusable") == bool(ran.err), ran.err
    return ran.code, said


def policies(said: dict[str, Any]) -> set[str]:
    return {block["policy"] for block in said["blocks"]}
