"""Every command reads regular files up to the limit, whatever a file is for; pipes and devices are refused at once."""

from __future__ import annotations

import ast
import io
import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import click
import pytest

import sleec_runtime
import sleec_verify
from sleec_runtime.support.files import DEFAULT_MAX_SIZE
from sleec_verify.cli.commands import sleec_verify as group
from tests.support.cli import Cli

LIMIT = 2000
RULES = "WHEN A THEN B\n"
ROBOT = "import sleec_runtime\n"
CONFIG = 'rulesets = ["rules"]\nbase = "HEAD"\n'
FILES = {
    "good.sleec": RULES,
    "rules/good.sleec": RULES,
    "robot.py": ROBOT,
    "sleec-verify.toml": CONFIG,
}
ROLES = {
    "check": "check good.sleec X.sleec",
    "check of a folder": "check .",
    "check with a format": "check X.sleec --format json",
    "entail": "entail X.sleec --when A",
    "explain": "explain X.sleec --when A",
    "compile": "compile X.sleec --to json",
    "cases": "cases X.sleec",
    "certify": "certify X.sleec -o certificate",
    "certify --sign": "certify good.sleec -o certificate --sign X.pem",
    "conform, rules": "conform robot.py --ruleset X.sleec",
    "conform, code": "conform X.py --ruleset good.sleec",
    "audit, rules": "audit mission.jsonl --ruleset X.sleec",
    "audit --mapping": "audit mission.jsonl --ruleset good.sleec --mapping X.toml",
    "audit --state": "audit mission.jsonl --ruleset good.sleec --state X.json",
    "convert": "convert X.sleec --to dsl",
    "fmt": "fmt X.sleec",
    "fmt --check": "fmt --check .",
    "diff, old": "diff X.sleec good.sleec",
    "diff, new": "diff good.sleec X.sleec",
    "diff, assertions": "diff good.sleec good.sleec --assertions X.txt",
    "diff --git": "diff --git HEAD X.sleec",
    "gate": "gate rules X.sleec",
    "gate --config": "gate --config X.toml",
    "gate --baseline": "gate --baseline X.txt",
}

NOT_FOLLOWED = {"check of a folder", "fmt --check", "diff --git", "gate"}
"""A link that leaves the folder or the repository is skipped or refused before it is read."""

IN_REPOSITORY = {"gate --config", "gate --baseline"}
"""Files that the base has, too: a link that leaves the repository is refused."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    commit(tmp_path)
    return tmp_path


def commit(folder: Path) -> None:
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "base"]):
        identity = ["-c", "user.name=a", "-c", "user.email=a@b"]
        subprocess.run(["git", *identity, *command], cwd=folder, check=True)


def large(path: Path) -> None:
    path.write_text("# \n" * LIMIT, encoding="utf-8")


def device(path: Path) -> None:
    path.symlink_to("/dev/zero")


KINDS: dict[str, tuple[Callable[[Path], None], str]] = {
    "large": (large, "it is larger than 2000 bytes"),
    "pipe": (os.mkfifo, "it is not a regular file"),
    "device": (device, "it is not a regular file"),
}


def made(folder: Path, command: str, make: Callable[[Path], None]) -> list[str]:
    """The arguments of a command, of whose files the one called X is made so."""
    name = next((word for word in command.split() if word.startswith("X")), "X.sleec")
    make(folder / name)
    return [*command.split(), "--max-size", str(LIMIT)]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("role", ROLES)
def test_a_file_is_refused_in_every_role(role: str, kind: str, folder: Path, cli: Cli) -> None:
    make, why = KINDS[kind]
    ran = cli(*made(folder, ROLES[role], make))
    if kind == "device" and role in NOT_FOLLOWED:
        assert "X.sleec" in ran.err
    elif kind == "device" and role in IN_REPOSITORY:
        assert ran.code == 2
        assert "points outside the repository" in ran.err
    else:
        assert ran.code == 2
        assert why in ran.err


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("setting", ["assertions", "rules", "code", "baseline"])
def test_a_file_that_the_configuration_names_is_refused(setting: str, kind: str, folder: Path, cli: Cli) -> None:
    make, why = KINDS[kind]
    name = {"assertions": "X.txt", "rules": "X.sleec", "code": "X.py", "baseline": "X.txt"}[setting]
    target = {"code": "robot.py", "rules": "good.sleec", setting: name}
    config = CONFIG + {"assertions": f'assertions = ["{name}"]\n', "baseline": f'baseline = "{name}"\n'}.get(
        setting, f'[[targets]]\ncode = "{target["code"]}"\nrules = "{target["rules"]}"\n'
    )
    (folder / "sleec-verify.toml").write_text(config, encoding="utf-8")
    commit(folder)
    make(folder / name)
    ran = cli("gate", "--max-size", str(LIMIT))
    assert ran.code == 2
    # The device is outside the repository.
    assert (f"{name} points outside the repository" if kind == "device" else why) in ran.err


@pytest.mark.parametrize("command", ["diff --git HEAD", "diff --git HEAD..HEAD rules", "gate"])
def test_a_text_that_git_holds_is_refused(command: str, folder: Path, cli: Cli) -> None:
    large(folder / "rules" / "good.sleec")
    commit(folder)
    (folder / "rules" / "good.sleec").write_text(RULES, encoding="utf-8")
    everything = ["--assert", "never B when A"] if ".." in command else []
    ran = cli(*command.split(), *everything, "--max-size", str(LIMIT))
    assert ran.code == 2
    assert "HEAD:rules/good.sleec cannot be read: it is larger than 2000 bytes" in ran.err


def test_standard_input_is_refused(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(b"# \n" * LIMIT)))
    ran = cli("check", "-", "--max-size", str(LIMIT))
    assert ran.code == 2
    assert "standard input cannot be read: it is larger than 2000 bytes" in ran.err


@pytest.mark.parametrize("name", ["manifest.json", "*.cnf", "*.lrat"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_certificate_is_refused(kind: str, name: str, folder: Path, cli: Cli) -> None:
    assert cli("certify", "good.sleec", "-o", "certificate").code == 0
    path = next((folder / "certificate").glob(name))
    path.unlink()
    KINDS[kind][0](path)
    assert cli("certify", "good.sleec", "--check", "certificate", "--max-size", str(LIMIT)).code == 2


@pytest.mark.parametrize(
    ("written", "size"),
    [("200kB", 200_000), ("1 KiB", 1024), ("3MB", 3_000_000), ("1mib", 2**20), ("2GiB", 2**31), ("900B", 900)],
)
def test_sizes_have_units(written: str, size: int, folder: Path, cli: Cli) -> None:
    large = folder / "large.sleec"
    large.touch()
    os.truncate(large, size + 1)
    ran = cli("check", "good.sleec", "large.sleec", "--max-size", written)
    assert ran.code == 2
    assert "large.sleec cannot be read: it is larger than" in ran.err


@pytest.mark.parametrize(
    "written", ["", "0", "-1", "1.5MiB", "16M", "1e6", "MiB", "1 TB", "nan", "٣", "9" * 16, "1GiBx"]
)
def test_other_sizes_are_refused(written: str, folder: Path, cli: Cli) -> None:
    ran = cli("check", "good.sleec", "--max-size", written)
    assert ran.code == 2
    assert "Invalid value for '--max-size'" in ran.err


def test_the_limit_lasts_for_one_run(folder: Path, cli: Cli) -> None:
    assert cli("check", "good.sleec", "--max-size", "1").code == 2
    assert cli("check", "good.sleec", "--max-size", "1", "--format", "none").code == 2
    assert cli("check", "good.sleec").code == 0


def test_every_command_that_reads_files_has_the_option() -> None:
    context = click.Context(group)
    assert DEFAULT_MAX_SIZE == 16 * 2**20
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        assert command is not None
        limited = [one.default for one in command.params if one.name == "max_size"]
        reads = any(isinstance(one.type, click.Path) for one in command.params)
        assert limited == (["16MiB"] if reads else []), name


OWN_FILES = {
    ("sleec_runtime/support/files.py", "open"),
    ("sleec_verify/cli/cache/program.py", "open"),
    ("sleec_verify/cli/cache/store.py", "open"),
    ("sleec_verify/files/placement.py", "open"),
    ("sleec_verify/cli/gate.py", "open"),
    ("sleec_verify/certificates/checker.py", "read_text"),
    ("sleec_verify/pytest_plugin/__init__.py", "read_text"),
    ("sleec_verify/files/temporary.py", "open"),
    ("sleec_verify/audit/readers/json_lines.py", "open"),
    ("sleec_verify/report/html/page.py", "read_text"),
    ("sleec_verify/audit/fleet.py", "read_bytes"),
    ("sleec_verify/wording/catalogue.py", "read_text"),
}
"""Where a file is opened that no user names for reading: results of the cache, what is written, copies of proofs, our
own code and words; and logs, which are read as streams."""


def test_no_other_code_reads_files() -> None:
    found = set()
    for package in (sleec_runtime, sleec_verify):
        (home,) = package.__path__
        for path in Path(home).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if not isinstance(node, ast.Call):
                    continue
                called = node.func
                name = called.id if isinstance(called, ast.Name) else getattr(called, "attr", "")
                if name in ("read_text", "read_bytes") or (name == "open" and isinstance(called, ast.Name)):
                    found.add((path.relative_to(Path(home).parent).as_posix(), name))
    assert found <= OWN_FILES
