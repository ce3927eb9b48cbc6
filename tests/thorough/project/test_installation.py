"""The two distributions, built and installed as users do it: what is in them, and what comes with them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterator
from email.parser import Parser
from pathlib import Path

import pytest

import sleec_runtime
from tests.fast.project.test_hooks import HOOKS
from tests.support.paths import ROOT
from tests.support.sessions import blocks

# Each test builds or installs, from an index that may be slow.
pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]

VERSION = sleec_runtime.__version__
SOURCES = {"sleec_runtime": "sleec_runtime", "sleec_verify": "."}
"""The folder of each distribution's pyproject.toml."""


# What is built -----------------------------------------------------------------------------------------------


def build(source: Path, to: Path, *, umask: int = 0o022) -> dict[str, bytes]:
    """Build the wheels and sdists of both from a copy of the repository: their names and bytes."""
    for folder in SOURCES.values():
        subprocess.run(
            [sys.executable, "-m", "hatchling", "build", "-d", str(to)],
            cwd=source / folder,
            env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"},
            umask=umask,
            check=True,
            stdout=subprocess.DEVNULL,
        )
    return {path.name: path.read_bytes() for path in sorted(to.iterdir())}


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("built")
    build(ROOT, folder)
    return folder


def unpacked(sdist: Path, to: Path) -> Path:
    """The folder of the unpacked sdist. `extractall` takes a filter from Python 3.11.4 on, and warns without one."""
    with tarfile.open(sdist) as archive:
        for member in archive.getmembers():
            content = archive.extractfile(member)
            assert member.isfile(), member.name
            assert content is not None
            assert member.name.startswith(f"{sdist.name.removesuffix('.tar.gz')}/")
            assert ".." not in Path(member.name).parts
            path = to / member.name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content.read())
            path.chmod(member.mode)
    return to / sdist.name.removesuffix(".tar.gz")


def test_builds_are_reproducible_and_the_sdist_is_whole(built: Path, tmp_path: Path) -> None:
    """From the sdist, in another folder, at another time and with other permissions, the same bytes are built."""
    copy = unpacked(built / f"sleec_verify-{VERSION}.tar.gz", tmp_path / "elsewhere")
    (copy / "PKG-INFO").unlink()  # the build adds it
    for path in copy.rglob("*"):
        path.chmod(path.stat().st_mode & 0o700)
        os.utime(path, (1, 1))
    again = build(copy, tmp_path / "again", umask=0o077)
    assert sorted(again) == sorted(path.name for path in built.iterdir())
    for name, content in again.items():
        assert content == (built / name).read_bytes(), f"{name} differs"


def test_the_sdist_holds_what_is_committed(built: Path, tmp_path: Path) -> None:
    if not (ROOT / ".git").exists() or shutil.which("git") is None:
        pytest.skip("this is no git checkout, so nothing says what is committed")
    copy = unpacked(built / f"sleec_verify-{VERSION}.tar.gz", tmp_path)
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "-z"], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout.split("\0")
    committed = {name for name in listed if name and (ROOT / name).exists()}
    assert {"Makefile", "tests/conftest.py", "docs/index.md", "docs/schema/check.schema.json"} <= committed
    missing = {name for name in committed if not (copy / name).is_file()}
    assert not missing


@pytest.mark.parametrize("package", SOURCES)
def test_a_wheel_holds_the_package_only(package: str, built: Path) -> None:
    with zipfile.ZipFile(built / f"{package}-{VERSION}-py3-none-any.whl") as wheel:
        names = {name for name in wheel.namelist() if not name.startswith(f"{package}-{VERSION}.dist-info/")}
    sources = {path.relative_to(ROOT).as_posix() for kind in CONTENT for path in (ROOT / package).rglob(f"*{kind}")}
    assert names == {*sources, f"{package}/py.typed"}


CONTENT = (".py", ".css", ".html", ".js", ".po", ".svg", ".txt")
"""Code, the pages of reports and of `serve`, and translations."""


@pytest.mark.parametrize("package", SOURCES)
def test_links_work_on_a_package_index(package: str, built: Path) -> None:
    """There, a link that is relative to the repository leads nowhere."""
    with zipfile.ZipFile(built / f"{package}-{VERSION}-py3-none-any.whl") as wheel:
        metadata = Parser().parsestr(wheel.read(f"{package}-{VERSION}.dist-info/METADATA").decode())
    text = metadata.get_payload()
    assert isinstance(text, str)
    assert metadata["Description-Content-Type"] == "text/markdown"
    links = [part.split(")")[0] for part in text.split("](")[1:]]
    assert links
    for link in links:
        assert link.startswith(("https://", "#")), link
        name = link.partition(f"/OWNER/sleec-verify/blob/v{VERSION}/")[2].partition("#")[0]
        assert (ROOT / name).exists(), link


# What is installed -------------------------------------------------------------------------------------------


class Environment:
    """An empty environment of this Python."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
        self.python = folder / ("Scripts" if os.name == "nt" else "bin") / "python"

    def pip(self, *arguments: str, cwd: Path | None = None) -> str:
        # Bytecode is compiled where it is asked for: that of sympy alone takes longer than all the rest.
        compiling = [] if "--compile" in arguments or arguments[0] != "install" else ["--no-compile"]
        command = [sys.executable, "-m", "pip", "--python", str(self.python), "--disable-pip-version-check"]
        return self._run([*command, *arguments, *compiling], cwd)

    def run(self, *arguments: str) -> str:
        return self._run([str(self.python), "-I", "-W", "error", *arguments])

    def installed(self) -> dict[str, str]:
        return {one["name"].lower(): one["version"] for one in json.loads(self.pip("list", "--format", "json"))}

    def size(self) -> int:
        """What pip installed, in bytes."""
        (packages,) = self.folder.glob("[lL]ib/**/site-packages")
        return sum(path.stat().st_size for path in packages.rglob("*") if path.is_file())

    def missing(self, *modules: str) -> dict[str, str]:
        """The modules that cannot be imported, each with the package that it needs."""
        return dict(line.split() for line in self.run("-c", IMPORT, *modules).splitlines())

    def _run(self, command: list[str], cwd: Path | None = None) -> str:
        done = subprocess.run(command, cwd=cwd or self.folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout


def modules(package: str) -> Iterator[str]:
    """Every public module of a package."""
    for path in sorted((ROOT / package).rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        if parts[-1] != "__main__" and not any(part.startswith("_") for part in parts if part != "__init__"):
            yield ".".join(part for part in parts if part != "__init__")


IMPORT = """
import importlib, sys
for name in sys.argv[1:]:
    try:
        importlib.import_module(name)
    except ModuleNotFoundError as error:
        print(name, error.name)
"""


WITH_DDS = dict.fromkeys(("sleec_runtime.ros.dds.idl_types", "sleec_runtime.ros.dds.participant"), "cyclonedds")
"""The modules of the extra `dds`, which the transport imports when it starts."""


def test_a_robot_gets_the_runtime_and_contextpy3_only(tmp_path: Path) -> None:
    environment = Environment(tmp_path / "robot")
    environment.pip("install", "--compile", str(ROOT / "sleec_runtime"))
    assert environment.installed().keys() == {"sleec-runtime", "contextpy3"}
    assert environment.size() < 3e6
    assert environment.missing(*modules("sleec_runtime")) == WITH_DDS
    (tmp_path / "a.sleec").write_text("WHEN Rung THEN Open\n")
    code = (
        "import sys, sleec_runtime\n"
        "rules = sleec_runtime.load(sys.argv[1])\n"
        "rules.implement({'Open': lambda: print('open')})\n"
        "rules.trigger('Rung')"
    )
    assert environment.run("-c", code, str(tmp_path / "a.sleec")) == "open\n"


def test_a_robot_gets_locked_wheels_from_a_desk(tmp_path: Path) -> None:
    """As SECURITY.md shows it."""
    for name in ("requirements", "sleec_runtime"):
        shutil.copytree(ROOT / name, tmp_path / "desk" / name, ignore=shutil.ignore_patterns("__pycache__"))
    _, wheels = (block.body for block in blocks((ROOT / "SECURITY.md").read_text(encoding="utf-8")))
    subprocess.run(
        ["sh", "-e", "-c", wheels],
        cwd=tmp_path / "desk",
        env={**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"},
        check=True,
    )
    environment = Environment(tmp_path / "robot")
    environment.pip("install", "--no-index", "--find-links", str(tmp_path / "desk" / "wheels"), "sleec-runtime")
    assert environment.installed() == {"sleec-runtime": VERSION, "contextpy3": "1.0"}


WITH_EXTRAS = {
    "conformance": {"hypothesis", "pytest"},
    "testing": {"hypothesis", "pytest"},
    "pytest": {"hypothesis", "pytest"},
    "audit": {"rosbags", "numpy", "pyarrow", "backports"},
    "serve": {"starlette", "anyio", "uvicorn"},
}
"""What extras add, by a part of the names of the modules that need it."""
"""What modules of the extra `conformance` need. The other extras are imported where they are used."""


def test_a_desk_gets_both_from_a_checkout(tmp_path: Path) -> None:
    """As pre-commit does it, which adds what the hook names to ``pip install .``."""
    (needed,) = {tuple(hook["additional_dependencies"]) for hook in HOOKS}
    environment = Environment(tmp_path / "desk")
    environment.pip("install", ".", *needed, cwd=ROOT)
    installed = environment.installed()
    assert installed["sleec-runtime"] == installed["sleec-verify"] == VERSION
    environment.pip("check")
    missing = environment.missing(*modules("sleec_runtime"), *modules("sleec_verify"))
    missing = {name: package for name, package in missing.items() if name not in WITH_DDS}
    for name, needed_by_it in missing.items():
        assert any(part in name and needed_by_it in packages for part, packages in WITH_EXTRAS.items()), name
    program = environment.python.with_name("sleec-verify")
    version = subprocess.run([str(program), "--version"], check=True, capture_output=True, text=True).stdout
    assert VERSION in version
    assert "16 checks passed" in environment.run(
        "-m", "sleec_verify", "check", str(ROOT / "rulesets/hospital-ward.sleec")
    )
