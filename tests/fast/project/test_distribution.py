"""What the two distributions say of themselves, and what their packages may import."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

import pytest

import sleec_runtime
import sleec_verify
from tests.support.paths import ROOT
from tests.support.pyprojects import RUNTIME, VERIFY

VERSION = sleec_runtime.__version__
DISTRIBUTIONS = ["sleec-runtime", "sleec-verify"]


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_version_is_the_installed_one(name: str) -> None:
    assert metadata.version(name) == VERSION == sleec_verify.__version__


def test_the_version_stands_in_one_place() -> None:
    written = f'"{VERSION}"'
    found = [
        path.relative_to(ROOT).as_posix()
        for pattern in ("*.py", "*.toml", "*.cff", "*.yml", "sleec_*/**/*.py", "sleec_*/*.toml")
        for path in ROOT.glob(pattern)
        if written in path.read_text(encoding="utf-8")
    ]
    assert found == ["sleec_runtime/__init__.py"]


def test_the_verifier_needs_the_runtime_of_its_version() -> None:
    assert f"sleec-runtime=={VERSION}" in (metadata.requires("sleec-verify") or ())


def test_the_runtime_needs_contextpy3_only() -> None:
    needed = [one for one in metadata.requires("sleec-runtime") or () if "extra ==" not in one]
    assert [one.split("<")[0] for one in needed] == ["contextpy3"]


def test_changelog_has_the_version() -> None:
    assert f"## {VERSION}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_both_are_typed(name: str) -> None:
    assert (ROOT / name.replace("-", "_") / "py.typed").is_file()
    assert "Typing :: Typed" in (metadata.metadata(name).get_all("Classifier") or ())


def test_the_licence_of_both_is_the_same() -> None:
    assert (ROOT / "sleec_runtime" / "LICENSE").read_bytes() == (ROOT / "LICENSE").read_bytes()


def test_what_leads_nowhere_cannot_be_uploaded() -> None:
    """OWNER stands for an address that the project does not have yet. Package indexes refuse the classifier."""
    for project in (VERIFY["project"], RUNTIME["project"]):
        unknown = any("/OWNER/" in url for url in project["urls"].values())
        assert unknown == ("Private :: Do Not Upload" in project["classifiers"])


def test_both_name_the_same_places() -> None:
    ours, theirs = VERIFY["project"]["urls"], RUNTIME["project"]["urls"]
    assert ours.keys() == theirs.keys()
    assert all(url.startswith(ours["Source"]) for url in [*ours.values(), *theirs.values()])


# What is imported --------------------------------------------------------------------------------------------


def imports(path: Path) -> Iterator[tuple[str, bool]]:
    """The top-level names that a file imports, and whether it does so only when a function is called."""
    tree = ast.parse(path.read_bytes())
    lazy = {
        inner
        for outer in ast.walk(tree)
        if isinstance(outer, (ast.FunctionDef, ast.AsyncFunctionDef))
        for inner in ast.walk(outer)
    }
    for node in ast.walk(tree):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            names = [node.module or ""]
        yield from ((name.split(".")[0], node in lazy) for name in names)


SOURCES = sorted((ROOT / "sleec_runtime").rglob("*.py"))


def test_the_runtime_imports_the_standard_library_and_contextpy3_only() -> None:
    allowed = {*sys.stdlib_module_names, "contextpy3", "sleec_runtime"}
    outside = {(path.name, name, lazy) for path in SOURCES for name, lazy in imports(path) if name not in allowed}
    # What extras and ROS 2 add is imported where it is used. Two modules of the extra `dds` import it at once; the
    # transport imports them when it starts.
    assert outside == {
        ("signature.py", "cryptography", True),
        ("type_store.py", "rosbags", True),
        ("idl_types.py", "cyclonedds", False),
        ("participant.py", "cyclonedds", False),
        ("rclpy_transport.py", "rclpy", True),
        ("rclpy_transport.py", "rosidl_runtime_py", True),
    }


def test_runtime_imports_nothing_of_the_verifier() -> None:
    code = (
        "import pkgutil, sys, sleec_runtime\n"
        "for m in pkgutil.walk_packages(sleec_runtime.__path__, 'sleec_runtime.'): __import__(m.name)\n"
        "print(*[m for m in sys.modules if m.split('.')[0] in ('sleec_verify', 'pysolvers', 'sympy', 'click', 'rich')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.split() == []


def test_no_file_is_longer_than_people_read() -> None:
    long = {
        str(path.relative_to(ROOT)): lines
        for package in ("sleec_runtime", "sleec_verify")
        for path in (ROOT / package).rglob("*.py")
        if (lines := len(path.read_text(encoding="utf-8").splitlines())) > 500
    }
    assert long == {}
