"""The files of a certificate are read once each, and up to a limit."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from sleec_runtime.language import load
from sleec_runtime.support.files import read_file
from sleec_verify.certificates.checker import IN_PYTHON, Checker
from sleec_verify.certificates.verification import check_certificate
from tests.fast.certificates.test_refused import certified, reasons


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return certified("proved", tmp_path_factory.mktemp("made"))


@pytest.mark.parametrize("name", ["manifest.json", "conflict.cnf", "conflict.lrat"])
def test_a_file_of_any_size_is_refused_at_once(made: Path, tmp_path: Path, name: str) -> None:
    """40 GB, of which the disk holds nothing."""
    folder = Path(shutil.copytree(made, tmp_path / "copy"))
    os.truncate(folder / "c" / name, 40 * 2**30)
    assert reasons(folder) == {"no-certificate" if name == "manifest.json" else "file-size"}


def test_a_folder_that_cannot_be_listed(made: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(folder: Path) -> list[str]:
        raise PermissionError(13, "Permission denied", str(folder))

    monkeypatch.setattr("sleec_verify.certificates.verification.os.listdir", refuse)
    assert reasons(made) == {"file-missing"}


def test_each_file_is_read_once(made: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[str] = []

    def reading(path: str | Path) -> bytes:
        read.append(os.path.basename(path))
        return read_file(path)

    for module in ("sleec_runtime.certificate.coverage", "sleec_verify.certificates.verification"):
        monkeypatch.setattr(f"{module}.read_file", reading)
    assert reasons(made) == set()
    assert sorted(read) == sorted(path.name for path in (made / "c").iterdir())


def test_what_is_compared_is_what_is_judged(made: Path, tmp_path: Path) -> None:
    """Whatever becomes of the files once they have been read."""
    folder = Path(shutil.copytree(made, tmp_path / "copy"))

    def refuses(formula: bytes, proof: bytes) -> str | None:
        for kind in ("cnf", "lrat"):
            (folder / "c" / f"conflict.{kind}").write_text("something else")
        return IN_PYTHON.refuses(formula, proof)

    check_certificate(load(folder / "rules.sleec"), str(folder / "c"), Checker("a judge", False, refuses))
    assert reasons(folder) == {"file-changed", "clauses"}
