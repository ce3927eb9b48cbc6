"""`resolve` in a terminal, in a process of its own, until Ctrl-C."""

from __future__ import annotations

import os
import pty
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

ONE = "RULE a\nWHEN Bell THEN Speak\nRULE b\nWHEN Bell AND Late THEN NOT Speak\n"
TWO = f"{ONE}RULE c\nWHEN Fall THEN Wait\nRULE d\nWHEN Fall AND Late THEN NOT Wait\n"
PATIENCE = 60.0


class Terminal:
    """The process, and what its terminal shows."""

    def __init__(self, folder: Path) -> None:
        self._master, slave = pty.openpty()
        line = [sys.executable, "-m", "sleec_verify", "resolve", "a.sleec"]
        environment = {**os.environ, "TERM": "xterm"}
        environment.pop("NO_COLOR", None)
        self.process = subprocess.Popen(
            line, cwd=folder, stdin=slave, stdout=slave, stderr=slave, env=environment, start_new_session=True
        )
        os.close(slave)
        os.set_blocking(self._master, False)
        self.shown = ""

    def until(self, text: str, times: int = 1) -> None:
        ends = time.monotonic() + PATIENCE
        while self.shown.count(text) < times:
            assert time.monotonic() < ends, f"waited in vain for {text!r}\n{self.shown}"
            try:
                self.shown += os.read(self._master, 65536).decode()
            except BlockingIOError:
                time.sleep(0.02)

    def type(self, text: str) -> None:
        os.write(self._master, text.encode())

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self._master)


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[Terminal]:
    (tmp_path / "a.sleec").write_text(TWO)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    opened = Terminal(tmp_path)
    yield opened
    opened.close()
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_keeps_the_file_as_it_was_after_the_last_choice(terminal: Terminal, tmp_path: Path) -> None:
    terminal.until("Choose: ")
    assert "\x1b[1;31merror[SLEEC101]" in terminal.shown
    assert (tmp_path / "a.sleec").read_text() == TWO
    terminal.type("1\n")
    terminal.until("Why? ")
    terminal.type("Schlaf geht vor\n")
    terminal.until("Choose: ", 2)
    after = (tmp_path / "a.sleec").read_text()
    assert after != TWO
    assert ": Schlaf geht vor\n" in after
    terminal.type("1\n")
    terminal.until("Why? ", 2)
    terminal.process.send_signal(signal.SIGINT)
    assert terminal.process.wait(PATIENCE) == 130
    assert (tmp_path / "a.sleec").read_text() == after
    assert os.listdir(tmp_path) == ["a.sleec"]
