"""Chooses the checker of refutations: the one that is proved in Coq if it is built, otherwise the one in Python."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from sleec_runtime.errors import SleecError
from sleec_verify.certificates import lrat
from sleec_verify.files.temporary import with_temporary

BUILT = Path(__file__).parents[2] / "proofs" / "checker" / "check-lrat"
"""The path to which `make -C proofs/checker` writes it, in a copy of the sources."""

MOST_SECONDS = 60.0
"""The time limit of a checker for one refutation."""


@dataclass(frozen=True)
class Checker:
    """A checker of refutations. `refuses` takes a formula (DIMACS) and its refutation (LRAT), and returns the reason
    for a rejection, or None. `name` is for messages. `proved` says whether it is proved in Coq."""

    name: str
    proved: bool
    refuses: Callable[[bytes, bytes], str | None]


def _in_python(formula: bytes, proof: bytes) -> str | None:
    try:
        lrat.check(formula.decode("ascii"), proof.decode("ascii"), MOST_SECONDS)
    except lrat.InvalidProof as refusal:
        return refusal.message
    except UnicodeDecodeError:
        return "the file has an invalid format"
    return None


IN_PYTHON = Checker("sleec_verify.certificates.lrat, in Python", False, _in_python)


def checker(path: str | None = None) -> Checker:
    """The checker at `path`. By default, the proved one if it is built, otherwise the one in Python.

    Raises SleecError if `path` is not a program.
    """
    if path is None:
        if not os.access(BUILT, os.X_OK):
            return IN_PYTHON
        path = str(BUILT)
    elif not (os.path.isfile(path) and os.access(path, os.X_OK)):
        raise SleecError(f"{path} is not a program", "build one with make -C proofs/checker: proofs/checker/check-lrat")
    program = os.path.abspath(path)
    proved = os.path.realpath(path) == os.path.realpath(BUILT)
    return Checker(path, proved, lambda formula, proof: judge_by_program(program, formula, proof))


def judge_by_program(program: str, formula: bytes, proof: bytes) -> str | None:
    """The reason why a checker rejects a refutation. None if it accepts it."""

    def run(folder: str) -> subprocess.CompletedProcess[str]:
        os.mkdir(folder, 0o700)
        paths = Path(folder, "formula.cnf"), Path(folder, "proof.lrat")
        for path, data in zip(paths, (formula, proof)):
            path.write_bytes(data)
        return subprocess.run(
            [program, *paths], capture_output=True, text=True, errors="replace", check=False, timeout=MOST_SECONDS
        )

    try:
        # It reads copies: what is in the certificate's folder may have changed since it was read.
        done = with_temporary(os.path.join(tempfile.gettempdir(), ""), run)
    except OSError as error:
        raise SleecError(f"the checker {program} cannot be run: {error.strerror}") from None
    except subprocess.TimeoutExpired:
        return lrat.LATE.format(MOST_SECONDS)
    if done.returncode == 0 and done.stdout == "VERIFIED\n":
        return None
    _, _, reason = done.stdout.strip().partition(": ")
    return reason or f"the checker exited with {done.returncode} and without a verdict"
