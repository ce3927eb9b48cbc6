"""Certificates: manifests and signatures, and refutations, made and checked."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from sleec_runtime.certificate.coverage import MANIFEST
from sleec_runtime.certificate.manifest import Required, canonical
from sleec_runtime.certificate.requirement import CertificateRequirement
from sleec_runtime.language import parse_source
from sleec_runtime.language.common.source import decode_source
from sleec_runtime.model import Ruleset
from sleec_verify.certificates import lrat
from sleec_verify.certificates.certification import Certificate, certify
from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.recorder import RecordedQuestion
from sleec_verify.certificates.refutation import Disjunction
from sleec_verify.certificates.verification import check_certificate
from sleec_verify.encoding.elaboration import Answer, Elaborator, InvalidLemma, LearntClause, ProofStep
from sleec_verify.encoding.solver import MiniSat
from tests.fuzz.property import check_error, unless_refused

Clauses = Sequence[Sequence[int]]

RULES = b"""\
MEASURE Age: number
ASSUME NOT (a AND b)
WHEN T THEN X UNLESS a IN WHICH CASE Y UNLESS Age < 0.5 IN WHICH CASE Z
WHEN U AND a THEN Y
WHEN V AND a AND b THEN Y
"""
SEPARATOR = b"--\n"
"""Between the formula and the proof of an input."""


@cache
def certified() -> tuple[Ruleset, Certificate]:
    """Rules that are free of conflict, with findings of other checks, and their certificate."""
    ruleset = parse_source(decode_source("fuzz.sleec", RULES))
    return ruleset, certify(ruleset)


def manifest(data: bytes, folder: Path) -> None:
    """Whatever manifest is accepted has the verdicts that the rules give, and covers what they are."""
    ruleset, genuine = certified()
    for name, text in genuine.files.items():
        (folder / name).write_text(text)
    for written in filter(None, (data, _canonical(data))):
        (folder / MANIFEST).write_bytes(written)
        demand = unless_refused(CertificateRequirement, folder, None, False, Required())
        if demand is not None:
            unless_refused(demand.check, ruleset, None)
        confirmed = unless_refused(check_certificate, ruleset, str(folder), IN_PYTHON)
        if confirmed is not None:
            assert canonical(confirmed.manifest.whole) == written
            assert _claims(confirmed.manifest.whole) == _claims(genuine.manifest)


def _canonical(data: bytes) -> bytes | None:
    """What these bytes say as a manifest is written, so that a change of layout does not end the search."""
    try:
        whole = json.loads(data)
    except (ValueError, RecursionError):
        return None
    return canonical(whole) if isinstance(whole, dict) else None


def _claims(whole: Mapping[str, Any]) -> object:
    """What a manifest says; witnesses may differ."""
    verdicts = [(check["name"], check["verdict"], check["files"]) for check in whole["checks"]]
    return verdicts, {key: whole[key] for key in whole.keys() - {"checks", "tool"}}


def manifest_seeds() -> Iterator[bytes]:
    yield canonical(certified()[1].manifest)


def proof(data: bytes, folder: Path) -> None:
    """Whatever formula has a proof that is accepted has no model."""
    before, _, after = data.partition(SEPARATOR)
    formula = before.decode("ascii", "replace")
    try:
        lrat.check(formula, after.decode("ascii", "replace"))
    except lrat.InvalidProof as refusal:
        check_error(refusal)
        return
    rows = (line.split() for line in formula.split("\n"))
    clauses = [list(map(int, row[:-1])) for row in rows if row and row[0] not in ("c", "p")]
    assert not satisfiable(clauses)


def proof_seeds() -> Iterator[bytes]:
    _, genuine = certified()
    for name, text in genuine.files.items():
        if name.endswith(".cnf"):
            yield text.encode() + SEPARATOR + genuine.files[name.removesuffix("cnf") + "lrat"].encode()


def satisfiable(clauses: Clauses, literals: Sequence[int] = ()) -> bool:
    """Whether some model of the clauses makes all the literals true, whatever numbers they have."""
    numbers: dict[int, int] = {}

    def renumbered(row: Sequence[int]) -> list[int]:
        return [numbers.setdefault(abs(one), len(numbers) + 1) * (1 if one > 0 else -1) for one in row]

    with MiniSat([renumbered(clause) for clause in clauses]) as solver:
        answer = solver.solve(renumbered(literals))
    assert answer is not None
    return answer


def elaboration(data: bytes, folder: Path) -> None:
    """What is elaborated is a proof that the checker accepts, and only questions without a model are refuted."""
    clauses, questions, lemmas = (_rows(part) for part in (data.split(b"\xff", 2) + [b""] * 2)[:3])
    questions = questions or [[]]
    possible = any(satisfiable(clauses, question) for question in questions)
    formula = Disjunction([RecordedQuestion(clauses, dict.fromkeys(map(tuple, questions), ""))])
    try:
        written = formula.lrat()
    except InvalidLemma:
        assert possible
    else:
        assert not possible
        lrat.check(formula.dimacs("fuzz"), written)
    elaborator = Elaborator(clauses, questions)
    variables = {abs(literal) for row in (*clauses, *questions) for literal in row}
    try:
        elaborator.learn(
            LearntClause(tuple(row[1:]), forgotten=row[0] < 0)
            for row in lemmas
            if len(row) > 1 and variables.issuperset(map(abs, row[1:]))
        )
        elaborated = elaborator.elaborate()
    except InvalidLemma:
        return
    assert not possible
    for question, answer in zip(questions, elaborated.answers):
        _check_answer(clauses, question, elaborated.steps, answer)


def _rows(data: bytes) -> list[list[int]]:
    """Rows of literals, each ended by a zero: a byte is a literal of one of 15 variables."""
    rows: list[list[int]] = [[]]
    for byte in data:
        literal = byte % 16 * (-1 if byte & 16 else 1)
        if literal:
            rows[-1].append(literal)
        else:
            rows.append([])
    return [row for row in rows if row]


def _check_answer(clauses: Clauses, question: Sequence[int], made: Sequence[ProofStep], answer: Answer) -> None:
    """Check one answer by LRAT: with the literals of the question as clauses, there is no model."""
    units = list(dict.fromkeys(question))
    # The checker refuses clauses that name a literal twice.
    formula = [*(list(dict.fromkeys(clause)) for clause in clauses), *([unit] for unit in units)]

    def numbered(hints: Sequence[int]) -> list[int]:
        # LRAT counts from 1, and the units stand before the steps.
        return [hint + 1 + (len(units) if hint >= len(clauses) else 0) for hint in hints]

    steps = [(*step.literals, 0, *numbered(step.hints), 0) for step in made]
    assumed = [len(clauses) + 1 + units.index(literal) for literal in answer.literals]
    steps.append((0, *assumed, *numbered(answer.hints), 0))
    rows = [" ".join(map(str, (number, *step))) for number, step in enumerate(steps, len(formula) + 1)]
    header = f"p cnf 15 {len(formula)}\n"
    lrat.check(header + "".join(" ".join(map(str, (*row, 0))) + "\n" for row in formula), "\n".join(rows) + "\n")


def elaboration_seeds() -> Iterator[bytes]:
    yield bytes([1, 2, 0, 1, 18, 0, 17, 2, 0, 17, 18, 0, 255, 1, 0, 255, 1, 0])
    yield bytes([1, 2, 0, 17, 3, 0, 18, 3, 0, 255, 19, 0, 1, 18, 0, 255, 3, 0])
    # More assumptions than variables.
    yield bytes([1, 2, 0, 17, 3, 0, 18, 3, 0, 255, 237, 237, 38, 38])
