"""A process that is killed, and another one that goes on with what was pending."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

PROGRAM = '''
import json, os, sys, time
from pathlib import Path
from sleec_runtime import Sleec, obligation
from sleec_runtime.errors import Prohibited
from sleec_runtime.language import parse

RULES = """
RULE fall WHEN Fall THEN CallNurse WITHIN 1 seconds OTHERWISE CallAmbulance WITHIN 1 minute
RULE rest WHEN Sleep THEN NOT Vacuum WITHIN 1 hour
RULE dust WHEN Dust THEN Vacuum
RULE soon WHEN Morning THEN OfferWalk WITHIN 1 TO 600 seconds
RULE later WHEN Morning THEN OfferTea WITHIN 300 TO 600 seconds
RULE lift WHEN Lift THEN LiftPatient WITHIN 1 seconds OTHERWISE LowerPatient
"""
path, what = Path(sys.argv[1]), sys.argv[2]

def say(*words):
    print(*words, flush=True)

def save():
    new = path.with_suffix(".new")
    with new.open("w") as file:
        json.dump(sleec.pending_snapshot(), file)
        file.flush()
        os.fsync(file.fileno())
    os.replace(new, path)

def lift_patient():
    save()
    say("lifting")
    time.sleep(600)

sleec = Sleec(parse(RULES), on_error=lambda failure: say("failure:", failure))
sleec.implement({
    "CallNurse": obligation("CallNurse", completes=False)(lambda where: say("nurse:", where)),
    "CallAmbulance": obligation("CallAmbulance", completes=False)(lambda where: say("ambulance:", where)),
    "Vacuum": lambda: say("vacuum"),
    "OfferWalk": lambda: say("walk"),
    "OfferTea": lambda: say("tea"),
    "LiftPatient": lift_patient,
    "LowerPatient": lambda: say("lower"),
})
if what == "restore":
    sleec.restore(json.loads(path.read_text()))
    try:
        sleec.trigger("Dust")
    except Prohibited as refusal:
        say("refused:", refusal.obligation)
elif what == "lift":
    sleec.trigger("Lift")
elif what == "save":
    sleec.trigger_all(["Sleep", "Morning"])
    save()
    say("saving")
    while True:
        sleec.trigger("Sleep")
        save()
else:
    sleec.trigger("Fall", "bath")
    sleec.trigger_all(["Sleep", "Morning"])
    save()
    say("saved")
time.sleep(600)
'''


@contextmanager
def running(path: Path, what: str) -> Iterator[subprocess.Popen[str]]:
    """A process, which is killed at the end of the block."""
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(path), what],
        cwd=Path(__file__).parents[2],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        yield process
    finally:
        process.send_signal(signal.SIGKILL)
        process.communicate()
    assert process.returncode == -signal.SIGKILL


def lines(process: subprocess.Popen[str], number: int) -> list[str]:
    assert process.stdout is not None
    return [process.stdout.readline().strip() for _ in range(number)]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "pending.json"


def test_what_is_pending_survives_a_kill(path: Path) -> None:
    with running(path, "trigger") as process:
        assert lines(process, 2) == ["nurse: bath", "saved"]
    saved_at = json.loads(path.read_text(encoding="utf-8"))["saved_at"]
    time.sleep(max(0, saved_at + 1.1 - time.time()))
    with running(path, "restore") as process:
        assert sorted(lines(process, 4)) == [
            "ambulance: bath",
            "failure: CallNurse (fall): CallNurse was not done within 1 second of the trigger of rule fall",
            "refused: Vacuum",
            "walk",
        ]


def test_a_kill_in_the_middle_of_code_leaves_it_under_way(path: Path) -> None:
    with running(path, "lift") as process:
        assert lines(process, 1) == ["lifting"]
    (one,) = json.loads(path.read_text(encoding="utf-8"))["pending"]
    assert (one["obligation"], one["state"]) == ("LiftPatient", "under way")
    with running(path, "restore") as process:
        found = lines(process, 1)
        while "lower" not in found:
            found += lines(process, 1)
        assert "lifting" not in found


def test_a_kill_in_the_middle_of_saving_leaves_a_whole_snapshot(path: Path) -> None:
    for _ in range(3):
        with running(path, "save") as process:
            assert lines(process, 1) == ["saving"]
            time.sleep(0.05)
        with running(path, "restore") as process:
            assert lines(process, 1) == ["refused: Vacuum"]
