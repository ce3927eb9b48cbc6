"""The oracle: a program that is extracted from the theory in `proofs/`. It answers one question for each line."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable
from pathlib import Path
from threading import Timer
from types import TracebackType

from sleec_runtime.errors import SleecError

BUILT = Path(__file__).parents[3] / "proofs" / "oracle" / "sleec-oracle"
"""Where `make -C proofs` puts it, in a copy of the sources."""


class NoAnswer(SleecError):
    """The oracle did not answer."""


class NotRefuted(SleecError):
    """That the theory's clauses of a ruleset are unsatisfiable is not shown."""


def built() -> Path | None:
    """The oracle, if it is built."""
    return BUILT if os.access(BUILT, os.X_OK) else None


class Oracle:
    """The oracle at work, which remembers the rules and the formula that it was asked about. What questions and answers
    look like stands in `proofs/oracle/main.ml`.

    It reads a line to its end before it writes one, so neither side waits for the other, however long they are.
    """

    def __init__(self, program: Path, seconds: float | None = None) -> None:
        """`seconds` is the time limit for one question. Raises NoAnswer if the oracle cannot be run."""
        self._seconds = seconds
        self._late = False
        try:
            self._process = subprocess.Popen(
                [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
            )
        except OSError as error:
            raise NoAnswer(f"the oracle {program} cannot be run: {error.strerror}") from None

    def ask(self, question: str) -> str:
        """The answer to a question. Raises NoAnswer if there is none within the time limit; the oracle has then
        ended."""
        assert self._process.stdin is not None, "a pipe"
        assert self._process.stdout is not None, "a pipe"
        watchdog = Timer(self._seconds, self._give_up) if self._seconds is not None else None
        try:
            if watchdog is not None:
                watchdog.start()
            try:
                self._process.stdin.write(f"{question}\n")
                self._process.stdin.flush()
            except BrokenPipeError:
                # Why it has ended, it may have said.
                pass
            answer = self._process.stdout.readline()
        finally:
            if watchdog is not None:
                watchdog.cancel()
        if self._late:
            raise NoAnswer(f"the oracle did not answer in {self._seconds:g} s")
        if answer.endswith("\n") and not answer.startswith("UNREADABLE: "):
            return answer[:-1]
        said = answer.strip() or f"it exited with {self._process.wait()}"
        raise NoAnswer(f"the oracle did not answer: {said}")

    def _give_up(self) -> None:
        self._late = True
        self._process.kill()

    def close(self) -> None:
        """End it."""
        self._process.kill()
        # Leaving it closes the pipes, what is left in them aside, and waits.
        try:
            self._process.__exit__(None, None, None)
        except BrokenPipeError:
            self._process.wait()

    def __enter__(self) -> Oracle:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()


def answers(program: Path, questions: Iterable[str], seconds: float | None = None) -> list[str]:
    """The answer to each question. Raises NoAnswer as `Oracle` does."""
    with Oracle(program, seconds) as oracle:
        return [oracle.ask(question) for question in questions]
