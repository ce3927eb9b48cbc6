"""`--timeout`: what is undecided by then is unknown, the rest is reported, and the exit code is 3."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import Cli

EASY = "RULE easy\nWHEN T THEN A\nRULE other\nWHEN T THEN NOT A\n"


def pigeonhole(holes: int) -> str:
    """Assumptions that are contradictory, and that no solver refutes soon."""
    lines = [f"ASSUME {' OR '.join(f'x{p}_{h}' for h in range(holes))}" for p in range(holes + 1)]
    for h in range(holes):
        lines += [f"ASSUME NOT (x{a}_{h} AND x{b}_{h})" for a in range(holes + 1) for b in range(a)]
    return "\n".join(lines) + "\n"


@pytest.fixture
def hard(tmp_path: Path) -> Path:
    path = tmp_path / "hard.sleec"
    path.write_text(pigeonhole(12) + EASY)
    return path


def test_check_reports_unknown(cli: Cli, hard: Path) -> None:
    done = cli("check", str(hard), "--timeout", "0.3", "--format", "json", "--no-cache")
    assert done.code == 3
    checks = json.loads(done.out)["rulesets"][0]["checks"]
    unknown = [check for check in checks if check["verdict"] == "unknown"]
    assert unknown
    assert all("timeout of 0.3 seconds" in check["reason"] for check in unknown)
    # What needs no solver is decided all the same.
    assert any(check["verdict"] != "unknown" for check in checks)


def test_diff_reports_unknown(cli: Cli, hard: Path, tmp_path: Path) -> None:
    new = tmp_path / "new.sleec"
    new.write_text(hard.read_text().replace("NOT A", "NOT B"))
    done = cli("diff", str(hard), str(new), "--timeout", "0.3", "--format", "json")
    assert done.code == 3
    assert "timeout of 0.3 seconds" in done.out


def test_certify_says_what_is_unknown(cli: Cli, hard: Path, tmp_path: Path) -> None:
    done = cli("certify", str(hard), "-o", str(tmp_path / "certificate"), "--timeout", "0.3")
    assert done.code == 3


def test_enough_time_changes_nothing(cli: Cli, tmp_path: Path) -> None:
    path = tmp_path / "easy.sleec"
    path.write_text(EASY)
    with_timeout = cli("check", str(path), "--timeout", "600", "--no-cache")
    assert (with_timeout.code, with_timeout.out) == (1, cli("check", str(path), "--no-cache").out)


@pytest.mark.parametrize("command", ["check", "diff", "gate", "certify"])
@pytest.mark.parametrize("seconds", ["0", "-1", "nan", "soon", "1e30"])
def test_bad_times(cli: Cli, command: str, seconds: str) -> None:
    done = cli(command, "x.sleec", "--timeout", seconds)
    assert done.code == 2
    assert "--timeout" in done.err
    assert ("is not a number of seconds" in done.err) == (seconds in ("nan", "soon"))
