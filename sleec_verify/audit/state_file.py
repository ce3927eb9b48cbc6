"""The file with the positions of an audit, from which a later run continues."""

from __future__ import annotations

import hashlib
import json
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from sleec_runtime.errors import SnapshotRefused
from sleec_runtime.support.files import read_file
from sleec_verify.audit.mission import Mission
from sleec_verify.audit.settings import Settings
from sleec_verify.files.placement import write_whole

FORMAT = 1
"""The version of the format. Other versions are rejected."""

PERIOD = 30.0
"""Seconds after which the state is saved while a log is read."""


class StateFile:
    """The states of missions, by log, in the file at `path`. A missing file is an audit that begins."""

    def __init__(self, path: str, settings: Settings) -> None:
        self.path = path
        self._settings = _digest(repr(settings))
        self._logs: dict[str, Any] = {}
        self._saved = time.monotonic()
        self._interrupted = False
        try:
            state = json.loads(read_file(path))
        except FileNotFoundError:
            return
        except OSError as error:
            raise SnapshotRefused(f"{path} cannot be read: {error.strerror}") from None
        except (ValueError, RecursionError):
            raise SnapshotRefused(f"{path} is not the state of an audit", "name another file") from None
        if not isinstance(state, dict) or state.get("format") != FORMAT or not isinstance(state.get("logs"), dict):
            raise SnapshotRefused(f"{path} is not the state of an audit of this version", "name another file")
        if state.get("settings") != self._settings:
            raise SnapshotRefused(
                f"{path} is the state of an audit with another mapping or other options",
                "use the same mapping and options, or name another file",
            )
        if state.get("sha256") != _digest(json.dumps(state["logs"])):
            raise SnapshotRefused(f"{path} is damaged", "delete it, and audit the logs from their start")
        self._logs = state["logs"]

    def resume(self, mission: Mission) -> None:
        """Continues a mission where it was saved. Raises SnapshotRefused."""
        if mission.path in self._logs:
            mission.resume(self._logs[mission.path])

    def save(self, mission: Mission) -> None:
        """Saves the state of a mission. Raises UnreadableFile if the file cannot be written."""
        self._logs[mission.path] = mission.state()
        self._saved = time.monotonic()
        digest = _digest(json.dumps(self._logs))
        state = {"format": FORMAT, "settings": self._settings, "sha256": digest, "logs": self._logs}
        write_whole(self.path, json.dumps(state).encode())

    def pause(self, mission: Mission) -> None:
        """Saves the state of a mission, if this was not done recently. Raises KeyboardInterrupt after Ctrl-C."""
        if self._interrupted or time.monotonic() - self._saved >= PERIOD:
            self.save(mission)
        if self._interrupted:
            raise KeyboardInterrupt

    @contextmanager
    def interrupts_deferred(self) -> Iterator[None]:
        """Within the block, Ctrl-C takes effect at the next `pause`, so that the saved state is consistent."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = signal.signal(signal.SIGINT, self._interrupt)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        self._interrupted = True


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
