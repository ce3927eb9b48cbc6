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

from tests.support.paths import ROOT

PROGRAM = '''
import json, os, sys, time
from pathlib import Path
from sleec_runtime import Sleec, obligation
from sleec_runtime.errors import Prohibited
from sleec_runtime.language import parse

RULES = """
RULE fall WHEN Fall THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 5 minutes
RULE rest WHEN Sleep THEN NOT Vacuum WITHIN 1 hour
RULE dust WHEN Dust THEN Vacuum
RULE soon WHEN Morning THEN OfferWalk WITHIN 5 TO 60 minutes
RULE later WHEN Morning THEN OfferTea WITHIN 30 TO 60 minutes
RULE lift WHEN Lift THEN LiftPatient WITHIN 5 minutes OTHERWISE LowerPatient
"""
path, what = Path(sys.argv[1]), sys.argv[2]

def say(*words):
    # At once, because several threads say something.
    os.write(1, (" ".join(map(str, words)) + "\\n").encode())

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
    snapshot = json.loads(path.read_text())
    assert abs(snapshot["saved_at"] - time.time()) < 600
    for pending in sleec.restore(snapshot, now=snapshot["saved_at"] + int(sys.argv[3])):
        say(pending.obligation, pending.state)
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


MISSED = "failure: CallNurse (fall): `CallNurse` was not done within 300 seconds of the trigger of rule `fall`"


@contextmanager
def running(path: Path, what: str, down: int = 0) -> Iterator[subprocess.Popen[str]]:
    """A process, which is killed at the end of the block. It takes the last one to be over for `down` seconds."""
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(path), what, str(down)],
        cwd=ROOT,
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


def until(process: subprocess.Popen[str], *words: str) -> list[str]:
    """The lines up to that at which all of `words` have come; what the clock starts comes when it will."""
    found: list[str] = []
    while not set(words) <= set(found):
        found += lines(process, 1)
        assert found[-1], "the process has ended"
    return found


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "pending.json"


def test_what_is_pending_survives_a_kill(path: Path) -> None:
    with running(path, "trigger") as process:
        assert lines(process, 2) == ["nurse: bath", "saved"]
    with running(path, "restore", down=10) as process:
        assert lines(process, 5) == [
            "CallNurse under way",
            "OfferWalk waiting",
            "OfferTea waiting",
            "Vacuum in force",
            "refused: Vacuum",
        ]
    with running(path, "restore", down=301) as process:
        found = until(process, "refused: Vacuum", "ambulance: bath", "walk", MISSED)
        assert "OfferTea waiting" in found
        assert "nurse: bath" not in found
        assert "tea" not in found


def test_a_kill_in_the_middle_of_code_leaves_it_under_way(path: Path) -> None:
    with running(path, "lift") as process:
        assert lines(process, 1) == ["lifting"]
    (one,) = json.loads(path.read_text(encoding="utf-8"))["pending"]
    assert (one["obligation"], one["state"]) == ("LiftPatient", "under way")
    with running(path, "restore", down=10) as process:
        assert lines(process, 2) == ["LiftPatient under way", "vacuum"]
    with running(path, "restore", down=301) as process:
        assert "lifting" not in until(process, "lower", "vacuum")


def test_a_kill_in_the_middle_of_saving_leaves_a_whole_snapshot(path: Path) -> None:
    for _ in range(3):
        with running(path, "save") as process:
            assert lines(process, 1) == ["saving"]
            time.sleep(0.05)
        with running(path, "restore") as process:
            assert "Vacuum in force" in until(process, "refused: Vacuum")
