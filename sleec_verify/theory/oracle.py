"""The oracle: what is extracted from the theory in `proofs/`, as a program that answers questions, a line each."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable
from pathlib import Path

from sleec_runtime.errors import SleecError

BUILT = Path(__file__).parents[2] / "proofs" / "oracle" / "sleec-oracle"
"""Where `make -C proofs` puts it, in a copy of the sources."""


class NoAnswer(SleecError):
    """The oracle did not answer."""


class NotRefuted(SleecError):
    """That the theory's clauses of a ruleset are unsatisfiable is not shown."""


def built() -> Path | None:
    """The oracle, if it is built."""
    return BUILT if os.access(BUILT, os.X_OK) else None


def answers(program: Path, questions: Iterable[str], seconds: float | None = None) -> list[str]:
    """The answer to each question; what they look like stands in `proofs/oracle/main.ml`.

    Raises NoAnswer where there are fewer, or after so many `seconds`.
    """
    asked = list(questions)
    try:
        done = subprocess.run(
            [program], input="\n".join(asked) + "\n", capture_output=True, text=True, timeout=seconds, check=False
        )
    except subprocess.TimeoutExpired:
        raise NoAnswer(f"the oracle did not answer in {seconds:g} s") from None
    except OSError as error:
        raise NoAnswer(f"the oracle {program} cannot be run: {error.strerror}") from None
    found = done.stdout.splitlines()
    if done.returncode or len(found) != len(asked):
        last = found[-1] if found else ""
        said = last if last.startswith("UNREADABLE: ") else f"it ended with {done.returncode}"
        raise NoAnswer(f"the oracle did not answer: {said}")
    return found
