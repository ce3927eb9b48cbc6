"""`check --watch`: once more after each change, in a process of its own, until Ctrl-C."""

from __future__ import annotations

import os
import pty
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.support.cli import Cli

CLEAN = "WHEN Rung THEN Open\n"
CLASH = CLEAN + "WHEN Storm THEN NOT Open\n"
PATIENCE = 30.0


class Watched:
    """A watching process and what it has written so far."""

    def __init__(self, folder: Path, *arguments: str) -> None:
        self.folder = folder
        self._out = folder.parent / "out"
        self._err = folder.parent / "err"
        with self._out.open("wb") as out, self._err.open("wb") as err:
            line = [sys.executable, "-m", "sleec_verify", "check", "--watch", "--format", "concise", *arguments]
            self.process = subprocess.Popen(line, cwd=folder, stdout=out, stderr=err)

    def write(self, name: str, text: str) -> None:
        (self.folder / name).write_text(text)

    @property
    def out(self) -> str:
        return self._out.read_text()

    @property
    def err(self) -> str:
        return self._err.read_text()

    def until(self, holds: Callable[[], bool]) -> None:
        ends = time.monotonic() + PATIENCE
        while not holds():
            assert time.monotonic() < ends, f"waited in vain\n{self.out}\n{self.err}"
            assert self.process.poll() is None, f"ended\n{self.out}\n{self.err}"
            time.sleep(0.02)

    def rounds(self, number: int) -> None:
        self.until(lambda: self.err.count("waiting for changes") == number)


@pytest.fixture(autouse=True)
def interruptible() -> Iterator[None]:
    """What a shell starts in the background ignores Ctrl-C, and so would all that the tests start."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def watched(tmp_path: Path) -> Iterator[Callable[..., Watched]]:
    folder = tmp_path / "rules"
    folder.mkdir()
    started: list[Watched] = []

    def start(*arguments: str, **files: str) -> Watched:
        for name, text in files.items():
            (folder / f"{name}.sleec").write_text(text)
        started.append(Watched(folder, *arguments))
        return started[-1]

    yield start
    for one in started:
        one.process.kill()
        one.process.wait()


def test_each_change_is_checked_and_ctrl_c_ends_it(watched: Callable[..., Watched]) -> None:
    one = watched(".", a=CLEAN)
    one.rounds(1)
    assert one.out.endswith("1 ruleset: no errors, no warnings, no notes (reading cascade)\n")
    one.write("a.sleec", CLASH)
    one.rounds(2)
    assert "./a.sleec:1:1: error[SLEEC101]" in one.out
    one.write("b.sleec", CLEAN)
    one.rounds(3)
    assert "2 rulesets: 1 error" in one.out
    (one.folder / "a.sleec").unlink()
    one.rounds(4)
    assert one.out.endswith("1 ruleset: no errors, no warnings, no notes (reading cascade)\n")
    one.process.send_signal(signal.SIGINT)
    assert one.process.wait(PATIENCE) == 0
    assert "Traceback" not in one.err
    assert "\033" not in one.out


def test_what_cannot_be_read_is_told_and_waited_for(watched: Callable[..., Watched]) -> None:
    one = watched("a.sleec", a="WHEN")
    one.rounds(1)
    assert "a.sleec:1:5: error" in one.err
    (one.folder / "a.sleec").unlink()
    one.rounds(2)
    assert "file a.sleec does not exist" in one.err or "a.sleec cannot be read" in one.err or "no such file" in one.err
    one.write("a.sleec", CLEAN)
    one.rounds(3)
    assert one.out.endswith("1 ruleset: no errors, no warnings, no notes (reading cascade)\n")


def test_a_domain_that_comes_later(watched: Callable[..., Watched]) -> None:
    one = watched("a.sleec", "--domain", "home", a="DOMAIN hospital\n" + CLEAN)
    one.rounds(1)
    assert "no domain is called `home`" in one.err
    one.write("a.sleec", "DOMAIN home\n" + CLEAN)
    one.rounds(2)
    assert "1 ruleset: no errors" in one.out


def test_nothing_is_checked_without_a_change(watched: Callable[..., Watched]) -> None:
    one = watched(".", a=CLEAN)
    one.rounds(1)
    time.sleep(1.0)
    assert one.err.count("waiting for changes") == 1


def test_a_terminal_is_cleared(tmp_path: Path) -> None:
    (tmp_path / "a.sleec").write_text(CLEAN)
    leader, follower = pty.openpty()
    line = [sys.executable, "-m", "sleec_verify", "check", "--watch", "a.sleec"]
    process = subprocess.Popen(line, cwd=tmp_path, stdin=follower, stdout=follower, stderr=follower)
    os.close(follower)
    try:
        shown = b""
        while b"waiting for changes" not in shown:
            shown += os.read(leader, 4096)
        assert shown.startswith(b"\033[2J\033[3J\033[H")
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
    finally:
        process.kill()
        process.wait()
        os.close(leader)


def test_in_one_process(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same without waiting: each look finds what the list says, and then comes Ctrl-C."""
    texts: list[str | None] = [CLEAN, CLASH, None, "DOMAIN hospital\n" + CLEAN]
    looks: list[float] = []

    def look(pause: float) -> None:
        looks.append(pause)
        if len(looks) > len(texts):
            raise KeyboardInterrupt
        text = texts[len(looks) - 1]
        path = tmp_path / "a.sleec"
        if text is None:
            path.unlink()
        else:
            path.write_text(text)

    monkeypatch.setattr("time.sleep", look)
    ran = cli("check", "--watch", "a.sleec", "--domain", "home", "--format", "concise", files={"a.sleec": CLEAN + "\n"})
    assert ran.code == 0
    assert ran.err.count("waiting for changes") == len(texts) + 1
    assert ran.out.count("1 ruleset: ") == len(texts), "of an unknown domain, an error tells"
    assert "no domain is called `home`" in ran.err
    assert "error[SLEEC101]" in ran.out


def test_standard_input_cannot_be_watched(cli: Cli) -> None:
    ran = cli("check", "--watch", "-")
    assert ran.code == 2
    assert "standard input cannot be watched" in ran.err
