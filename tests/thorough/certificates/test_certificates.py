"""What a certificate says, and that it holds of the rules that it was made of."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings

from benchmarks.random_rules import random_rules
from sleec_runtime.certificate.coverage import Use
from sleec_runtime.language import load, parse, print_ruleset
from sleec_runtime.model import Ruleset
from sleec_verify.certificates.certification import Certificate, certify
from sleec_verify.certificates.checker import IN_PYTHON, checker
from sleec_verify.certificates.conflict_freedom import conflict_free
from sleec_verify.certificates.directory import write_folder
from sleec_verify.certificates.verification import check_certificate
from sleec_verify.checks import run_checks
from sleec_verify.checks.conflict import CONFLICT
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Proved
from tests.support.paths import ROOT
from tests.support.small_rulesets import small_rulesets
from tests.support.strategies import rulesets
from tests.support.timed_strategies import timed_ruleset

RULESETS = sorted((ROOT / "rulesets").glob("*.sleec"))

CONSTRAINED = """
ASSUME Asleep OR Awake
ASSUME NOT (Asleep AND Awake)
DOMAIN night
NEVER Sing AND Dance AND Lie
EXCLUSIVE Sing, Whisper
MEASURE Age: integer
MEASURE Size: integer
RULE a WHEN A THEN Sing UNLESS Asleep IN WHICH CASE Whisper
RULE b WHEN A THEN Dance UNLESS Asleep IN WHICH CASE NOT Sing
RULE c WHEN A AND Age > Size AND Size > 3 AND Age < 5 THEN Lie
RULE d WHEN B AND Asleep THEN Lie UNLESS Awake AND Asleep IN WHICH CASE Whisper
DOMAIN day
RULE e WHEN A AND Asleep AND Awake THEN NOT Sing
RULE f WHEN A THEN Sing UNLESS Asleep IN WHICH CASE Sing
RULE g WHEN C THEN Hum UNLESS Asleep IN WHICH CASE Sing UNLESS Awake IN WHICH CASE Rest
"""


def written(ruleset: Ruleset, folder: Path, made: Certificate | None = None) -> dict[str, Any]:
    """The manifest of a ruleset's certificate, written to a folder."""
    made = made or certify(ruleset)
    write_folder(str(folder), made.contents(), force=True)
    manifest: dict[str, Any] = json.loads((folder / "manifest.json").read_text())
    return manifest


def of(manifest: dict[str, Any], name: str) -> tuple[str, str]:
    """The verdict of a check, and what shows it."""
    (check,) = (check for check in manifest["checks"] if check["name"] == name)
    return check["verdict"], check["evidence"]


def source(text: str, folder: Path) -> Ruleset:
    path = folder / "rules.sleec"
    path.write_text(text, encoding="utf-8")
    return load(path)


@pytest.mark.parametrize("path", RULESETS, ids=lambda path: path.stem)
def test_certificates_of_the_shipped_rulesets_hold(path: Path, tmp_path: Path) -> None:
    ruleset = load(path)
    manifest = written(ruleset, tmp_path / "c")
    confirmed = check_certificate(ruleset, str(tmp_path / "c"), IN_PYTHON)
    assert [one.result.name for one in confirmed.shown] == [check["name"] for check in manifest["checks"]]


@pytest.mark.parametrize("path", RULESETS, ids=lambda path: path.stem)
def test_the_verdicts_are_those_of_check(path: Path) -> None:
    ruleset = load(path)
    here, there = certify(ruleset).results, run_checks(ruleset)
    assert [(r.name, r.verdict, r.reason) for r in here] == [(r.name, r.verdict, r.reason) for r in there]


def test_the_checker_that_is_proved_accepts_them(proved: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.certificates.checker.BUILT", proved)
    for number, path in enumerate(RULESETS):
        ruleset = load(path)
        written(ruleset, tmp_path / str(number))
        confirmed = check_certificate(ruleset, str(tmp_path / str(number)), checker())
        assert confirmed.checker.proved


def test_the_manifest(tmp_path: Path) -> None:
    ruleset = source(CONSTRAINED, tmp_path)
    manifest = written(ruleset, tmp_path / "c")
    assert manifest["certificate"] == "sleec-verify"
    assert manifest["format"] == 3
    assert manifest["ruleset"] == {
        "sha256": hashlib.sha256(CONSTRAINED.encode()).hexdigest(),
        "syntax": "english",
        "rules": 7,
        "domains": ["night", "day"],
    }
    assert (manifest["reading"], manifest["domain"]) == ("cascade", None)
    assert (manifest["untimed"], manifest["chains"]) == (None, True)
    assert of(manifest, "conflict") == ("proved", "proof")
    assert manifest["checks"][0]["files"] == ["conflict.cnf", "conflict.lrat"]
    assert of(manifest, "dead-rule") == ("refuted", "proof")
    assert of(manifest, "duplicate-rule") == ("proved", "text")
    assert of(manifest, "assumptions") == ("proved", "situations")
    names = {path.name for path in (tmp_path / "c").iterdir()} - {"manifest.json"}
    assert set(manifest["files"]) == names
    for name, digest in manifest["files"].items():
        assert hashlib.sha256((tmp_path / "c" / name).read_bytes()).hexdigest() == digest
    check_certificate(ruleset, str(tmp_path / "c"), IN_PYTHON)


def test_a_certificate_of_one_domain_and_of_another_reading(tmp_path: Path) -> None:
    ruleset = source(CONSTRAINED, tmp_path).read_as("priority")
    manifest = written(ruleset, tmp_path / "c", certify(ruleset, "day"))
    assert (manifest["reading"], manifest["domain"]) == ("priority", "day")
    confirmed = check_certificate(
        load(tmp_path / "rules.sleec"), str(tmp_path / "c"), IN_PYTHON, Use("priority", "day")
    )
    assert confirmed.ruleset.reading == "priority"


def test_assumptions_that_rule_out_everything_are_shown_by_a_proof(tmp_path: Path) -> None:
    ruleset = source("ASSUME Day\nASSUME NOT Day\nRULE a WHEN A THEN B\nRULE b WHEN A THEN NOT B\n", tmp_path)
    manifest = written(ruleset, tmp_path / "c")
    assert of(manifest, "conflict") == ("proved", "proof")
    assert of(manifest, "assumptions") == ("refuted", "proof")
    check_certificate(ruleset, str(tmp_path / "c"), IN_PYTHON)


def test_an_unknown_verdict_is_listed_as_such(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.query.prime_implicates.STEPS", 0)
    ruleset = source("NEVER A AND NOT B\nNEVER B AND C\nRULE a WHEN T THEN A AND C\n", tmp_path)
    manifest = written(ruleset, tmp_path / "c")
    conflict = manifest["checks"][0]
    assert (conflict["verdict"], conflict["evidence"], conflict["files"]) == ("unknown", "none", [])
    assert "too many combinations" in conflict["reason"]
    check_certificate(ruleset, str(tmp_path / "c"), IN_PYTHON)


def print_digests() -> None:
    """For another process."""
    texts = [CONSTRAINED, random_rules(60, names_per_rule=0.3), random_rules(40, seed=3, names_per_rule=0.1)]
    for ruleset in (*map(parse, texts), *map(timed_ruleset, (0, 1, 2, 4, 5, 6))):
        for name, data in certify(ruleset).contents():
            sys.stdout.write(f"{name} {hashlib.sha256(data).hexdigest()}\n")


@pytest.mark.slow
def test_the_same_rules_give_the_same_bytes() -> None:
    """Whatever order Python's sets have in a process."""

    def printed(seed: str) -> str:
        code = "from tests.thorough.certificates.test_certificates import print_digests; print_digests()"
        environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(ROOT)}
        command = [sys.executable, "-c", code]
        return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT, env=environment).stdout

    first, *others = (printed(seed) for seed in "012")
    assert others == [first, first]


@pytest.mark.slow
@given(small_rulesets(measures=True))
@settings(max_examples=80)
def test_one_formula_for_all_says_what_the_causes_say(ruleset: Ruleset) -> None:
    index = RulesetIndex(ruleset)
    assert conflict_free(index) == (not list(CONFLICT.run(index)))


@pytest.mark.slow
@given(rulesets())
@settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
def test_certificates_of_random_rulesets_hold(tmp_path: Path, ruleset: Ruleset) -> None:
    ruleset = source(print_ruleset(ruleset), tmp_path)
    written(ruleset, tmp_path / "c")
    check_certificate(ruleset, str(tmp_path / "c"), IN_PYTHON)


@pytest.mark.slow
@pytest.mark.parametrize("seed", sorted({*range(20)} - {3, 8, 9, 11}))  # these take long
def test_certificates_of_rulesets_with_times_hold(tmp_path: Path, seed: int) -> None:
    ruleset = source(timed_ruleset(seed).source.text, tmp_path)
    untimed: Untimed = "eventually" if seed % 2 else "at"
    manifest = written(ruleset, tmp_path / "c", certify(ruleset, untimed=untimed))
    assert (manifest["untimed"], manifest["chains"]) == (untimed, True)
    check_certificate(ruleset, str(tmp_path / "c"), IN_PYTHON, Use(ruleset.reading, untimed=untimed))
    for check in manifest["checks"]:
        if (check["name"], check["verdict"]) in (("conflict", "proved"), ("vacuous-conflict", "refuted")):
            assert check["evidence"] == ("proof" if check["refuted"] else "trivial"), check


@given(small_rulesets(measures=True))
@settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])
def test_a_formula_without_questions_is_no_proof(ruleset: Ruleset) -> None:
    """Evidence is a proof exactly if the formulas say more than the empty clause."""
    made = certify(ruleset)
    for one in made.shown:
        formulas = [made.files[name] for name in one.files if name.endswith(".cnf")]
        said = [line for text in formulas for line in text.splitlines() if not line.startswith("c ")]
        assert (one.evidence == "trivial") == (said == ["p cnf 0 1", "0"])
        assert (one.evidence == "proof") == (len(said) > 2)


def test_all_that_is_proved_by_search_has_a_proof() -> None:
    """What is said of every situation, and no situation shows, is refuted in a file."""
    for text in (CONSTRAINED, *(path.read_text(encoding="utf-8") for path in RULESETS)):
        for one in certify(parse(text)).shown:
            if one.result.name == "conflict" and isinstance(one.result.verdict, Proved):
                assert one.evidence == ("proof" if one.refuted else "trivial")
            unseen = [f for f in one.result.findings if f.witness is None and f.code in ("SLEEC201", "SLEEC202")]
            if unseen:
                assert one.refuted >= len(unseen)
