"""What is required of a certificate: that a proved checker judges it, and that its verdicts are tied to the rules."""

from __future__ import annotations

import itertools
import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import sleec_runtime
from sleec_runtime.certificate.manifest import Required
from sleec_runtime.errors import CertificateRefused, SleecError, WrongType
from sleec_verify.certificates.certification import certify
from sleec_verify.certificates.checker import checker
from sleec_verify.certificates.theory.oracle import built
from sleec_verify.certificates.verification import check_certificate
from tests.support.cli import Cli
from tests.support.repository import Repository
from tests.thorough.certificates.test_certificates import source, written

RULES = "RULE a WHEN A THEN X UNLESS C IN WHICH CASE Y\nRULE b WHEN A AND C THEN NOT X\n"
TIMED = "RULE a WHEN A THEN X WITHIN 5 seconds\n"
REQUIREMENTS = [Required(*choice) for choice in itertools.product((False, True), repeat=2)]
Build = Callable[[bool, bool], None]


@pytest.fixture
def build(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Build:
    """Has the programs of `proofs/` built, or not: stand-ins that accept everything."""
    judge, oracle = tmp_path / "bin" / "check-lrat", tmp_path / "bin" / "oracle"
    judge.parent.mkdir()
    judge.write_text("#!/bin/sh\necho VERIFIED\n")
    answers = "rules) echo ok;; formula) echo 0;; *) echo yes;;"
    oracle.write_text(f"#!/bin/sh\nwhile read word rest; do case $word in {answers} esac; done\n")
    for path in (judge, oracle):
        path.chmod(0o755)

    def choose(proved: bool, tied: bool) -> None:
        monkeypatch.setattr("sleec_verify.certificates.checker.BUILT", judge if proved else tmp_path / "none")
        monkeypatch.setattr("sleec_verify.certificates.theory.oracle.BUILT", oracle if tied else tmp_path / "none")

    return choose


def unmet(required: Required, proved: bool, tied: bool) -> set[str]:
    """The reasons to refuse, with these programs built."""
    reasons = {"not-proved": required.proved and not proved, "not-tied": required.tied and not tied}
    found = {reason for reason, holds in reasons.items() if holds}
    # What is tied is not looked at where something else is wrong.
    return found - {"not-tied"} if "not-proved" in found else found


@pytest.mark.parametrize("made", REQUIREMENTS, ids=str)
def test_check_requires_what_is_asked_and_what_was(build: Build, tmp_path: Path, made: Required) -> None:
    ruleset = source(RULES, tmp_path)
    written(ruleset, tmp_path / "c", certify(ruleset, required=made))
    for asked, proved, tied in itertools.product(REQUIREMENTS, (False, True), (False, True)):
        build(proved, tied)
        expected = unmet(Required(made.proved or asked.proved, made.tied or asked.tied), proved, tied)
        reasons, hint = set(), "builds what is missing"
        try:
            check_certificate(ruleset, str(tmp_path / "c"), checker(), None, asked, oracle=built())
        except CertificateRefused as refusal:
            reasons, hint = {reason for reason, _ in refusal.problems}, str(refusal.hint)
        assert reasons == expected, (asked, proved, tied)
        assert "builds what is missing" in hint


@pytest.mark.parametrize("made", REQUIREMENTS, ids=str)
def test_load_requires_that_it_was_made_so(tmp_path: Path, made: Required) -> None:
    ruleset = source(RULES, tmp_path)
    written(ruleset, tmp_path / "c", certify(ruleset, required=made))
    for proved, tied in REQUIREMENTS:
        expected = {"not-proved"} if proved and not made.proved else set()
        expected |= {"not-tied"} if tied and not made.tied else set()
        reasons = set()
        try:
            sleec_runtime.load(
                tmp_path / "rules.sleec", certificate=tmp_path / "c", require_proved=proved, require_tied=tied
            )
        except CertificateRefused as refusal:
            reasons = {reason for reason, _ in refusal.problems}
        assert reasons == expected, (proved, tied)


def test_rules_that_come_later_need_the_same(tmp_path: Path) -> None:
    ruleset = source(RULES, tmp_path)
    for name, required in (("weak", Required()), ("strong", Required(tied=True))):
        written(ruleset, tmp_path / name, certify(ruleset, required=required))
    sleec = sleec_runtime.load(tmp_path / "rules.sleec", certificate=tmp_path / "strong", require_tied=True)
    with pytest.raises(CertificateRefused, match="made without --require-tied"):
        sleec.replace(ruleset, certificate=tmp_path / "weak")
    sleec.replace(ruleset, certificate=tmp_path / "strong")


def test_nothing_is_required_of_nothing(tmp_path: Path) -> None:
    ruleset = source(RULES, tmp_path)
    for name in ("require_proved", "require_tied"):
        for value, error in ((True, SleecError), ("yes", WrongType)):
            options: dict[str, Any] = {name: value}
            with pytest.raises(error, match=name):
                sleec_runtime.Sleec(ruleset, **options)


FLAGS = {"--require-proved": Required(proved=True), "--require-tied": Required(tied=True)}


@pytest.mark.parametrize("flag", FLAGS)
@pytest.mark.parametrize("command", [("certify", "-o"), ("check", "--certify")], ids=" ".join)
def test_nothing_is_written_unless_it_is_so(cli: Cli, build: Build, flag: str, command: tuple[str, str]) -> None:
    required = FLAGS[flag]
    build(not required.proved, not required.tied)
    name, option = command
    ran = cli(name, "rules.sleec", option, "c", flag, files={"rules.sleec": RULES})
    assert (ran.code, "builds what is missing" in ran.err) == (2, True)
    assert not Path("c").exists()
    build(required.proved, required.tied)
    assert cli(name, "rules.sleec", option, "c", flag).code == 0
    stated = json.loads(Path("c/manifest.json").read_text())["required"]
    assert stated == required._asdict()
    checked = cli("certify", "--check", "c", "rules.sleec")
    assert checked.code == 0
    assert f"; required: {flag.removeprefix('--require-')})" in checked.out
    build(not required.proved, not required.tied)
    assert cli("certify", "--check", "c", "rules.sleec").code == 2


def test_a_certificate_that_is_there_stays(cli: Cli, build: Build) -> None:
    build(False, False)
    assert cli("certify", "rules.sleec", "-o", "c", files={"rules.sleec": RULES}).code == 0
    before = Path("c/manifest.json").read_bytes()
    assert cli("certify", "rules.sleec", "-o", "c", "--force", "--require-proved").code == 2
    assert Path("c/manifest.json").read_bytes() == before


@pytest.mark.parametrize("flag", FLAGS)
def test_check_can_require_what_was_not(cli: Cli, build: Build, flag: str) -> None:
    cli("certify", "rules.sleec", "-o", "c", files={"rules.sleec": RULES})
    build(False, False)
    assert cli("certify", "--check", "c", "rules.sleec").code == 0
    ran = cli("certify", "--check", "c", "rules.sleec", flag, "--format", "json")
    (problem,) = json.loads(ran.out)["problems"]
    assert (ran.code, problem["reason"]) == (2, f"not-{flag.removeprefix('--require-')}")
    build(True, True)
    assert cli("certify", "--check", "c", "rules.sleec", flag).code == 0


def test_another_program_is_not_the_proved_checker(cli: Cli, build: Build, tmp_path: Path) -> None:
    build(True, True)
    shutil.copy(tmp_path / "bin" / "check-lrat", tmp_path / "bin" / "other")
    cli("certify", "rules.sleec", "-o", "c", files={"rules.sleec": RULES})
    ran = cli(
        "certify", "--check", "c", "rules.sleec", "--require-proved", "--checker", str(tmp_path / "bin" / "other")
    )
    assert (ran.code, "which is not proved correct" in ran.err) == (2, True)


def test_what_the_theory_does_not_speak_of_is_not_tied(cli: Cli, build: Build) -> None:
    build(True, True)
    ran = cli("certify", "rules.sleec", "-o", "c", "--require-tied", files={"rules.sleec": TIMED})
    assert (ran.code, "the theory covers neither time" in ran.err) == (2, True)
    assert cli("certify", "rules.sleec", "-o", "c", "--require-proved").code == 0


def test_a_conflict_over_time_is_not_tied(cli: Cli, build: Build) -> None:
    build(True, True)
    rules = "WHEN a THEN b WITHIN 5 minutes\nWHEN c THEN NOT b WITHIN 5 minutes\n"
    ran = cli("certify", "rules.sleec", "-o", "c", "--require-tied", files={"rules.sleec": rules})
    assert (ran.code, "the verdict of conflict is not proved for the rules: that no response complies" in ran.err) == (
        2,
        True,
    )


def test_check_requires_something_of_a_certificate_only(cli: Cli) -> None:
    ran = cli("check", "rules.sleec", "--require-tied", files={"rules.sleec": RULES})
    assert (ran.code, "need --certify DIR" in ran.err) == (2, True)


SETTINGS = [(f"{flag.removeprefix('--')} = true", ()) for flag in FLAGS] + [("", (flag,)) for flag in FLAGS]
"""The ways to require something of the gate: in the configuration, and on the command line."""


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
@pytest.mark.parametrize(("block", "flags"), SETTINGS)
def test_the_gate_can_require_it(cli: Cli, build: Build, tmp_path: Path, block: str, flags: tuple[str, ...]) -> None:
    repository = Repository(tmp_path)
    repository.commit(a_sleec=RULES + "RULE c WHEN B THEN Y\n")
    repository.put("sleec-verify.toml", f"base = 'main'\n[block]\n{block}\n")
    repository.keep("sleec-verify.toml")
    repository.write(a_sleec=RULES)

    def gated() -> tuple[int, str]:
        ran = cli("gate", *flags, "--format", "json")
        return ran.code, " ".join(
            one["what"] for one in json.loads(ran.out)["blocks"] if one["policy"] == "certificates"
        )

    build(True, True)
    # Whoever requires something of certificates asks for one.
    assert "the certificate a.certificate is missing" in gated()[1]
    cli("certify", "a.sleec", "-o", "a.certificate")
    assert gated() == (0, "")
    build(False, False)
    code, what = gated()
    assert code == 1
    assert "is not proved correct" in what or "is not proved for the rules" in what
