from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

SOURCES = Path(__file__).parents[2] / "proofs" / "checker"


def require_coq() -> None:
    """Skips, with the reason, where the proved checker cannot be built, but fails in CI."""
    missing = [tool for tool in ("coqc", "ocamlfind", "make") if shutil.which(tool) is None]
    if missing:
        reason = f"the proved checker cannot be built without {' and '.join(missing)} (apt-get install coq)"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)


@pytest.fixture(scope="session")
def proved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The checker that is proved in Coq, built afresh."""
    require_coq()
    folder = tmp_path_factory.mktemp("checker")
    for name in ("Makefile", "main.ml", *(source.name for source in SOURCES.glob("*.v"))):
        shutil.copy(SOURCES / name, folder)
    built = subprocess.run(["make", "-C", str(folder)], capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stdout + built.stderr
    assert "Closed under the global context" in built.stdout
    return folder / "check-lrat"
