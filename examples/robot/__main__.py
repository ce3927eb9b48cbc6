"""The robot: its processes, its mission, and the audit of what was recorded.

    python -m examples.robot [LOG]

The record is written to LOG, or to a new temporary folder. The exit code is 1 if the robot deviates from the rules, or
if one of its processes fails.
"""

# ruff: noqa: T201 - a program for the console

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
from contextlib import ExitStack
from pathlib import Path

MAPPING = Path(__file__).parent / "mapping.toml"

PATIENCE = 60.0
"""Seconds for a process to start or to end."""

PROCESSES = (
    ("context_manager",),
    ("tasks", "Safety"),
    ("tasks", "Triage"),
    ("tasks", "Dressing"),
)


def environment() -> dict[str, str]:
    """The environment of the processes: only this computer, unless CYCLONEDDS_URI says otherwise, and a DDS domain of
    their own, unless ROS_DOMAIN_ID does."""
    from sleec_runtime.ros.dds.environment import LOOPBACK

    own = {"CYCLONEDDS_URI": LOOPBACK, "ROS_DOMAIN_ID": str(1 + os.getpid() % 99)}
    return {**own, **os.environ, "PYTHONUNBUFFERED": "1"}


class Process:
    """A process of the robot. It runs until its input ends. Ctrl-C does not reach it: this program ends it."""

    def __init__(self, name: str, *arguments: str) -> None:
        self._name = " ".join((name, *arguments))
        self._process = subprocess.Popen(
            [sys.executable, "-m", f"{__package__}.{name}", *arguments],
            env=environment(),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def await_start(self) -> None:
        """Waits until its node is ready."""
        assert self._process.stdout is not None
        watchdog = threading.Timer(PATIENCE, self._process.kill)
        watchdog.daemon = True
        watchdog.start()
        line = self._process.stdout.readline()
        watchdog.cancel()
        if line != "ready\n":
            sys.exit(f"the process `{self._name}` did not start")

    def end(self) -> None:
        """Ends the process."""
        try:
            self._process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
        if self._process.returncode:
            sys.exit(f"the process `{self._name}` failed")


def main() -> int:
    # As Ctrl-C: also a process manager must not leave processes behind.
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    from .rules import RULES

    log = sys.argv[1] if len(sys.argv) > 1 else str(Path(tempfile.mkdtemp(prefix="sleec-robot-")) / "mission.jsonl")
    with ExitStack() as ends:
        processes = [Process("recorder", log), *(Process(*arguments) for arguments in PROCESSES)]
        for process in processes:
            ends.callback(process.end)
        for process in processes:
            process.await_start()
        print(f"{len(processes)} processes run over DDS in domain {environment()['ROS_DOMAIN_ID']}.", flush=True)
        mission = subprocess.run(
            [sys.executable, "-m", f"{__package__}.mission"], env=environment(), check=False, start_new_session=True
        )
    print(f"The record is {log}.\n", flush=True)
    audited = subprocess.run(
        [sys.executable, "-m", "sleec_verify", "audit", log, "--ruleset", str(RULES), "--mapping", str(MAPPING)],
        check=False,
    )
    return 1 if mission.returncode or audited.returncode else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
