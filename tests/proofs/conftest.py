from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

PROOFS = Path(__file__).parents[2] / "proofs"


def require_coq() -> None:
    """Skips, with the reason, where the oracle cannot be built, but fails in CI."""
    missing = [tool for tool in ("coqc", "ocamlfind", "make") if shutil.which(tool) is None]
    if missing:
        reason = f"the oracle cannot be built without {' and '.join(missing)} (apt-get install coq ocaml-findlib)"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)


@pytest.fixture(scope="session")
def oracle() -> Path:
    """What is extracted from the theory, built where it stands: compiling the theory takes too long to do it twice.

    Several tests may want it at once, each in a process of its own.
    """
    require_coq()
    import fcntl

    with (PROOFS / ".building").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        command = ["make", "-C", str(PROOFS), "oracle-alone"]
        built = subprocess.run(command, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stdout + built.stderr
    return PROOFS / "oracle" / "sleec-oracle"
