"""Reports in the formats that other programs read."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from typing import Any

import jsonschema

from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.report import renderer
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.palette import PLAIN
from sleec_verify.results.finding import CheckResult, Proved, Unknown
from tests.support.paths import ROOT

CLEAN = "WHEN Rung THEN OpenDoor\nUNLESS Night IN WHICH CASE AskWho\n"
CLASH = """\
MEASURE Pain: number
RULE one
WHEN Rung THEN Open
UNLESS Night AND Pain > 0.5 IN WHICH CASE Ask
RULE two
WHEN Storm AND Awake THEN NOT Open
"""
BROKEN = "RULE one\nWHEN Rung THEN\n"
COMMAND = re.compile(r"::(error|warning|notice) ([^:]*)::(.*)")
SARIF = json.loads((ROOT / "tests" / "support" / "standards" / "sarif-2.1.0.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.validators.validator_for(SARIF)(SARIF)


def shown(form: str, *outcomes: Any) -> str:
    return "".join(renderer(form)(outcomes, PLAIN))


def checked_text(text: str, path: str = "a.sleec", realizable: int | None = None) -> CheckedRuleset:
    ruleset = parse(text, path)
    return CheckedRuleset(ruleset, run_checks(ruleset, realizable=realizable))


def sarif(*outcomes: Any) -> dict[str, Any]:
    """The run of a log, after it was held against the schema."""
    log = json.loads(shown("sarif", *outcomes))
    VALIDATOR.validate(log)
    (run,) = log["runs"]
    assert isinstance(run, dict)
    return run


def commands_in(text: str) -> list[tuple[str, dict[str, str], str]]:
    """The workflow commands as GitHub reads them: split at commas and colons first, unescaped then."""

    def unescaped(value: str) -> str:
        for code, character in (("%3A", ":"), ("%2C", ","), ("%0D", "\r"), ("%0A", "\n"), ("%25", "%")):
            value = value.replace(code, character)
        return value

    found = []
    for line in text.splitlines():
        match = COMMAND.fullmatch(line)
        if match:
            pairs = (pair.split("=", 1) for pair in match[2].split(","))
            found.append((match[1], {name: unescaped(value) for name, value in pairs}, unescaped(match[3])))
    return found


def give_up(ruleset: Ruleset, *_: object, **__: object) -> tuple[CheckResult, ...]:
    return (CheckResult("conflict", Unknown("the solver gave up"), 0.5), CheckResult("dead-rule", Proved(), 0.1))


def is_complete(form: str, text: str, code: int) -> None:
    """What the format must hold for this exit code, and that it is of the format at all."""
    if form == "sarif":
        log = json.loads(text)
        VALIDATOR.validate(log)
        (run,) = log["runs"]
        kinds = [result["kind"] for result in run["results"]]
        assert ("fail" in kinds, "open" in kinds) == (code == 1, code == 3)
        (invocation,) = run["invocations"]
        assert invocation["executionSuccessful"] == (code in (0, 1))
        levels = [told["level"] for told in invocation["toolExecutionNotifications"]]
        assert levels == (["error"] if code in (2, 3) else [])
    elif form == "junit":
        root = ET.fromstring(text)
        assert (root.find(".//failure") is not None, root.find(".//error") is not None) == (code == 1, code in (2, 3))
        assert int(root.get("failures", "")) + int(root.get("errors", "")) == (0 if code == 0 else 1)
    elif form == "github":
        assert [kind for kind, _, _ in commands_in(text)] == ([] if code == 0 else ["error"])
    elif form == "gitlab":
        severities = [issue["severity"] for issue in json.loads(text)]
        assert severities == {0: [], 1: ["critical"], 2: ["blocker"], 3: ["critical"]}[code]
    elif form == "json":
        assert json.loads(text)["rulesets"]
    else:  # of what cannot be read, "full" tells on standard error only
        assert text.endswith("\n") or (form, code) == ("full", 2)
