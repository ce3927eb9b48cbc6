from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.coq import require_coq
from tests.support.paths import ROOT

SOURCES = ROOT / "proofs" / "checker"


@pytest.fixture(scope="session")
def proved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The checker that is proved in Coq, built afresh."""
    require_coq("the proved checker")
    folder = tmp_path_factory.mktemp("checker")
    for name in ("Makefile", "main.ml", *(source.name for source in SOURCES.glob("*.v"))):
        shutil.copy(SOURCES / name, folder)
    built = subprocess.run(["make", "-C", str(folder)], capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stdout + built.stderr
    assert "Closed under the global context" in built.stdout
    return folder / "check-lrat"
