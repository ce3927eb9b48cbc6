"""A Dask cluster of this machine: a scheduler and workers, each a process of its own."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from types import TracebackType

_PATIENCE = 60.0
"""Seconds, for a loaded machine."""


class Cluster:
    """A running scheduler. `folder` is for its files. Packages in it are those of the workers."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.workers: list[subprocess.Popen[bytes]] = []
        file = folder / "scheduler.json"
        options = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show", "--scheduler-file", str(file))
        self.scheduler = self._start("dask_scheduler", options)
        self.address = ""
        begin = time.monotonic()
        while not self.address:
            assert self.scheduler.poll() is None, "the scheduler has ended"
            assert time.monotonic() - begin < _PATIENCE, "the scheduler has not started"
            time.sleep(0.05)
            with suppress(FileNotFoundError, ValueError):
                self.address = json.loads(file.read_text())["address"]

    def add_worker(self) -> subprocess.Popen[bytes]:
        """Starts a worker."""
        options = ("--nworkers", "1", "--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1")
        folder = ("--local-directory", str(self.folder))
        worker = self._start("dask_worker", (self.address, *options, *folder))
        self.workers.append(worker)
        return worker

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()

    def _start(self, program: str, options: tuple[str, ...]) -> subprocess.Popen[bytes]:
        command = (sys.executable, "-m", f"distributed.cli.{program}", *options)
        silent = subprocess.DEVNULL
        return subprocess.Popen(command, stdout=silent, stderr=silent, cwd=self.folder)
