"""The file from which a Context Manager continues after a restart."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.errors import SleecError, SnapshotRefused
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.transport_errors import MalformedMessage
from sleec_runtime.support.files import DEFAULT_MAX_SIZE, read_file


@dataclass(frozen=True, kw_only=True)
class Checkpoint(Message):
    """The last full `LayersUpdate`, the `Start` of each obligation that is under way, and `Sleec.pending_snapshot`."""

    max_size = DEFAULT_MAX_SIZE
    update: str
    starts: tuple[str, ...]
    pending: Mapping[str, Any]


class CheckpointFile:
    """A file that is replaced as a whole: it holds the last checkpoint or the one before, never half of one."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self._section = CriticalSection()

    def read(self) -> Checkpoint | None:
        """The checkpoint; None if the file does not exist. Raises SnapshotRefused if it is not a checkpoint."""
        try:
            return Checkpoint.from_json(read_file(self.path).decode())
        except FileNotFoundError:
            return None
        except (OSError, ValueError, MalformedMessage) as error:
            # The hint of a malformed message is for its sender.
            reason = error.message if isinstance(error, MalformedMessage) else getattr(error, "strerror", None) or error
            raise SnapshotRefused(
                f"the checkpoint {self.path} cannot be read: {reason}", "move the file away to start without it"
            ) from None

    def write(self, take: Callable[[], Checkpoint]) -> None:
        """Takes a checkpoint and writes it. Raises SleecError if that is not possible; the file stays as it was."""
        self._section.run(self._write, take)

    def _write(self, take: Callable[[], Checkpoint]) -> None:
        new = self.path.with_name(self.path.name + ".new")
        text = take().to_json()
        try:
            with new.open("w", encoding="utf-8") as file:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
            new.replace(self.path)
        except OSError as error:
            raise SleecError(
                f"the checkpoint {self.path} cannot be written: {error.strerror}",
                "free space or grant access; until then, a restart continues from an older state",
            ) from None
