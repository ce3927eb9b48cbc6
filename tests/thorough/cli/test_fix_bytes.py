"""`check --fix` changes nothing but what its repair says, byte for byte."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import Cli
from tests.support.fixes import SHORTER, TWO, identifiers


def test_every_listed_repair_can_be_applied(cli: Cli, tmp_path: Path) -> None:
    listed = cli("check", "--fixes", "--format", "concise", "a.sleec", files={"a.sleec": TWO}).out.count("SLEEC101:")
    for number in range(1, listed + 1):
        ran = cli("check", "--fix", f"sleec101:{number}", "a.sleec", files={"a.sleec": TWO})
        assert ran.out.count("error[SLEEC101]") == 1
        assert (tmp_path / "a.sleec").read_text() != TWO


BYTES = {
    "byte order mark": "\ufeff" + TWO,
    "Windows line breaks": TWO.replace("\n", "\r\n"),
    "old Mac line breaks": TWO.replace("\n", "\r"),
    "mixed line breaks": TWO.replace("because\n", "because\r\n").replace("Window\n", "Window\r"),
    "no line break at the end": TWO.rstrip(),
    "other letters": TWO.replace("because", "weil es so schön ist 🌅"),
    "all": "\ufeff" + TWO.replace("because", "schön 🌅").replace("\n", "\r\n").rstrip(),
}


@pytest.mark.parametrize("kind", BYTES)
def test_all_other_bytes_stay(kind: str, cli: Cli, tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    before = BYTES[kind]
    path.write_bytes(before.encode())
    (name,) = identifiers(cli, SHORTER, TWO)
    path.write_bytes(before.encode())
    assert cli("check", "--fix", name, "a.sleec").code == 1
    assert path.read_bytes() == before.replace("OpenCurtains AND OpenWindow", "OpenWindow").encode()


@pytest.mark.parametrize(
    ("kind", "line_break"), [("Windows line breaks", "\r\n"), ("old Mac line breaks", "\r"), ("byte order mark", "\n")]
)
def test_new_lines_end_as_the_others(kind: str, line_break: str, cli: Cli, tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    (name,) = identifiers(cli, "add to rule `air`: `UNLESS UserUndressed IN WHICH CASE OpenWindow`", TWO)
    path.write_bytes(BYTES[kind].encode())
    cli("check", "--fix", name, "a.sleec")
    added = f"AND OpenWindow{line_break}UNLESS UserUndressed IN WHICH CASE OpenWindow{line_break}"
    assert path.read_bytes().decode() == BYTES[kind].replace(f"AND OpenWindow{line_break}", added)
