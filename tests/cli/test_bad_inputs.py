"""Inputs that are no rules at all: a message and exit code 2, in every command that reads rules, never a traceback."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from sleec_verify.cli import run

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
)


@pytest.mark.parametrize("name", INPUTS)
def test_no_ruleset_is_exit_2_with_a_message(name: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "input.sleec"
    path.write_bytes(INPUTS[name])
    for command in COMMANDS:
        assert run([command[0], str(path), *command[1:]]) == 2, command
        out, err = capfd.readouterr()
        assert "error: " in err
        assert "mistake in sleec-verify" not in err
        assert len(err) < 100_000
        if "json" in command:
            assert json.loads(out)["rulesets"][0]["error"]["message"]
    assert path.read_bytes() == INPUTS[name]


def test_file_name_that_cannot_be(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "x" * 300]) == 2
    assert capfd.readouterr().err == f"error: {'x' * 300} cannot be read: File name too long\n"


@pytest.mark.parametrize("depth", [200, 5000])
def test_deep_nesting_is_read_or_refused(depth: int, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "deep.sleec"
    path.write_text(f"WHEN a THEN b UNLESS {'(' * depth}c{')' * depth} IN WHICH CASE d\n")
    for command in COMMANDS:
        assert run([command[0], str(path), *command[1:]]) in (0, 2), command
        assert "mistake in sleec-verify" not in capfd.readouterr().err
