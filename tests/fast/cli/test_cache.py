"""The cache: rules that did not change are not decided again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import sleec_runtime
import sleec_verify
from sleec_verify.cli.cache.program import program_identity
from tests.support.caches import CLASH, TIMED, entries
from tests.support.cli import Cli


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("form", ["full", "json", "sarif", "junit"])
@pytest.mark.parametrize("rules", [CLASH, TIMED, "WHEN Rung THEN Open\n"])
def test_the_second_check_solves_nothing_and_tells_the_same(
    form: str, rules: str, cli: Cli, solves: Callable[[], int]
) -> None:
    first = cli("check", "a.sleec", "--format", form, files={"a.sleec": rules})
    assert solves() == 1
    second = cli("check", "a.sleec", "--format", form)
    assert solves() == 0
    assert first == second


@pytest.mark.usefixtures("folder")
def test_of_a_folder_only_what_changed_is_solved(cli: Cli, solves: Callable[[], int]) -> None:
    cli("check", ".", files={"a.sleec": CLASH, "b.sleec": TIMED})
    assert solves() == 2
    cli("check", ".", files={"b.sleec": TIMED + "WHEN Rung THEN Wave\n"})
    assert solves() == 1
    cli("check", ".", files={"c.sleec": CLASH})
    assert solves() == 0, "the same rules under another name"


@pytest.mark.parametrize(
    "options", [["--reading", "priority"], ["--untimed", "eventually"], ["--domain", "home"], ["--no-cache"]]
)
@pytest.mark.usefixtures("folder")
def test_other_options_are_another_question(options: list[str], cli: Cli, solves: Callable[[], int]) -> None:
    cli("check", "a.sleec", files={"a.sleec": "DOMAIN home\n" + CLASH})
    solves()
    cli("check", "a.sleec", *options)
    assert solves() == 1


@pytest.mark.usefixtures("folder")
def test_options_of_the_report_are_not(cli: Cli, solves: Callable[[], int]) -> None:
    assert cli("check", "a.sleec", "--fail-level", "error", files={"a.sleec": CLASH}).code == 1
    solves()
    assert "situation" in cli("check", "a.sleec", "--fail-level", "note", "--format", "full").out
    assert solves() == 0


def test_another_program_decides_anew(
    folder: Path, cli: Cli, solves: Callable[[], int], monkeypatch: pytest.MonkeyPatch
) -> None:
    cli("check", "a.sleec", files={"a.sleec": CLASH})
    monkeypatch.setattr("sleec_verify.cli.cache.store.__version__", "99.0.0")
    cli("check", "a.sleec")
    assert solves() == 2
    monkeypatch.setattr("sleec_verify.cli.cache.store.program_identity", lambda: "changed")
    cli("check", "a.sleec")
    assert solves() == 1
    assert len(entries(folder)) == 3


@pytest.mark.parametrize("changed", ["sleec_runtime", "sleec_verify"])
def test_a_changed_source_is_another_program(changed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = two_packages(tmp_path, monkeypatch)[changed]
    seen = {program_identity()}
    (package / "checks" / "one.py").write_text("more")
    seen.add(program_identity())
    (package / "checks" / "two.py").write_text("two")
    seen.add(program_identity())
    assert len(seen) == 3


@pytest.mark.parametrize("changed", ["sleec_runtime", "sleec_verify"])
def test_another_installation_is_another_program(changed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    packages = two_packages(tmp_path, monkeypatch)
    for name, package in packages.items():
        info = package.with_name(f"{name}-{sleec_verify.__version__}.dist-info")
        info.mkdir()
        (info / "RECORD").write_text(f"{name}/a.py,sha256=a,1\n../bin/x,,\n")
    # It is what the installers recorded, wherever and whenever that was.
    installed = program_identity()
    record = packages[changed].with_name(f"{changed}-{sleec_verify.__version__}.dist-info") / "RECORD"
    (packages[changed] / "checks" / "two.py").write_text("two")
    record.write_text(f"{changed}/a.py,sha256=a,1\n../../bin/x,,\n")
    assert program_identity() == installed
    record.write_text(f"{changed}/a.py,sha256=b,1\n")
    assert program_identity() != installed
    # Where one of the two runs from its sources, a change of them counts.
    record.unlink()
    sources = program_identity()
    (packages[changed] / "checks" / "one.py").write_text("more")
    assert program_identity() != sources


def two_packages(folder: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, Path]:
    """Sources of both distributions, in folders apart, in place of the real ones."""
    packages = {name: folder / name / name for name in ("sleec_runtime", "sleec_verify")}
    for package in packages.values():
        (package / "checks").mkdir(parents=True)
        (package / "checks" / "one.py").write_text("one")
    monkeypatch.setattr(sleec_runtime, "__file__", str(packages["sleec_runtime"] / "__init__.py"))
    monkeypatch.setattr(sleec_verify, "__file__", str(packages["sleec_verify"] / "__init__.py"))
    return packages
