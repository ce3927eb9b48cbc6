"""The robot of examples/robot: its mission over DDS, also in a copy in which a task does something else."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.dds import PATIENCE, eventually, require_dds, unused_domain
from tests.support.paths import ROOT

require_dds()


def run(folder: Path, log: Path, package: str = "examples.robot") -> subprocess.CompletedProcess[str]:
    """Runs the robot `package` of the project in `folder`."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(unused_domain()), "PYTHONPATH": str(folder)}
    environment.pop("CYCLONEDDS_URI", None)
    return subprocess.run(
        [sys.executable, "-m", package, str(log)],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A copy of the robot and its rules. A copy has a name of its own."""
    shutil.copytree(ROOT / "examples/robot", tmp_path / "robots/mine")
    (tmp_path / "rulesets").mkdir()
    shutil.copy(ROOT / "rulesets/care-robot.sleec", tmp_path / "rulesets")
    return tmp_path


def change(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1
    file.write_text(text.replace(old, new), encoding="utf-8")


def test_the_mission_ends_without_deviation(tmp_path: Path) -> None:
    log = tmp_path / "mission.jsonl"
    done = run(ROOT, log)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "error" not in done.stderr
    assert "It greets a patient.\n    AddressUserName: the robot executes UsePreferredName" in done.stdout
    assert "The mission has ended with no deviations." in done.stdout
    # The audit.
    assert "clause coverage: 19 of 19" in done.stdout
    assert "1 check passed" in done.stdout
    assert '"topic": "/actions"' in log.read_text(encoding="utf-8")


def test_a_task_that_does_something_else_is_noticed(copy: Path) -> None:
    change(copy / "robots/mine/tasks.py", "        self.refuse_request()\n", "        self.open_curtains()\n")
    change(
        copy / "robots/mine/mission.py",
        "mission.run(MISSION)",
        "mission.run((MISSION[0], MISSION[11], MISSION[13]))",
    )
    done = run(copy, copy / "mission.jsonl", "robots.mine")
    assert done.returncode == 1
    assert "DEVIATION: the robot has to execute RefuseRequest and ExplainWhy" in done.stdout
    assert "The mission has ended with 1 deviation." in done.stdout
    # The audit notices it by itself.
    assert "RefuseRequest" in done.stdout.partition("The record is")[2]
    assert "1 error" in done.stdout


def test_a_process_that_fails_is_named(copy: Path) -> None:
    (copy / "robots/mine/context_manager.py").write_text("raise SystemExit('no')\n", encoding="utf-8")
    done = run(copy, copy / "mission.jsonl", "robots.mine")
    assert done.returncode == 1
    assert "the process `context_manager` failed" in done.stderr


def test_a_task_that_was_not_started_is_noticed(copy: Path) -> None:
    change(copy / "robots/mine/__main__.py", '    ("tasks", "Triage"),\n', "")
    change(copy / "robots/mine/mission.py", "PATIENCE = 20.0", "PATIENCE = 2.0")
    done = run(copy, copy / "mission.jsonl", "robots.mine")
    assert done.returncode == 1
    assert "4 processes receive triggers, and 5 are expected" in done.stderr


@pytest.mark.parametrize("line", ["", "It greets a patient", "has ended"])
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_all_processes(number: signal.Signals, code: int, line: str, tmp_path: Path) -> None:
    log = tmp_path / "mission.jsonl"
    robot = subprocess.Popen(
        [sys.executable, "-m", "examples.robot", str(log)],
        cwd=ROOT,
        env={**os.environ, "ROS_DOMAIN_ID": str(unused_domain())},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    assert eventually(log.exists)
    assert robot.stdout is not None
    while line and line not in robot.stdout.readline():
        pass
    # To all processes of the session, as a terminal does.
    os.killpg(robot.pid, number)
    # The output ends when the last process has ended.
    out, _ = robot.communicate(timeout=PATIENCE)
    assert "Traceback" not in out
    assert robot.returncode == code
