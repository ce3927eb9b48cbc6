"""The `certificates` policy of `gate`: a certificate counts if it covers the rules as they are checked."""

from __future__ import annotations

import itertools
import json
import shutil
from pathlib import Path

import pytest

from tests.support.cli import Cli
from tests.support.gates import GATE
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")

RULES = "DOMAIN day\nRULE a WHEN A THEN X WITHIN 5 seconds\nDOMAIN night\nRULE b WHEN A THEN Y\n"


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    made = Repository(tmp_path)
    made.commit(a_sleec=RULES + "RULE c WHEN B THEN Y\n")
    made.put("sleec-verify.toml", "base = 'main'\n[block]\ncertificates = true\n")
    made.keep("sleec-verify.toml")
    made.write(a_sleec=RULES)
    return made


@pytest.mark.parametrize("domain", [None, "day"])
@pytest.mark.parametrize("reading", [None, "priority"])
@pytest.mark.parametrize(("certified", "gated"), [("at", "at"), ("eventually", "at"), ("eventually", "eventually")])
def test_it_must_cover_the_whole_text_as_it_is_checked(
    cli: Cli, repository: Repository, domain: str | None, reading: str | None, certified: str, gated: str
) -> None:
    options = (("--domain", domain), ("--reading", reading), ("--untimed", certified))
    given = itertools.chain.from_iterable((name, value) for name, value in options if value is not None)
    assert cli("certify", "a.sleec", "-o", "a.certificate", *given).code == 0
    said = json.loads(cli("gate", "--untimed", gated, "--format", "json").out)
    GATE.validate(said)
    (ruleset,) = said["rulesets"]
    blocks = [(block["policy"], block["what"]) for block in said["blocks"]]
    expected = []
    if reading == "priority":
        expected.append("the certificate is for the reading priority, not for cascade")
    if domain is not None:
        expected.append("the certificate is for the domain day, not for each of the domains day, night")
    if certified != gated:
        expected.append(f"the certificate is for --untimed {certified}, not for {gated}")
    assert len(blocks) == bool(expected)
    assert (ruleset["certificate"] is None) == bool(expected)
    for policy, what in blocks:
        assert policy == "certificates"
        assert what.startswith("a.certificate is refused: ")
        assert all(words in what for words in expected)


def test_what_it_is_for_is_printed(cli: Cli, repository: Repository) -> None:
    assert cli("certify", "a.sleec", "-o", "a.certificate").code == 0
    words = "reading cascade; each of the domains day, night; untimed at; with chains"
    ran = cli("gate")
    assert (ran.code, f"a.sleec: certificate: valid ({words})\n" in ran.out) == (0, True)
    stated = json.loads(cli("gate", "--format", "json").out)["rulesets"][0]["certificate"]
    required = {"proved": False, "tied": False}
    assert stated == {"reading": "cascade", "domain": None, "untimed": "at", "chains": True, "required": required}
