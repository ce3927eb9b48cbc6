"""Inputs that are no rules at all: a message and exit code 2, in every command that reads rules, never a traceback."""

from __future__ import annotations

import builtins
import errno
import json
import os
from pathlib import Path
from typing import Any

import pytest

from sleec_verify.cli import run
from sleec_verify.report import FORMATS

INPUTS: dict[str, bytes] = {
    "empty": b"",
    "blank": b"\n\n  \n",
    "only comments": b"# nothing\n// to do\n",
    "not utf-8": b"WHEN a THEN b\n\xff\xfe",
    "utf-16": "WHEN a THEN b".encode("utf-16"),
    "nul": b"WHEN a\0 THEN b\n",
    "binary": bytes(range(256)) * 10,
    "open parentheses": b"WHEN a THEN b UNLESS " + b"(" * 5000,
    "closed parentheses": b"WHEN a THEN b UNLESS c" + b")" * 5000 + b" IN WHICH CASE d",
    "long line": b"WHEN a THEN b UNLES " + b"x" * 10_000_000,
    "many words": b"x " * 200_000,
    "no rule": b"EXCLUSIVE a, b\n",
    "dsl": b"def_start\nevent A\ndef_end\nrule_start\nrule_end\n",
}

COMMANDS = (
    ["check"],
    ["check", "--format", "json"],
    ["check", "--format", "concise"],
    ["entail", "--when", "a"],
    ["explain", "--when", "a"],
    ["compile", "--to", "cnf"],
    ["fmt"],
    ["fmt", "--write"],
    ["certify", "-o", "never"],
    ["check", "--certify", "never"],
    ["fmt", "--check"],
    ["fmt", "--diff"],
    *(["check", "--format", form] for form in FORMATS[3:]),
)


@pytest.mark.parametrize("name", INPUTS)
def test_no_ruleset_is_exit_2_with_a_message(name: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "input.sleec"
    path.write_bytes(INPUTS[name])
    for command in COMMANDS:
        assert run([command[0], str(path), *command[1:]]) == 2, command
        out, err = capfd.readouterr()
        assert "error: " in err
        assert "fault in sleec-verify" not in err
        assert len(err) < 100_000
        if "json" in command:
            assert json.loads(out)["rulesets"][0]["error"]["message"]
    assert path.read_bytes() == INPUTS[name]


def test_file_name_that_cannot_be(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "x" * 300]) == 2
    assert capfd.readouterr().err == f"error: {'x' * 300} cannot be read: File name too long\n"


@pytest.fixture
def locked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file that may not be read, for root as well."""
    path = tmp_path / "locked.sleec"
    path.write_text("WHEN a THEN b\n")
    sound = builtins.open

    def refuse(file: object, *arguments: Any, **options: Any) -> Any:
        if str(file) == str(path):
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return sound(file, *arguments, **options)  # type: ignore[call-overload]

    monkeypatch.setattr("builtins.open", refuse)
    monkeypatch.setattr("os.access", lambda file, mode, **_: str(file) != str(path))
    return path


@pytest.mark.parametrize("command", [*COMMANDS, ["cases"]], ids=" ".join)
def test_file_that_may_not_be_read(command: list[str], locked: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run([command[0], str(locked), *command[1:]]) == 2
    assert f"error: no permission to read {locked}\n" in capfd.readouterr().err


@pytest.mark.parametrize("forbidden", ["target", "ruleset"])
def test_conform_of_what_may_not_be_read(
    forbidden: str, locked: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    sound = tmp_path / "sound.sleec"
    sound.write_text("WHEN a THEN b\n")
    target, ruleset = (locked, sound) if forbidden == "target" else (sound, locked)
    assert run(["conform", str(target), "--ruleset", str(ruleset)]) == 2
    said = capfd.readouterr().err
    assert str(locked) in said
    assert "Usage" not in said
    assert "fault in sleec-verify" not in said


def test_file_that_may_not_be_read_among_others(
    locked: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    sound = tmp_path / "sound.sleec"
    sound.write_text("WHEN a THEN b\n")
    assert run(["check", str(locked), str(sound), "--format", "json"]) == 2
    first, second = json.loads(capfd.readouterr().out)["rulesets"]
    assert first["error"]["message"] == f"no permission to read {locked}"
    assert second["rules"] == 1


def test_folder_that_may_not_be_read(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "sound.sleec").write_text("WHEN a THEN b\n")
    (tmp_path / "locked").mkdir()
    sound = os.scandir

    def refuse(folder: str) -> Any:
        if folder.endswith("locked"):
            raise PermissionError(errno.EACCES, "Permission denied", folder)
        return sound(folder)

    monkeypatch.setattr("os.scandir", refuse)
    assert run(["check", str(tmp_path), "--format", "concise"]) == 2
    out, err = capfd.readouterr()
    refused = f"the folder {tmp_path / 'locked'} cannot be read: Permission denied\n"
    assert f"error: {refused}" in err
    assert out == (
        f"{tmp_path / 'locked'}: unusable: {refused}"
        "2 rulesets: no errors, no warnings, no notes, 1 unusable (reading cascade)\n"
    )


@pytest.mark.parametrize("arguments", [["rules"], ["check", "a.sleec", "--domain"], []])
def test_what_was_typed_is_cut_in_messages(
    arguments: list[str], tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.sleec").write_text("DOMAIN home\nWHEN a THEN b\n")
    assert run([*arguments, "x" * 20_000]) == 2
    said = capfd.readouterr().err
    assert "x" * 37 + "..." in said
    assert len(said) < 500


@pytest.mark.parametrize("depth", [200, 5000])
def test_deep_nesting_is_read_or_refused(depth: int, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "deep.sleec"
    path.write_text(f"WHEN a THEN b UNLESS {'(' * depth}c{')' * depth} IN WHICH CASE d\n")
    for command in COMMANDS:
        assert run([command[0], str(path), *command[1:]]) in (0, 2), command
        assert "fault in sleec-verify" not in capfd.readouterr().err
