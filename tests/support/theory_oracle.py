from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.coq import require_coq
from tests.support.paths import ROOT

PROOFS = ROOT / "proofs"


@pytest.fixture(scope="session")
def oracle() -> Path:
    """What is extracted from the theory, built where it stands: compiling the theory takes too long to do it twice.

    Several tests may want it at once, each in a process of its own.
    """
    require_coq("the oracle")
    import fcntl

    with (PROOFS / ".building").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        command = ["make", "-C", str(PROOFS), "oracle-alone"]
        built = subprocess.run(command, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stdout + built.stderr
    return PROOFS / "oracle" / "sleec-oracle"
