"""What the project promises of itself: its version, its lock, its Pythons."""

from __future__ import annotations

import re
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import sleec_verify

ROOT = Path(__file__).parents[2]


def test_version_is_the_installed_one():
    assert metadata.version("sleec-verify") == sleec_verify.__version__


def test_changelog_has_the_version():
    assert f"## {sleec_verify.__version__}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("lock", ["requirements-dev.lock", "requirements-docs.lock"])
def test_lock_pins_every_package_to_one_version(lock):
    lines = (ROOT / lock).read_text(encoding="utf-8").splitlines()
    assert lines
    for line in lines:
        assert re.fullmatch(r"[\w.-]+==[\w.]+(; python_version < \"3\.11\")?", line), line


def test_lock_holds_what_pyproject_asks_for():
    dev, docs = (locked(f"requirements-{name}.lock") for name in ("dev", "docs"))
    for requirement in metadata.requires("sleec-verify") or ():
        if "mutants" not in requirement:
            name = re.match(r"[\w.-]+", requirement)
            assert name
            assert name.group().lower() in (docs if "docs" in requirement else dev)


def test_what_the_docs_need_besides_is_in_one_lock_only():
    """Both are installed into one environment."""
    assert not locked("requirements-dev.lock") & locked("requirements-docs.lock")


def locked(name: str) -> set[str]:
    return {line.split("==")[0].lower() for line in (ROOT / name).read_text(encoding="utf-8").splitlines()}


def test_runtime_imports_nothing_of_the_verifier():
    code = (
        "import pkgutil, sys, sleec_runtime\n"
        "for m in pkgutil.walk_packages(sleec_runtime.__path__, 'sleec_runtime.'): __import__(m.name)\n"
        "print(*[m for m in sys.modules if m.split('.')[0] in ('sleec_verify', 'pysolvers', 'sympy', 'click', 'rich')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.split() == []


def test_no_file_is_longer_than_people_read():
    long = {
        str(path.relative_to(ROOT)): lines
        for package in ("sleec_runtime", "sleec_verify")
        for path in (ROOT / package).rglob("*.py")
        if (lines := len(path.read_text(encoding="utf-8").splitlines())) > 500
    }
    assert long == {}
