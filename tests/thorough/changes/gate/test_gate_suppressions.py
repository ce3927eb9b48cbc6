"""Suppressions and baselines of `gate`."""

from __future__ import annotations

import json
import shutil

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.fingerprint import fingerprint
from tests.support.cli import Cli, Ran
from tests.support.gates import CLASH, DEAD, OLD, config, gated, policies, with_fingerprints
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


@pytest.mark.parametrize(
    "text",
    [
        DEAD.replace("UNLESS NOT c", "// sleec: allow SLEEC202@? because it comes next year\nUNLESS NOT c"),
        DEAD.replace("CASE q", "CASE q  # sleec: allow dead-hedge@? because it comes next year"),
        "# sleec: allow SLEEC202@?, SLEEC401@? because it comes next year\n" + DEAD,
    ],
)
def test_suppressions_with_a_reason(cli: Cli, repository: Repository, text: str) -> None:
    repository.write(a_sleec=with_fingerprints(text))
    config(repository, block="dead-hedges = true\nnew-suppressions = false")
    code, said = gated(cli)
    assert code == 0
    (ruleset,) = said["rulesets"]
    assert {"code": "SLEEC202", "rules": ["a"], "reason": "it comes next year"} in ruleset["allowed"]
    assert not ruleset["unused_suppressions"]


def test_a_suppression_elsewhere_allows_nothing_and_is_reported(cli: Cli, repository: Repository) -> None:
    text = DEAD + "# sleec: allow SLEEC202 because it is not here\nRULE b\nWHEN u THEN x\n"
    repository.write(a_sleec=text)
    config(repository, block="dead-hedges = true\nnew-suppressions = false")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"dead-hedges"})
    assert said["rulesets"][0]["unused_suppressions"] == [{"line": 5, "allowed": ["SLEEC202"]}]
    assert "unused suppression: line 5 allows SLEEC202" in cli("gate", "--base", "main").out


def test_the_suppression_of_a_name_is_not_unused(cli: Cli, repository: Repository) -> None:
    """The check of names heeds it, so that the gate sees no finding."""
    rule = "RULE b\nWHEN u THEN it has to wait"
    repository.write(a_sleec=f"{OLD}{rule} // sleec: allow SLEEC521 because the button says so\n")
    config(repository, block="unused-suppressions = true\nnew-suppressions = false")
    code, said = gated(cli)
    assert (code, said["rulesets"][0]["unused_suppressions"]) == (0, [])
    assert cli("check", "a.sleec", "--fail-level", "warning").code == 0
    repository.write(a_sleec=f"{OLD}{rule}\n")
    assert "SLEEC521" in cli("check", "a.sleec", "--fail-level", "warning").out


def test_each_code_of_a_suppression_counts(cli: Cli, repository: Repository) -> None:
    allowed = "# sleec: allow SLEEC202@?, SLEEC501, dead-rule because it comes next year\n"
    repository.write(a_sleec=with_fingerprints(allowed + DEAD))
    config(repository, block="dead-hedges = true\nunused-suppressions = true\nnew-suppressions = false")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"unused-suppressions"})
    assert said["rulesets"][0]["unused_suppressions"] == [
        {"line": 1, "allowed": ["SLEEC501"]},
        {"line": 1, "allowed": ["dead-rule"]},
    ]
    assert [block["what"] for block in said["blocks"]] == [
        "line 1 allows SLEEC501, but there is no such finding",
        "line 1 allows dead-rule, but there is no such finding",
    ]
    ran = cli("gate", "--base", "main", "--summary", "out.md")
    assert ran.out.count("unused suppression: line 1 allows") == 2
    assert "2 unused suppressions" in (repository.folder / "out.md").read_text()


@pytest.mark.parametrize(("setting", "code"), [("true", 1), ("false", 0)])
def test_unused_suppressions_can_block(cli: Cli, repository: Repository, setting: str, code: int) -> None:
    repository.write(a_sleec="# sleec: allow SLEEC101 because of history\n" + OLD)
    config(repository, block=f"unused-suppressions = {setting}\nnew-suppressions = false")
    found, said = gated(cli)
    assert found == code
    assert policies(said) == ({"unused-suppressions"} if code else set())


@pytest.mark.parametrize(
    ("comment", "message"),
    [
        ("# sleec: allow SLEEC202", "a suppression needs a reason"),
        ("# sleec: allow SLEEC202 because", "a suppression needs a reason"),
        ("# sleec: alow SLEEC202 because x", "allows nothing"),
        ("# sleec: allow SLEEC22 because x", "did you mean `SLEEC"),
        ("# sleec: allow ded-hedge because x", "did you mean `dead-hedge`?"),
    ],
)
def test_suppressions_that_are_none(cli: Cli, repository: Repository, comment: str, message: str) -> None:
    repository.write(a_sleec=f"{comment}\n{DEAD}")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"suppressions"})
    assert message in said["blocks"][0]["what"]
    assert "line 1" in said["blocks"][0]["what"]


def test_a_suppressed_conflict_is_no_new_one(cli: Cli, repository: Repository) -> None:
    allowed = CLASH.replace("RULE b", "# sleec: allow SLEEC101@? because the nurse decides\nRULE b")
    repository.write(a_sleec=with_fingerprints(allowed))
    config(repository, block="new-suppressions = false")
    assert gated(cli)[0] == 0


def test_a_baseline_lets_old_findings_pass_and_blocks_new_ones(cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"')
    repository.write(a_sleec=CLASH)
    assert cli("gate", "--write-baseline") == Ran(0, "", "known.json: 1 finding\n")
    repository.keep("known.json")
    assert gated(cli)[0] == 0
    repository.write(a_sleec="// moved\n\n" + CLASH)
    assert gated(cli)[1]["rulesets"][0]["baseline"] == 1
    repository.write(a_sleec=CLASH + "RULE d\nWHEN u THEN x AND NOT x\n")
    code, said = gated(cli)
    assert code == 1
    assert not any("a and" in block["what"] for block in said["blocks"])
    repository.write(a_sleec=OLD + "// no conflict\n")
    assert gated(cli)[1]["stale"] == 1


@pytest.mark.parametrize("text", ["", "{", "[]", '{"version": 3}', '{"version": 1, "findings": [{}]}', "\udcff"])
def test_a_baseline_that_is_none(cli: Cli, repository: Repository, text: str) -> None:
    (repository.folder / "known.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    ran = cli("gate", "--base", "main", "--baseline", "known.json")
    assert ran.code == 2
    assert "baseline" in ran.err
    before = (repository.folder / "known.json").read_bytes()
    assert cli("gate", "--write-baseline", "--baseline", "known.json").code == 2
    assert (repository.folder / "known.json").read_bytes() == before


def test_a_baseline_of_one_ruleset_leaves_what_it_has_of_others(cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"')
    repository.write(a_sleec=CLASH, b_sleec=CLASH)
    assert cli("gate", "--write-baseline").err == "known.json: 2 findings\n"
    repository.write(a_sleec=OLD)
    assert cli("gate", "--write-baseline", "a.sleec").err == "known.json: 1 finding\n"
    repository.keep("known.json")
    assert gated(cli)[0] == 0


def test_a_known_conflict_in_more_situations_is_a_new_one(cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"', block='findings = "never"')
    repository.commit(a_sleec=CLASH)
    assert cli("gate", "--write-baseline").code == 0
    repository.keep("known.json")
    repository.write(a_sleec=CLASH + "# the same\n")
    assert gated(cli)[0] == 0
    repository.write(a_sleec=CLASH.replace("UNLESS c IN WHICH CASE p\n", ""))
    code, said = gated(cli)
    assert (code, policies(said), said["rulesets"][0]["baseline"]) == (1, {"new-conflicts"}, 0)


def test_a_conflict_that_is_new_in_the_baseline_too_may_pass(cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"')
    repository.write(a_sleec=CLASH)
    assert cli("gate", "--write-baseline").code == 0
    repository.keep("known.json")
    assert gated(cli)[0] == 0


def test_only_one_of_two_conflicts_of_the_same_rules_is_allowed(cli: Cli, repository: Repository) -> None:
    both = OLD.replace("THEN o\n", "THEN o\nUNLESS d IN WHICH CASE o\n")
    repository.write(a_sleec=both + "RULE b\nWHEN t THEN NOT o\n")
    config(repository, block='findings = "never"\nnew-suppressions = false')
    assert policies(gated(cli)[1]) == {"new-conflicts"}
    second = "RULE b\nWHEN t THEN NOT o\n"
    ruleset = parse(both + second)
    (result,) = run_checks(ruleset, ["conflict"])
    mark = fingerprint(ruleset, next(one for one in result.findings if one.clauses[0].clause == 0))
    first = both.replace("THEN o\n", f"THEN o  # sleec: allow SLEEC101@{mark} because the nurse decides\n", 1)
    repository.write(a_sleec=first + second)
    code, said = gated(cli)
    assert len(said["rulesets"][0]["allowed"]) == 1
    assert (code, policies(said)) == (1, {"new-conflicts"})


TIMED = "RULE a\nWHEN t AND c THEN o WITHIN 5 minutes\nRULE b\nWHEN u THEN NOT o WITHIN 10 minutes\n"
GROWN = {
    "another rule": TIMED + "RULE c\nWHEN v THEN NOT o WITHIN 10 minutes\n",
    "no guard": TIMED.replace(" AND c", ""),
    "a longer window": TIMED.replace("10", "20"),
    "another obligation": TIMED.replace("THEN o", "THEN p WITHIN 5 minutes AND o").replace(
        "NOT o", "NOT p WITHIN 10 minutes AND NOT o"
    ),
}


@pytest.mark.parametrize("how", GROWN)
@pytest.mark.parametrize("kind", ["baseline", "suppression"])
def test_what_is_allowed_is_one_finding(cli: Cli, repository: Repository, kind: str, how: str) -> None:
    """Neither allows a finding about other rules, clauses or obligations, nor one whose rules apply more often."""
    config(repository, *(['baseline = "known.json"'] if kind == "baseline" else []))
    mark = "# sleec: allow SLEEC101@? because the nurse decides\n" if kind == "suppression" else ""
    allowed = with_fingerprints(mark + TIMED)
    repository.commit(a_sleec=allowed)
    if kind == "baseline":
        assert cli("gate", "--write-baseline").code == 0
        repository.keep("known.json")
    repository.write(a_sleec=allowed.replace("RULE b", "\n# moved\nRULE b"))
    assert gated(cli)[0] == 0
    repository.write(a_sleec=allowed.replace(TIMED, GROWN[how]))
    code, said = gated(cli)
    assert code == 1
    assert "findings" in policies(said)


def test_a_suppression_without_fingerprint_shows_what_to_write(cli: Cli, repository: Repository) -> None:
    config(repository, block="new-suppressions = false")
    text = CLASH.replace("RULE b", "# sleec: allow SLEEC101 because the nurse decides\nRULE b")
    repository.write(a_sleec=text)
    code, said = gated(cli)
    assert (code, policies(said) & {"suppressions"}) == (1, {"suppressions"})
    (what,) = (block["what"] for block in said["blocks"] if block["policy"] == "suppressions")
    written = what.partition("write: ")[2].rstrip(")")
    assert written.startswith("# sleec: allow SLEEC101@")
    repository.write(a_sleec=text.replace("# sleec: allow SLEEC101 because the nurse decides", written))
    assert gated(cli)[0] == 0


def test_entries_of_an_earlier_baseline_allow_nothing(cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"')
    repository.write(a_sleec=CLASH)
    assert cli("gate", "--write-baseline").code == 0
    known = repository.folder / "known.json"
    said = json.loads(known.read_text())
    said["version"] = 1
    for entry in said["findings"]:
        del entry["fingerprint"]
    known.write_text(json.dumps(said))
    repository.keep("known.json")
    code, found = gated(cli)
    assert (code, found["stale"]) == (1, 1)
    assert "1 entry of the baseline is obsolete" in cli("gate", "--base", "main").out
    assert cli("gate", "--write-baseline").code == 0
    repository.keep("known.json")
    assert gated(cli)[0] == 0
