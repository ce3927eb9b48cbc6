"""A runtime that demands a certificate sets to work only what it is of."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

import sleec_runtime
from sleec_runtime.errors import CertificateRefused, SleecError
from sleec_runtime.language import load, parse
from sleec_verify.cli import run
from tests.support.paths import ROOT

RULES = """
DOMAIN night
RULE a WHEN A THEN X UNLESS C IN WHICH CASE Y
DOMAIN day
RULE b WHEN A THEN NOT X UNLESS C IN WHICH CASE X
"""
CONFLICT = "RULE a WHEN A THEN X\nRULE b WHEN A THEN NOT X\n"


@pytest.fixture
def rules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "rules.sleec"
    path.write_text(RULES)
    assert run(["certify", "rules.sleec", "-o", "all"]) == 0
    assert run(["certify", "rules.sleec", "-o", "night", "--domain", "night"]) == 0
    assert run(["certify", "rules.sleec", "-o", "priority", "--reading", "priority"]) == 0
    return path


def reason(rules: Path, certificate: str, **options: str) -> str | None:
    try:
        sleec_runtime.load(rules, certificate=certificate, **options)  # type: ignore[arg-type]
    except CertificateRefused as refusal:
        ((found, _),) = refusal.problems
        return found if refusal.hint else "no hint"
    return None


def test_what_is_certified_is_set_to_work(rules: Path) -> None:
    assert sleec_runtime.load(rules, "night", certificate="all").domain == "night"
    assert reason(rules, "night", domain="night") is None
    assert reason(rules, "priority", domain="day", reading="priority") is None


def test_other_bytes(rules: Path) -> None:
    rules.write_text(RULES + "\n")
    assert reason(rules, "all", domain="night") == "ruleset-changed"


def test_another_domain(rules: Path) -> None:
    assert reason(rules, "night", domain="day") == "domain"
    assert reason(rules, "night") == "domain"
    # Each domain by itself is free of conflict; the two together are not.
    assert reason(rules, "all") == "domain"


def test_another_reading(rules: Path) -> None:
    assert reason(rules, "all", domain="night", reading="priority") == "reading"
    assert reason(rules, "priority", domain="night") == "reading"


def test_rules_that_conflict(rules: Path) -> None:
    rules.write_text(CONFLICT)
    assert run(["certify", "rules.sleec", "-o", "bad"]) == 1
    assert reason(rules, "bad") == "conflict"


def test_no_certificate(rules: Path) -> None:
    assert reason(rules, "nowhere", domain="night") == "no-certificate"


def refused(change: Callable[[], object]) -> str:
    with pytest.raises(CertificateRefused) as refusal:
        change()
    return refusal.value.problems[0][0]


def test_another_domain_later(rules: Path) -> None:
    sleec = sleec_runtime.load(rules, "night", certificate="all")
    sleec.implement({"X": print, "Y": print})
    sleec.enter_domain("day")
    assert refused(lambda: sleec.enter_domain(None)) == "domain"
    assert sleec.domain == "day"
    sleec = sleec_runtime.load(rules, "night", certificate="night")
    assert refused(lambda: sleec.enter_domain("day")) == "domain"
    assert sleec.domain == "night"


def test_other_rules_later(rules: Path) -> None:
    sleec = sleec_runtime.load(rules, "night", certificate="all")
    before = sleec.ruleset
    (rules.parent / "new.sleec").write_text("DOMAIN night\nRULE a WHEN A THEN Z\n")
    assert run(["certify", "new.sleec", "-o", "new"]) == 0
    new = load("new.sleec")
    for wrong in (None, "all", "nowhere"):
        assert refused(partial(sleec.replace, new, certificate=wrong)) in ("ruleset-changed", "no-certificate")
        assert sleec.ruleset is before
    assert refused(lambda: sleec.replace(parse("DOMAIN night\nRULE a WHEN A THEN Z"))) == "ruleset-changed"
    sleec.replace(new, certificate="new", implement={"Z": print})
    sleec.replace(new)
    assert refused(lambda: sleec.replace(load(rules))) == "ruleset-changed"


def test_a_key_needs_a_certificate(rules: Path) -> None:
    with pytest.raises(SleecError, match="key without a certificate"):
        sleec_runtime.load(rules, "night", key="key.pub")


def test_the_verifier_is_not_imported(rules: Path) -> None:
    load = f"sleec_runtime.load({str(rules)!r}, 'night', certificate={str(rules.parent / 'all')!r})"
    names = "{name.partition('.')[0] for name in sys.modules} & {'sleec_verify', 'pysolvers', 'cryptography'}"
    code = f"import sys, sleec_runtime; {load}; print(*{names})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.strip() == ""
