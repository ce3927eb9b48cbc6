"""The cache: rules that did not change are not decided again, and nothing but what was decided for just these rules,
options and program is ever taken from it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

import sleec_runtime
import sleec_verify
from sleec_runtime.language import load, parse
from sleec_runtime.model import Ruleset, Span, Value
from sleec_verify.checks import run_checks
from sleec_verify.cli.cache import entry as entry_of_cache
from sleec_verify.cli.cache.program import program_identity
from sleec_verify.cli.cache.store import Cache
from sleec_verify.cli.scope import Scope
from sleec_verify.results.finding import CheckResult, Finding, Proved, Refuted, Unknown, Verdict, Witness
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.strategies import rulesets

RULESETS = sorted((ROOT / "rulesets").glob("*.sleec"))
CLASH = "WHEN Rung THEN Open\nWHEN Storm THEN NOT Open\n"
TIMED = "WHEN Rung THEN Open WITHIN 5 minutes\nWHEN Rung AND Pain > 0.5 THEN NOT Open WITHIN 10 minutes\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a cache that is in use, and empty."""
    kept = tmp_path / "kept"
    monkeypatch.setenv("SLEEC_VERIFY_CACHE", str(kept))
    return kept


def entries(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.is_file() and path.name != ".gitignore")


@pytest.fixture
def solves(monkeypatch: pytest.MonkeyPatch) -> Callable[[], int]:
    """How often rules were checked since it was asked last."""
    calls: list[None] = []

    def counted(*arguments: object, **named: object) -> tuple[CheckResult, ...]:
        calls.append(None)
        return run_checks(*arguments, **named)  # type: ignore[arg-type]

    monkeypatch.setattr("sleec_verify.checks.run_checks", counted)

    def since() -> int:
        number = len(calls)
        calls.clear()
        return number

    return since


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


# What is broken is decided anew, and mended ------------------------------------------------------------------


def flip(position: int) -> Callable[[bytes], bytes]:
    def broken(content: bytes) -> bytes:
        at = position % len(content)
        return content[:at] + bytes([content[at] ^ 1]) + content[at + 1 :]

    return broken


BREAKS: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda _: b"",
    "cut": lambda content: content[: len(content) // 2],
    "binary": lambda _: bytes(range(256)) * 4,
    "no hash": lambda content: content.partition(b"\n")[2],
    "older format": lambda content: content.replace(b"cache 1", b"cache 0"),
    "first bit": flip(0),
    "bit of the hash": flip(40),
    "bit of the body": flip(150),
    "last bit": flip(-1),
    "green": lambda content: content.replace(b"SLEEC101", b"SLEEC503"),
    "more": lambda content: content + b"\n",
}


@pytest.mark.parametrize("name", BREAKS)
def test_a_broken_entry_is_decided_anew(name: str, folder: Path, cli: Cli, solves: Callable[[], int]) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    content = entry.read_bytes()
    entry.write_bytes(BREAKS[name](content))
    solves()
    ran = cli("check", "a.sleec")
    assert solves() == 1
    assert (ran.code, ran.out) == (sound.code, sound.out)
    assert f"note: the cache entry {entry} is damaged; its results are recomputed\n" in ran.err
    assert cli("check", "a.sleec") == sound
    assert solves() == 0


def test_an_entry_under_another_name_is_none(folder: Path, cli: Cli) -> None:
    """That these rules are fine vouches for no others."""
    cli("check", "fine.sleec", files={"fine.sleec": "WHEN Rung THEN Open\n"})
    (fine,) = entries(folder)
    cli("check", "a.sleec", files={"a.sleec": CLASH})
    (clash,) = (path for path in entries(folder) if path != fine)
    clash.write_bytes(fine.read_bytes())
    ran = cli("check", "a.sleec")
    assert ran.code == 1
    assert "is damaged" in ran.err


@pytest.mark.skipif(os.name != "posix", reason="pipes and devices are those of POSIX")
def test_what_is_no_file_is_no_entry(folder: Path, cli: Cli) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    for make in (
        lambda: os.mkfifo(entry),
        lambda: entry.symlink_to("/dev/zero"),
        lambda: entry.symlink_to(entry),
        lambda: entry.symlink_to("nowhere"),
    ):
        entry.unlink()
        make()
        assert cli("check", "a.sleec") == sound
        assert entry.is_file(), "it was put in place again"
        assert not entry.is_symlink()


@pytest.mark.parametrize("in_place_of", ["entry", "its folder", "all"])
def test_a_folder_or_file_in_the_wrong_place_is_told_of(in_place_of: str, folder: Path, cli: Cli) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    entry.unlink()
    if in_place_of == "entry":
        entry.mkdir()
    elif in_place_of == "its folder":
        entry.parent.rmdir()
        entry.parent.write_text("")
    else:
        shutil.rmtree(folder)
        folder.write_text("")
    ran = cli("check", "a.sleec")
    if in_place_of == "all":
        assert (ran.code, "which is not a folder" in ran.err) == (2, True)
    else:
        assert (ran.code, ran.out) == (sound.code, sound.out)
        assert f"note: the cache folder {folder} cannot be written: " in ran.err


def test_a_hash_that_fits_makes_no_sense_of_nonsense(folder: Path, cli: Cli) -> None:
    sound = cli("check", "a.sleec", files={"a.sleec": CLASH})
    (entry,) = entries(folder)
    for body in (
        b"[]]",
        b"[(1, 2)]",
        b"__import__('os').abort()",
        b"(" * 100_000,
        b"[('x', 0.0, None, [{}])]",
        b"\xff",
    ):
        entry.write_bytes(entry_of_cache.head(str(entry), body) + b"\n" + body)
        ran = cli("check", "a.sleec")
        assert (ran.code, ran.out) == (sound.code, sound.out)
        assert "is damaged" in ran.err


# What is kept ------------------------------------------------------------------------------------------------


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


# Where it is kept --------------------------------------------------------------------------------------------


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
