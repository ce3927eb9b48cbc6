"""Ctrl-C at any moment leaves the old content or the new one, and no temporary file beside it."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

import sleec_verify
from sleec_runtime.language import load
from sleec_verify.certificates import checker
from sleec_verify.certificates.directory import write_folder
from sleec_verify.cli.cache.store import Cache
from sleec_verify.encoding.scope import Scope
from sleec_verify.files.placement import write_new, write_whole
from sleec_verify.files.temporary import put_in_place
from sleec_verify.results.finding import CheckResult, Proved

OURS = os.path.dirname(sleec_verify.__file__)
LIBRARY = os.path.dirname(os.__file__)


class Moments:
    """Sends Ctrl-C before the operation with this number, among those of the code in these folders."""

    def __init__(self, code: tuple[str, ...], moment: int) -> None:
        self.code = code
        self.left = moment

    def __call__(self, frame: FrameType, event: str, argument: object) -> Any:
        if not frame.f_code.co_filename.startswith(self.code):
            return None
        frame.f_trace_opcodes = True
        if event == "opcode":
            self.left -= 1
            if self.left == 0:
                signal.raise_signal(signal.SIGINT)
        return self


def interrupted(work: Callable[[], object], code: tuple[str, ...], moment: int) -> bool:
    """Whether `work` has so many operations; it is interrupted before that one."""
    moments = Moments(code, moment)
    before = sys.gettrace()
    # A shell lets what runs in the background ignore Ctrl-C.
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.settrace(moments)
    try:
        work()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
        signal.signal(signal.SIGINT, handler)
    return False


def _file(folder: Path) -> None:
    write_whole(str(folder / "file"), b"new")


def _new_file(folder: Path) -> None:
    write_new(str(folder / "other"), b"new")


def _entry(folder: Path) -> None:
    (folder / "rules.sleec").write_text("WHEN A THEN B\n", encoding="utf-8")
    cache = Cache(str(folder / "cache"), lambda _: None)
    cache.keep(load(folder / "rules.sleec"), Scope(), (CheckResult("conflict", Proved(), 0.0),))


def _certificate(folder: Path) -> None:
    write_folder(str(folder / "certificate"), [("manifest.json", b"new")], force=True)


def _by_checker(folder: Path) -> None:
    checker.judge_by_program("/bin/true", b"p cnf 0 0\n", b"")


WRITERS = {one.__name__: one for one in (_file, _new_file, _entry, _certificate, _by_checker)}


# A file that is interrupted while it is opened is closed by the garbage collector, with a warning.
@pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize(("code", "step"), [((OURS,), 1), ((OURS, LIBRARY), 29)], ids=["ours", "library"])
@pytest.mark.parametrize("writer", WRITERS)
def test_an_interruption_at_any_moment_leaves_nothing_behind(
    writer: str, code: tuple[str, ...], step: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = subprocess.CompletedProcess((), 0, "VERIFIED\n", "")
    monkeypatch.setattr("subprocess.run", lambda *_, **__: done)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr("sleec_verify.certificates.directory.check_free", lambda *_: None)
    monkeypatch.setattr("sleec_verify.cli.cache.store.program_identity", lambda: "")
    write = WRITERS[writer]
    write(tmp_path)  # what is imported on the way is imported now
    moment = 0
    going_on = True
    while going_on:
        moment += step
        (tmp_path / "other").unlink(missing_ok=True)
        (tmp_path / "file").write_bytes(b"old")
        (tmp_path / "certificate").mkdir(exist_ok=True)
        (tmp_path / "certificate" / "manifest.json").write_bytes(b"old")
        going_on = interrupted(lambda: write(tmp_path), code, moment)
        left = [path for path in tmp_path.rglob("*") if path.name.startswith(".sleec-") or path.suffix == ".tmp"]
        assert left == [], moment
        assert (tmp_path / "file").read_bytes() in (b"old", b"new")
        assert (tmp_path / "certificate" / "manifest.json").read_bytes() in (b"old", b"new")
        assert not (tmp_path / "other").exists() or (tmp_path / "other").read_bytes() == b"new"
    assert moment > 20
    gc.collect()  # here, where its warnings are expected


def test_a_new_file_on_a_file_system_without_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr("os.link", refuse)
    put_in_place(str(tmp_path / "file"), b"first", new=True)
    with pytest.raises(PermissionError):
        put_in_place(str(tmp_path / "file"), b"second", new=True)
    assert [path.read_bytes() for path in tmp_path.iterdir()] == [b"first"]
