"""Entries of the cache, and where they are."""

from __future__ import annotations

import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from sleec_runtime.language import load, parse
from sleec_runtime.model import Ruleset, Span, Value
from sleec_verify.checks import run_checks
from sleec_verify.cli.cache import entry as entry_of_cache
from sleec_verify.cli.cache.store import Cache
from sleec_verify.encoding.scope import Scope
from sleec_verify.results.finding import CheckResult, Finding, Proved, Refuted, Unknown, Verdict, Witness
from tests.support.caches import CLASH, TIMED, entries
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.strategies import rulesets

RULESETS = sorted((ROOT / "rulesets").glob("*.sleec"))


def told(message: str) -> None:
    raise AssertionError(message)


@pytest.mark.parametrize("path", RULESETS, ids=lambda path: path.stem)
def test_what_is_kept_is_what_was_decided(path: Path, tmp_path: Path) -> None:
    ruleset = load(path)
    results = run_checks(ruleset)
    cache = Cache(str(tmp_path / "kept"), told)
    assert cache.kept(ruleset, Scope()) is None
    cache.keep(ruleset, Scope(), results)
    assert cache.kept(ruleset, Scope()) == results


def of_text(text: str) -> Ruleset:
    return parse(text, "a.sleec", sha256="0" * 64)


def test_timelines_are_kept(tmp_path: Path) -> None:
    ruleset = of_text(TIMED)
    results = run_checks(ruleset)
    assert any(finding.timeline for result in results for finding in result.findings)
    cache = Cache(str(tmp_path), told)
    cache.keep(ruleset, Scope(), results)
    assert cache.kept(ruleset, Scope()) == results


def test_values_are_kept_exactly(tmp_path: Path) -> None:
    values: dict[str, Value] = {"a": True, "b": 10**30, "c": Fraction(1, 3), "d": "r_low", "e f": False, "ü": 0}
    witness = Witness(("a\nb",), values)
    finding = Finding("conflict", "SLEEC101", "error", "'\"\n\\", Span(0, 4), witness=witness)
    ruleset = of_text(CLASH)
    cache = Cache(str(tmp_path), told)
    cache.keep(ruleset, Scope(), (CheckResult("conflict", Refuted((finding, finding)), 0.1, "cut"),))
    assert cache.kept(ruleset, Scope()) == (CheckResult("conflict", Refuted((finding, finding)), 0.1, "cut"),)
    again = cache.kept(ruleset, Scope())
    assert again is not None
    kept = again[0].findings[0].witness
    assert kept is not None
    assert {name: type(value) for name, value in kept.conditions.items()} == {n: type(v) for n, v in values.items()}


@given(ruleset=rulesets())
@settings(max_examples=50, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_any_result_is_kept_as_it_was(ruleset: Ruleset) -> None:
    results = run_checks(ruleset)
    if not any(isinstance(result.verdict, Unknown) for result in results):
        assert entry_of_cache.decode(entry_of_cache.encode(results)) == results


def test_unknown_is_asked_again(folder: Path, cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    answers: list[Verdict] = [Unknown("the solver gave up"), Proved()]
    monkeypatch.setattr(
        "sleec_verify.checks.run_checks", lambda *_, **__: (CheckResult("conflict", answers.pop(0), 0.0),)
    )
    assert cli("check", "a.sleec", files={"a.sleec": "WHEN Rung THEN Open\n"}).code == 3
    assert entries(folder) == []
    assert cli("check", "a.sleec").code == 0
    assert cli("check", "a.sleec").code == 0
    assert answers == []


def test_rules_without_a_text_are_not_kept(tmp_path: Path) -> None:
    ruleset = parse(CLASH)
    cache = Cache(str(tmp_path), told)
    cache.keep(ruleset, Scope(), run_checks(ruleset))
    assert cache.kept(ruleset, Scope()) is None
    assert os.listdir(tmp_path) == []


def test_the_oldest_make_room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.cli.cache.store.MOST_ENTRIES", 3)
    cache = Cache(str(tmp_path), told)
    monkeypatch.setattr(Cache, "path", lambda self, ruleset, scope: str(tmp_path / "aa" / str(scope.domain)))
    ruleset = parse(CLASH)
    results = run_checks(ruleset)
    for number in range(5):
        cache.keep(ruleset, Scope(domain=str(number)), results)
        os.utime(tmp_path / "aa" / str(number), (number, number))
    assert sorted(os.listdir(tmp_path / "aa")) == ["2", "3", "4"]
    assert cache.kept(ruleset, Scope(domain="4")) == results


def test_it_is_for_its_user_alone_and_no_repositorys(folder: Path, cli: Cli) -> None:
    cli("check", "a.sleec", files={"a.sleec": CLASH})
    assert folder.stat().st_mode & 0o077 == 0
    assert (folder / ".gitignore").read_text() == "*\n"


@pytest.mark.parametrize("value", ["off", ""])
def test_off_keeps_nothing_and_nothing_said_is_the_users_folder(
    value: str, cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SLEEC_VERIFY_CACHE", value)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "users"))
    assert cli("check", "a.sleec", files={"a.sleec": CLASH}).err == ""
    assert (tmp_path / "users" / "sleec-verify").is_dir() == (value == "")


def test_without_a_home_nothing_is_kept(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SLEEC_VERIFY_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", "not/absolute")
    monkeypatch.setattr("os.path.expanduser", lambda path: path)
    assert cli("check", "a.sleec", files={"a.sleec": CLASH}).code == 1
    assert os.listdir(tmp_path) == ["a.sleec"]


def test_a_file_is_no_cache(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SLEEC_VERIFY_CACHE", "a.sleec")
    ran = cli("check", "a.sleec", files={"a.sleec": CLASH})
    assert ran.code == 2
    assert "error: SLEEC_VERIFY_CACHE is a.sleec, which is not a folder" in ran.err
    assert "SLEEC_VERIFY_CACHE=off" in ran.err
    assert cli("check", "a.sleec", "--no-cache").code == 1


def test_what_cannot_be_kept_is_told_once_asked_for(folder: Path, cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("os.makedirs", fail)
    ran = cli("check", "a.sleec", files={"a.sleec": CLASH})
    assert ran.code == 1
    assert f"note: the cache folder {folder} cannot be written: Permission denied\n" in ran.err
    monkeypatch.delenv("SLEEC_VERIFY_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder))
    assert cli("check", "a.sleec").err == ""


def test_a_failing_write_leaves_nothing_behind(folder: Path, cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", fail)
    assert cli("check", "a.sleec", files={"a.sleec": CLASH}).code == 1
    assert entries(folder) == []


def test_a_hit_imports_no_solver(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "a.sleec").write_text(CLASH)
    code = (
        "import sys\n"
        "before = set(sys.modules)\n"
        "from sleec_verify.cli import run\n"
        "run(['check', 'a.sleec'])\n"
        "new = sys.modules.keys() - before\n"
        "print('pysolvers' in new or 'pysat' in new, 'sleec_verify.checks' in new, 'json' in new, file=sys.stderr)"
    )
    seen = []
    for _ in range(2):
        done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
        seen.append(done.stderr.split())
    assert len(entries(folder)) == 1
    assert seen == [["True", "True", "False"], ["False", "False", "False"]]
