"""The options of `audit` for drafts of mappings and for pictures, and logs that cannot be read."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest

from tests.support.care_robot_log import write_care_robot_log
from tests.support.cli import Cli
from tests.support.paths import ROOT

RULES = ("--ruleset", str(ROOT / "rulesets" / "care-robot.sleec"))
MISSION = '{"time": 1, "conditions": {"Ready": true}}\n{"time": 2, "event": "Go"}\n{"time": 2.5, "executed": "Drive"}\n'
FILES = {"rules.sleec": "RULE go WHEN Go THEN Drive UNLESS NOT Ready\n", "log.jsonl": MISSION, "more.jsonl": MISSION}
SMALL = ("audit", "log.jsonl", "--ruleset", "rules.sleec")


def test_a_draft_is_a_mapping_for_the_same_log(cli: Cli, tmp_path: Path) -> None:
    write_care_robot_log(tmp_path / "mission")
    ran = cli("audit", "mission", "--suggest-mapping", *RULES)
    assert ran.code == 0
    assert 'UserUndressed = {topic = "/user_state", field = "undressed"}' in ran.out
    written = cli("audit", "mission", "--suggest-mapping", *RULES, "-o", "draft.toml")
    assert (tmp_path / "draft.toml").read_text(encoding="utf-8") == ran.out
    assert "draft.toml: 12 names of the rules have a likely meaning" in written.err
    audited = cli("audit", "mission", "--mapping", "draft.toml", *RULES, "--format", "json")
    assert audited.code == 1
    (ruleset,) = json.loads(audited.out)["rulesets"]
    findings = ruleset["findings"]
    assert {finding["code"] for finding in findings} == {"SLEEC701", "SLEEC705", "SLEEC712"}
    # The draft has lines to fill in for these names.
    (left_out,) = (finding["message"] for finding in findings if finding["code"] == "SLEEC712")
    assert left_out.startswith("the mapping has no entry for `AddressSirOrMadam`, `AddressUserName`, ")
    assert any("`ExplainWhy` has not been executed" in finding["message"] for finding in findings)


def test_a_draft_replaces_no_file(cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "draft.toml").write_text("mine")
    ran = cli(*SMALL, "--suggest-mapping", "-o", "draft.toml", files=FILES)
    assert ran.code == 2
    assert "draft.toml cannot be written" in ran.err
    assert (tmp_path / "draft.toml").read_text() == "mine"


def test_a_picture_of_the_mission(cli: Cli, tmp_path: Path) -> None:
    ran = cli(*SMALL, "--plot", "log.svg", files=FILES)
    assert ran.code == 0
    words = list(fromstring((tmp_path / "log.svg").read_bytes()).itertext())
    assert {"Timeline of log.jsonl", "Go: 1 s", "Ready true from 0 s", "Drive: executed 1.5 s"} <= set(words)


def test_the_picture_in_the_docs_is_that_of_the_example(cli: Cli, tmp_path: Path) -> None:
    files = {
        name: (ROOT / name).read_text() for name in ("examples/household_mission.jsonl", "rulesets/household.sleec")
    }
    log, rules = files
    ran = cli("audit", log, "--ruleset", rules, "--plot", "mission.svg", files=files)
    assert ran.code == 1
    shown = ROOT / "docs" / "assets" / "mission.svg"
    if os.environ.get("UPDATE_DOCUMENTS"):
        shutil.copy(tmp_path / "mission.svg", shown)
    assert shown.read_text(encoding="utf-8") == (tmp_path / "mission.svg").read_text(encoding="utf-8")


def test_a_topic_that_a_recording_does_not_have(cli: Cli, tmp_path: Path) -> None:
    write_care_robot_log(tmp_path / "mission")
    mapping = 'events.CurtainOpenRequest = {topic = "/curtain_open_request"}\n'
    ran = cli("audit", "mission", *RULES, "--mapping", "m.toml", "--format", "concise", files={"m.toml": mapping})
    assert ran.code == 3
    problem = "the recording does not have the topic `/curtain_open_request`; did you mean `/curtain_open_requests`?"
    assert problem in ran.out


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (("--plot", "x.svg", "more.jsonl"), "--plot shows one mission; name one log"),
        (("--plot", "x.svg", "--state", "s"), "--plot cannot be used with --state"),
        (("--plot", "x.svg", "-o", "x.svg"), "cannot name the same file"),
        (("--plot", "log.jsonl"), "log.jsonl is an input"),
        (("--scheduler", "tcp://x:1", "--plot", "x.svg"), "--scheduler cannot be used with --plot"),
        (("--scheduler", "tcp://x:1", "--state", "s"), "--scheduler cannot be used with --state"),
        (("--suggest-mapping", "--mapping", "m.toml"), "--suggest-mapping cannot be used with --mapping"),
    ],
)
def test_options_that_exclude_each_other(cli: Cli, arguments: tuple[str, ...], problem: str) -> None:
    ran = cli(*SMALL, *arguments, files=FILES)
    assert ran.code == 2
    assert problem in ran.err


@pytest.mark.parametrize(
    ("arguments", "library", "extra"),
    [
        (("x.mcap",), "rosbags", "logs"),
        (("x.parquet",), "pyarrow", "logs"),
        (("log.jsonl", "--scheduler", "tcp://127.0.0.1:1"), "distributed", "fleet"),
    ],
)
def test_a_library_that_is_not_installed(arguments: tuple[str, ...], library: str, extra: str, tmp_path: Path) -> None:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    program = (
        f"import sys; sys.modules[{library!r}] = None\nfrom sleec_verify.cli import run\nsys.exit(run(sys.argv[1:]))"
    )
    command = [sys.executable, "-c", program, "audit", *arguments, "--ruleset", "rules.sleec"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 2
    assert f"needs a library that is not installed: {library}" in ran.stderr
    assert f"install the extra `{extra}` of sleec-verify" in ran.stderr


def test_a_log_that_cannot_be_read_does_not_stop_the_others(cli: Cli) -> None:
    ran = cli("audit", "missing.mcap", *SMALL[1:], "log.jsonl", "--format", "json", files=FILES)
    assert ran.code == 2
    unusable, audited = sorted(json.loads(ran.out)["rulesets"], key=lambda one: "audit" in one)
    assert "file missing.mcap does not exist" in str(unusable)
    assert "log.jsonl" in str(audited)
    assert cli("audit", "missing.mcap", *SMALL[2:]).code == 2
