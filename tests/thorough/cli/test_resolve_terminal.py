"""`resolve` and the hints of `check` in a terminal, each in a process of its own."""

from __future__ import annotations

import os
import pty
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest

ONE = "RULE a\nWHEN Bell THEN Speak\nRULE b\nWHEN Bell AND Late THEN NOT Speak\n"
TWO = f"{ONE}RULE c\nWHEN Fall THEN Wait\nRULE d\nWHEN Fall AND Late THEN NOT Wait\n"
PATIENCE = 60.0


class Terminal:
    """The process, and what its terminal shows."""

    def __init__(self, folder: Path, *arguments: str) -> None:
        self._master, slave = pty.openpty()
        line = [sys.executable, "-m", "sleec_verify", *arguments, "a.sleec"]
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

    def interrupt(self) -> int:
        """Presses Ctrl-C until the process ends, and returns its exit code. Python does not notice a signal between the
        output of a prompt and the wait for an answer; a person presses Ctrl-C again."""
        ends = time.monotonic() + PATIENCE
        while time.monotonic() < ends:
            self.process.send_signal(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                return self.process.wait(PATIENCE / 6)
        raise AssertionError(f"Ctrl-C did not end the process\n{self.shown}")

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self._master)


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[Callable[..., Terminal]]:
    """Runs a command on a file with two conflicts."""
    (tmp_path / "a.sleec").write_text(TWO)
    # What a shell starts in the background ignores Ctrl-C, and so would all that the tests start.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    opened: list[Terminal] = []

    def run(*arguments: str) -> Terminal:
        opened.append(Terminal(tmp_path, *arguments))
        return opened[-1]

    yield run
    for one in opened:
        one.close()
    signal.signal(signal.SIGINT, before)


def test_check_says_how_to_go_on(terminal: Callable[..., Terminal]) -> None:
    resolving = "to list repairs, add --fixes; to resolve the conflicts one by one, run sleec-verify resolve"
    terminal("check").until(resolving)
    terminal("check", "--fixes").until("to apply a repair, add --fix and its identifier, for example --fix SLEEC101:1")


def test_ctrl_c_keeps_the_file_as_it_was_after_the_last_choice(
    terminal: Callable[..., Terminal], tmp_path: Path
) -> None:
    person = terminal("resolve")
    person.until("Choose: ")
    assert "\x1b[1;31merror[SLEEC101]" in person.shown
    assert (tmp_path / "a.sleec").read_text() == TWO
    person.type("1\n")
    person.until("Why? ")
    person.type("Schlaf geht vor\n")
    person.until("Choose: ", 2)
    after = (tmp_path / "a.sleec").read_text()
    assert after != TWO
    assert ": Schlaf geht vor\n" in after
    person.type("1\n")
    person.until("Why? ", 2)
    assert person.interrupt() == 130
    assert (tmp_path / "a.sleec").read_text() == after
    assert os.listdir(tmp_path) == ["a.sleec"]
