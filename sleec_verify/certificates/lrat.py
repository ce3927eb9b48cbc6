"""A checker of refutations (LRAT) in Python, used if the checker that is proved in Coq is not built.

It is independent of the code that writes refutations. It reads DIMACS, and LRAT without RAT steps. It accepts a
refutation only if the steps derive the empty clause.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import inf
from time import monotonic

from sleec_runtime.errors import SleecError

LATE = "it was not checked within {:g} s"

_NUMBER = re.compile(r"-?[0-9]{1,17}")


class InvalidProof(SleecError):
    """An invalid refutation, or a file that does not have the expected format."""


def check(formula: str, proof: str, seconds: float = inf) -> None:
    """Checks that `proof` (LRAT) refutes `formula` (DIMACS). It reads each literal once for each hint to its clause.

    Raises InvalidProof, with the reason, if the proof is invalid, or if the check takes longer than `seconds`.
    """
    deadline = monotonic() + seconds
    clauses = dict(enumerate(_clauses(formula), 1))
    for number, literals, hints in _steps(proof):
        if monotonic() >= deadline:
            raise InvalidProof(LATE.format(seconds))
        if literals is None:
            for name in hints:
                clauses.pop(name, None)
            continue
        if not _follows(clauses, literals, hints):
            raise InvalidProof(f"clause {number} does not follow from its hints")
        if not literals:
            return
        clauses[number] = literals
    raise InvalidProof("the proof ends before the empty clause")


def _follows(clauses: dict[int, list[int]], literals: list[int], hints: list[int]) -> bool:
    """Whether the hints lead to a false clause if all literals of the step are false. All other hints must be units."""
    true = {-literal for literal in literals}
    for hint in hints:
        clause = clauses.get(hint)
        if clause is None:
            return False
        left = [literal for literal in clause if -literal not in true]
        if not left:
            return True
        if len(left) > 1 or left[0] in true:
            return False
        true.add(left[0])
    return False


def _numbers(words: list[str], line: int, what: str) -> list[int]:
    for word in words:
        if not _NUMBER.fullmatch(word):
            raise InvalidProof(f"line {line} of the {what}: {word[:30]!r} is not a number")
    return list(map(int, words))


def _rows(text: str) -> Iterator[tuple[int, list[str]]]:
    for number, line in enumerate(text.split("\n"), 1):
        words = line.split()
        if words and words[0] != "c":
            yield number, words


def _clauses(text: str) -> list[list[int]]:
    header: list[int] | None = None
    found = []
    for line, words in _rows(text):
        if words[0] == "p":
            if header is not None or len(words) != 4 or words[1] != "cnf":
                raise InvalidProof(f'line {line} of the formula is not the header "p cnf variables clauses"')
            header = _numbers(words[2:], line, "formula")
            continue
        if header is None:
            raise InvalidProof('the formula has no header "p cnf variables clauses" before its clauses')
        row = _numbers(words, line, "formula")
        if row.count(0) != 1 or row[-1] != 0:
            raise InvalidProof(f"line {line} of the formula is not one clause that ends in 0")
        if any(abs(literal) > header[0] for literal in row):
            raise InvalidProof(f"line {line} of the formula has a variable beyond the number in the header")
        found.append(row[:-1])
    if header is None or header[1] != len(found):
        raise InvalidProof("the number of clauses differs from the header of the formula")
    return found


def _steps(text: str) -> Iterator[tuple[int, list[int] | None, list[int]]]:
    """The number, the literals (None for a deletion) and the hints or deleted clauses of each step."""
    for line, words in _rows(text):
        forgets = words[1:2] == ["d"]
        row = _numbers(words[:1] + words[2:] if forgets else words, line, "proof")
        zeros = [place for place, number in enumerate(row) if number == 0]
        if len(zeros) != (1 if forgets else 2) or zeros[-1] != len(row) - 1 or row[0] <= 0:
            raise InvalidProof(f"line {line} of the proof is not a complete step")
        hints = row[1 if forgets else zeros[0] + 1 : -1]
        if any(hint < 0 for hint in hints):
            raise InvalidProof(f"line {line} of the proof is a RAT step, which this checker does not support")
        yield row[0], None if forgets else row[1 : zeros[0]], hints
