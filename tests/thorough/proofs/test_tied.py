"""The verdicts of the checks `conflict` and `reading`, tied to the rules by the theory: the oracle makes the formula
and judges its refutation."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

import sleec_runtime
from sleec_runtime.errors import CertificateRefused
from sleec_runtime.language import load, parse
from sleec_runtime.model import Ruleset
from sleec_verify.certificates import verdict_binding as tying
from sleec_verify.certificates.certification import certify
from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.directory import write_folder
from sleec_verify.certificates.theory import oracle as oracle_module
from sleec_verify.certificates.theory.boolean import Boolean
from sleec_verify.certificates.theory.numbering import Numbering
from sleec_verify.certificates.theory.oracle import NoAnswer, NotRefuted, Oracle, answers
from sleec_verify.certificates.theory.theory_questions import Theory, not_modelled
from sleec_verify.certificates.verdict_binding import VerdictBinding
from sleec_verify.certificates.verification import CheckedCertificate, check_certificate
from sleec_verify.checks import run_checks
from sleec_verify.cli import run
from sleec_verify.conformance.rulesets import rulesets
from sleec_verify.results.finding import Proved, Unknown
from tests.support.paths import ROOT
from tests.support.theory_cases import random_cases

pytestmark = pytest.mark.timeout(600)

RULESETS = ROOT / "rulesets"
RULES = "RULE a\nWHEN T THEN X\nUNLESS c IN WHICH CASE Y\nRULE b\nWHEN T AND c THEN NOT X\n"
CONFLICTING = "RULE a\nWHEN T THEN X\nRULE b\nWHEN T AND c THEN NOT X\n"


def prove(oracle: Path, ruleset: Ruleset, what: str) -> None:
    with Theory(oracle, ruleset) as theory:
        theory.prove(what)


def steps_for(oracle: Path, ruleset: Ruleset, what: str) -> list[str]:
    """The steps that refute the formula, as the oracle is told them."""
    with Theory(oracle, ruleset) as theory:
        return [
            f"a {number} {' '.join(map(str, (*literals, 0, *hints, 0)))}"
            for number, literals, hints in theory.steps_for(what)
        ]


def agree(oracle: Path, ruleset: Ruleset, what: str) -> bool:
    """Whether the check and the theory say the same of whether all is well; returns what."""
    verdict = run_checks(ruleset, [what], chains=False)[0].verdict
    assert not isinstance(verdict, Unknown)
    well = True
    for part in [ruleset.in_domain(domain) for domain in ruleset.domains] or [ruleset]:
        try:
            prove(oracle, part, what)
        except NotRefuted:
            well = False
    assert well == isinstance(verdict, Proved)
    return well


@pytest.mark.parametrize("what", ["conflict", "reading"])
def test_the_theory_and_the_check_find_the_same(oracle: Path, what: str) -> None:
    found = [agree(oracle, ruleset, what) for ruleset, _ in random_cases(7, 150, each=1)]
    assert 20 < sum(found) < 130


@pytest.mark.slow
@given(ruleset=rulesets())
@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
def test_with_measures_and_domains_too(oracle: Path, ruleset: Ruleset) -> None:
    if not_modelled(ruleset, chains=False) is None:
        for what in ("conflict", "reading"):
            agree(oracle, ruleset, what)


def test_no_step_is_believed(oracle: Path) -> None:
    """Steps of other rules, none, or too few prove nothing."""
    line = Numbering(Boolean(parse(RULES)).ruleset).line
    other = Numbering(Boolean(parse(CONFLICTING)).ruleset).line
    steps = steps_for(oracle, parse(RULES), "conflict")
    whole = f"refuted {' '.join(steps)}"
    wrong = [
        "refuted",
        f"refuted {' '.join(steps[:-1])}",
        "refuted a 99 0 1 0",
        f"{whole[:7]} d 1 0 {whole[8:]}",
    ]
    asked = [line, "formula conflict", whole, *wrong, other, "formula conflict", whole]
    said = answers(oracle, asked)
    assert said[2:7] == ["yes", "no", "no", "no", "no"]
    assert said[-1] == "no"
    # Other rules have no formula yet.
    with Oracle(oracle) as fresh:
        fresh.ask(line)
        fresh.ask("formula conflict")
        fresh.ask(other)
        with pytest.raises(NoAnswer, match="steps before a formula"):
            fresh.ask(whole)


def checked(folder: Path, rules: Path | str, oracle: Path | None) -> CheckedCertificate:
    """The certificate of a ruleset, checked. A text is written to a file first: certificates are of bytes."""
    path = rules if isinstance(rules, Path) else folder.with_suffix(".sleec")
    if isinstance(rules, str):
        path.write_text(rules, encoding="utf-8")
    ruleset = load(path)
    write_folder(str(folder), certify(ruleset).contents(), force=True)
    return check_certificate(ruleset, str(folder), IN_PYTHON, oracle=oracle)


@pytest.mark.parametrize(
    ("name", "checks"),
    [("household", ["conflict"]), ("care-robot", ["conflict"]), ("hospital-ward", ["conflict"])],
)
def test_shipped_rulesets_are_tied(oracle: Path, tmp_path: Path, name: str, checks: list[str]) -> None:
    tied = checked(tmp_path / "c", RULESETS / f"{name}.sleec", oracle).tied
    assert tied == tuple(VerdictBinding(check, True) for check in checks)


def test_a_text_without_a_reading_is_tied_in_both(oracle: Path, tmp_path: Path) -> None:
    text = (RULESETS / "hospital-ward.sleec").read_text(encoding="utf-8").replace("READING cascade\n", "")
    tied = checked(tmp_path / "c", text, oracle).tied
    assert tied == (VerdictBinding("conflict", True), VerdictBinding("reading", True))


def test_where_rules_conflict_a_situation_shows_it(oracle: Path, tmp_path: Path) -> None:
    """That one of them conflicts wherever it is triggered is something else."""
    assert checked(tmp_path / "c", CONFLICTING, oracle).tied == (VerdictBinding("vacuous-conflict", True),)


@pytest.mark.parametrize("what", ["conflict", "reading"])
def test_conditions_said_twice(oracle: Path, what: str) -> None:
    """Clauses come to say a literal twice, and are no units to the checker."""
    text = "RULE a\nWHEN T THEN X\nUNLESS c AND c IN WHICH CASE Y\nUNLESS c AND (d OR d) IN WHICH CASE Z\n"
    rules = text + "RULE b\nWHEN T AND (c OR c) AND (c AND c) THEN NOT X\n"
    clauses = answers(oracle, [Numbering(Boolean(parse(rules)).ruleset).line, "formula conflict"])[1].split(" 0 ")
    assert any(len(set(clause.split())) < len(clause.split()) for clause in clauses)
    assert agree(oracle, parse(rules), what)


@pytest.mark.parametrize("what", ["conflict", "reading"])
def test_assumptions_that_nothing_satisfies(oracle: Path, what: str) -> None:
    rules = CONFLICTING + "UNLESS d IN WHICH CASE X\nUNLESS e IN WHICH CASE Y\n"
    prove(oracle, parse(f"{rules}ASSUME c\nASSUME NOT c\n"), what)
    with pytest.raises(NotRefuted):
        prove(oracle, parse(f"{rules}ASSUME c\n"), what)


READ_ALIKE = """
ASSUME NOT (d AND NOT c)
RULE a
WHEN T THEN X
UNLESS c IN WHICH CASE (Y UNLESS e IN WHICH CASE Z)
UNLESS d IN WHICH CASE Z
"""


def test_the_reading_is_tied_with_assumptions_and_chains_in_chains(oracle: Path) -> None:
    assert agree(oracle, parse(READ_ALIKE), "reading")
    assert not agree(oracle, parse(READ_ALIKE.replace("ASSUME NOT (d AND NOT c)\n", "")), "reading")
    # Steps for the one formula are none for the other.
    line = Numbering(Boolean(parse(READ_ALIKE)).ruleset).line
    steps = f"refuted {' '.join(steps_for(oracle, parse(READ_ALIKE), 'reading'))}"
    said = answers(oracle, [line, "formula reading", steps, "formula conflict", steps, "formula reading", steps])
    assert said[2::2] == ["yes", "no", "yes"]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("WHEN T THEN X WITHIN 5 minutes\n", "the theory covers neither time"),
        (
            "MEASURE A: integer\nMEASURE B: integer\nWHEN T THEN X\nUNLESS A < B IN WHICH CASE Y\n",
            r"whole numbers.*A, B",
        ),
    ],
)
def test_what_the_theory_does_not_speak_of_is_told(tmp_path: Path, text: str, reason: str) -> None:
    (tied,) = checked(tmp_path / "c", text, tmp_path / "never run").tied
    assert not tied.proved
    assert re.search(reason, tied.reason or "")


def program(folder: Path, body: str) -> Path:
    path = folder / "oracle"
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)
    return path


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("read a; echo ok", "exited with 0"),
        ("read a; echo UNREADABLE: why; exit 2", "UNREADABLE: why"),
        ("exec sleep 30", "did not answer in 0.2 s"),
    ],
)
def test_an_oracle_that_does_not_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, body: str, reason: str
) -> None:
    monkeypatch.setattr(tying, "MOST_SECONDS", 0.2)
    (tied,) = checked(tmp_path / "c", RULES, program(tmp_path, body)).tied
    assert not tied.proved
    assert reason in (tied.reason or "")


@pytest.mark.parametrize(
    "clauses",
    ["1 0", "1 0 -1 0"],  # with a model; without one, but the steps are not accepted
)
def test_a_verdict_that_is_not_proved_of_the_rules_is_refused(tmp_path: Path, clauses: str) -> None:
    body = (
        f'while read word rest; do case $word in rules) echo ok;; formula) echo "{clauses}";; *) echo no;; esac; done'
    )
    with pytest.raises(CertificateRefused) as refusal:
        checked(tmp_path / "c", RULES, program(tmp_path, body))
    assert [reason for reason, _ in refusal.value.problems] == ["theory"]


@pytest.mark.parametrize("body", ["exec sleep 30", "exec yes"])
def test_lines_longer_than_a_pipe_holds(tmp_path: Path, body: str) -> None:
    """Whether it does not read what it is told, or does not wait for it: it is not waited for in vain."""
    with Oracle(program(tmp_path, body), 0.3) as oracle, pytest.raises(NoAnswer, match=r"did not answer in 0\.3 s"):
        oracle.ask("at " * 1_000_000)


def test_an_oracle_that_is_no_program(tmp_path: Path) -> None:
    with pytest.raises(NoAnswer, match="cannot be run"):
        answers(tmp_path / "nowhere", ["at 0"])


def test_the_command_says_so(
    oracle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    rules, folder = str(RULESETS / "household.sleec"), str(tmp_path / "c")

    def called(*arguments: str) -> str:
        assert run(["certify", *arguments]) == 0
        return capsys.readouterr().out

    assert "in Coq" not in called(rules, "-o", folder)
    assert "conflict: proved for the parsed rules" in called("--check", folder, rules)
    told = json.loads(called("--check", folder, rules, "--format", "json"))
    assert told["theory"] == {"conflict": {"proved": True, "reason": None}}
    monkeypatch.setattr(oracle_module, "BUILT", tmp_path / "nowhere")
    assert "the oracle is not built (make proofs)" in called("--check", folder, rules)


def test_rules_tied_to_their_certificate_can_be_required(oracle: Path, tmp_path: Path) -> None:
    rules, folder = str(RULESETS / "household.sleec"), str(tmp_path / "c")
    assert run(["certify", rules, "-o", folder, "--require-tied"]) == 0
    assert run(["certify", "--check", folder, rules]) == 0
    sleec_runtime.load(rules, certificate=folder, require_tied=True)
