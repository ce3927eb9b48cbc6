"""The checker that is proved in Coq and the one in Python say the same, and neither accepts what has a model."""

from __future__ import annotations

import random
import subprocess
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from sleec_verify.certificates import lrat
from sleec_verify.certificates.checker import BUILT, IN_PYTHON, checker
from sleec_verify.certificates.recorder import RecordedQuestion
from sleec_verify.certificates.refutation import Disjunction
from sleec_verify.encoding.elaboration import InvalidLemma
from tests.support.coq import require_coq
from tests.support.formulas import asked, clauses, has_model

FORMULA = "p cnf 2 4\n1 2 0\n-1 2 0\n1 -2 0\n-1 -2 0\n"
PROOF = "5 2 0 1 2 0\n5 d 1 2 0\n6 0 5 3 4 0\n"


def in_python(formula: str, proof: str) -> bool:
    try:
        lrat.check(formula, proof)
    except lrat.InvalidProof:
        return False
    return True


class Proved:
    """The extracted checker, on texts."""

    def __init__(self, program: Path, folder: Path) -> None:
        self._program = program
        self._formula, self._proof = folder / "formula.cnf", folder / "proof.lrat"

    def __call__(self, formula: str, proof: str) -> bool:
        self._formula.write_text(formula)
        self._proof.write_text(proof)
        done = subprocess.run([self._program, self._formula, self._proof], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stdout.split(":")[0].strip()) in (
            (0, "VERIFIED"),
            (1, "REFUSED"),
            (2, "UNREADABLE"),
        )
        return done.returncode == 0


@pytest.fixture(scope="module")
def by_coq(proved: Path, tmp_path_factory: pytest.TempPathFactory) -> Proved:
    return Proved(proved, tmp_path_factory.mktemp("judged"))


def mutated(text: str, draw: random.Random) -> str:
    """A line dropped, doubled, moved, cut, or a number in it changed."""
    lines = text.splitlines(keepends=True)
    place = draw.randrange(len(lines))
    kind = draw.randrange(5)
    if kind == 0:
        del lines[place]
    elif kind == 1:
        lines.insert(draw.randrange(len(lines)), lines[place])
    elif kind == 2:
        lines.append(lines.pop(place))
    elif kind == 3:
        return text[: draw.randrange(len(text))]
    else:
        words = lines[place].split()
        at = draw.randrange(len(words))
        words[at] = draw.choice((str(draw.randint(-9, 30)), "0", "x", words[at] + "1", "-" + words[at]))
        lines[place] = " ".join(words) + "\n"
    return "".join(lines)


@pytest.mark.slow
@given(all_asked=asked(), seed=st.integers(0, 10**6))
@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
def test_mutated_proofs_are_judged_alike(by_coq: Proved, all_asked: list[RecordedQuestion], seed: int) -> None:
    draw = random.Random(seed)
    formula = Disjunction(all_asked)
    try:
        text, proof = formula.dimacs("a test"), formula.lrat()
    except InvalidLemma:
        return
    assert by_coq(text, proof)
    assert in_python(text, proof)
    for _ in range(3):
        other = mutated(proof, draw)
        assert by_coq(text, other) == in_python(text, other), other


@given(refuted=clauses(), fewer=st.integers(1, 3), seed=st.integers(0, 10**6))
@settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
def test_no_proof_of_what_has_a_model_is_accepted(
    by_coq: Proved, refuted: list[list[int]], fewer: int, seed: int
) -> None:
    """Proofs of a formula, whole and mutated, given for a part of it."""
    draw = random.Random(seed)
    if has_model(refuted):
        return
    formula = Disjunction([RecordedQuestion(refuted, {(): ""})])
    part = list(formula.clauses)
    for _ in range(fewer):
        part.pop(draw.randrange(len(part)))
    rows = (" ".join(map(str, (*clause, 0))) + "\n" for clause in part)
    text = f"p cnf {formula.variables} {len(part)}\n{''.join(rows)}"
    modelled = has_model(part, formula.variables)
    # The last one knows the numbers of the clauses, and may well be one.
    for proof in (formula.lrat(), mutated(formula.lrat(), draw), _renumbered(formula, part)):
        accepted = by_coq(text, proof)
        assert accepted == in_python(text, proof)
        assert not (accepted and modelled)


def _renumbered(formula: Disjunction, part: list[tuple[int, ...]]) -> str:
    """The proof with the numbers that the clauses have in a part of the formula, hints at others left out."""
    places = {clause: str(place) for place, clause in enumerate(part, 1)}
    numbers = {str(n): places[clause] for n, clause in enumerate(formula.clauses, 1) if clause in places}
    rows = []
    for line in formula.lrat().splitlines():
        words = line.split()
        zero = words.index("0")
        numbers[words[0]] = words[0]
        rows.append(" ".join((*words[: zero + 1], *(numbers[h] for h in words[zero + 1 : -1] if h in numbers), "0")))
    return "\n".join(rows) + "\n"


REFUSED = {
    "the proof ends before the empty clause": ("5 2 0 1 2 0\n", FORMULA),
    "empty proof": ("", FORMULA),
    "a hint that is satisfied": ("5 2 0 1 1 2 0\n6 0 5 3 4 0\n", FORMULA),
    "a hint that leaves a choice": ("5 0 1 2 0\n", FORMULA),
    "a hint at no clause": ("5 2 0 1 9 0\n6 0 5 3 4 0\n", FORMULA),
    "a hint at a forgotten clause": ("5 2 0 1 2 0\n5 d 3 0\n6 0 5 3 4 0\n", FORMULA),
    "a step from nothing": ("5 0 0\n", FORMULA),
    "a RAT step": ("5 2 0 -1 2 0\n", FORMULA),
    "no number": ("5 2 0 1 two 0\n", FORMULA),
    "a number in another notation": ("5 2 0 0x1 2 0\n6 0 5 3 4 0\n", FORMULA),
    "a number too large": ("5 2 0 1 99999999999999999999 0\n", FORMULA),
    "a number in other digits": ("5 2 0 1 \u0662 0\n6 0 5 3 4 0\n", FORMULA),
    "bytes that are no text": ("\x00\x01\x7f\n" * 100, FORMULA),
    "a formula that is no text": (PROOF, "\x00\x01\x7f\n" * 100),
    "more variables than there can be": (PROOF, FORMULA.replace("cnf 2", "cnf 9" + "0" * 30)),
    "a step cut short": ("5 2 0 1 2\n", FORMULA),
    "a step of one number": ("5\n", FORMULA),
    "something behind a step": ("5 2 0 1 2 0 7\n6 0 5 3 4 0\n", FORMULA),
    "no header": (PROOF, FORMULA.split("\n", 1)[1]),
    "two headers": (PROOF, "p cnf 2 4\n" + FORMULA),
    "another header": (PROOF, FORMULA.replace("cnf", "dnf")),
    "a clause less than the header says": (PROOF, FORMULA.replace("2 4", "2 5")),
    "a clause more than the header says": (PROOF, FORMULA.replace("2 4", "2 3")),
    "a variable more than the header says": (PROOF, FORMULA.replace("cnf 2", "cnf 1")),
    "a clause without its end": (PROOF, FORMULA[:-3] + "\n"),
    "two clauses in a line": (PROOF, FORMULA.replace("2 0\n-1", "2 0 -1", 1)),
    "a clause with more behind its end": (PROOF, FORMULA.replace("1 -2 0", "1 -2 0 1")),
    "no formula": (PROOF, ""),
}


def test_both_accept_a_proof(by_coq: Proved) -> None:
    for formula in (FORMULA, "c a comment\n\n" + FORMULA, FORMULA.replace("\n", "\r\n")):
        assert in_python(formula, PROOF)
        assert by_coq(formula, PROOF)


@pytest.mark.parametrize("name", REFUSED)
def test_python_refuses(name: str) -> None:
    proof, formula = REFUSED[name]
    assert in_python(FORMULA, PROOF)
    assert not in_python(formula, proof)


@pytest.mark.parametrize("name", REFUSED)
def test_coq_refuses(name: str, by_coq: Proved) -> None:
    proof, formula = REFUSED[name]
    assert not by_coq(formula, proof)


def test_these_tests_are_skipped_without_coq_but_never_in_ci(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shutil.which", lambda name: None)
    monkeypatch.delenv("CI", raising=False)
    with pytest.raises(pytest.skip.Exception, match="apt-get install coq"):
        require_coq("the proved checker")
    monkeypatch.setenv("CI", "true")
    with pytest.raises(pytest.fail.Exception, match="apt-get install coq"):
        require_coq("the proved checker")


def test_usage(proved: Path, tmp_path: Path) -> None:
    assert subprocess.run([proved], capture_output=True, check=False).returncode == 2
    done = subprocess.run([proved, tmp_path / "no", tmp_path / "no"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.split(":")[0]) == (2, "UNREADABLE")


def test_the_build_fails_where_something_is_not_proved(proved: Path, tmp_path: Path) -> None:
    for source in (*proved.parent.glob("*.v"), proved.parent / "Makefile", proved.parent / "main.ml"):
        text = source.read_text()
        if source.name == "Soundness.v":
            lines = text.split("\n")
            end = len(lines) - 1 - lines[::-1].index("Qed.")
            text = "\n".join((*lines[:end], "Admitted.", *lines[end + 1 :]))
        (tmp_path / source.name).write_text(text)
    built = subprocess.run(["make", "-C", tmp_path, "assumptions.txt"], capture_output=True, text=True, check=False)
    assert built.returncode != 0
    assert "check_sound rests on what is not proved" in built.stdout


def test_the_proved_checker_is_taken_where_it_is_built(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("sleec_verify.certificates.checker.BUILT", tmp_path / "none")
    assert not checker().proved
    built = tmp_path / "check-lrat"
    built.write_text("#!/bin/sh\necho VERIFIED\n")
    built.chmod(0o755)
    monkeypatch.setattr("sleec_verify.certificates.checker.BUILT", built)
    assert checker().proved
    assert BUILT.name == built.name
    assert checker().refuses(b"", b"") is None


@pytest.mark.parametrize(
    ("script", "reason"),
    [
        ("echo REFUSED: no good; exit 1", "no good"),
        ("echo VERIFIED; exit 3", "the checker exited with 3 and without a verdict"),
        ("echo VERIFIED twice", "the checker exited with 0 and without a verdict"),
        ("kill -9 $$", "the checker exited with -9 and without a verdict"),
    ],
)
def test_only_a_clean_verdict_counts(script: str, reason: str, tmp_path: Path) -> None:
    program = tmp_path / "program"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    assert checker(str(program)).refuses(b"", b"") == reason


@pytest.mark.parametrize("program", [None, "exec sleep 60"])
def test_a_checker_has_so_much_time(program: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    judge = IN_PYTHON
    if program is not None:
        path = tmp_path / "program"
        path.write_text(f"#!/bin/sh\n{program}\n")
        path.chmod(0o755)
        judge = checker(str(path))
    monkeypatch.setattr("sleec_verify.certificates.checker.MOST_SECONDS", 0.0)
    assert judge.refuses(FORMULA.encode(), PROOF.encode()) == "it was not checked within 0 s"


def test_a_checker_judges_the_bytes_that_it_is_given(tmp_path: Path) -> None:
    """Whatever becomes of the folder that they come from."""
    program = tmp_path / "program"
    program.write_text('#!/bin/sh\ncat "$1" "$2" > "$0.out"\necho VERIFIED\n')
    program.chmod(0o755)
    assert checker(str(program)).refuses(b"formula\n", b"proof\n") is None
    assert (tmp_path / "program.out").read_bytes() == b"formula\nproof\n"


def test_long_steps_are_judged_in_linear_time() -> None:
    """A step of 2 MB, which a word at a time is nothing, and by comparing each with each would take hours."""
    for proof in (f"5 2 0 {'1 ' * 1_000_000}0\n", f"5 {'2 ' * 1_000_000}0 1 2 0\n", f"5 d {'1 ' * 1_000_000}0\n"):
        assert not in_python(FORMULA, proof)
