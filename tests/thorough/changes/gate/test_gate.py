"""`gate` from end to end, in real repositories: every policy passes once and blocks once."""

from __future__ import annotations

import json
import os
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from sleec_verify.report import FORMATS
from tests.support.cli import Cli, Ran
from tests.support.paths import ROOT
from tests.support.repository import Repository
from tests.support.schemas import validator

GATE = validator("gate")

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")

OLD = "RULE a\nWHEN t THEN o\nUNLESS c IN WHICH CASE p\n"
CLASH = OLD + "RULE b\nWHEN t THEN NOT o\n"
DEAD = OLD + "UNLESS NOT c IN WHICH CASE q\n"
LOST = "RULE a\nWHEN t THEN o\n"
TIMED = "MEASURE n: integer\nRULE a\nWHEN t THEN o WITHIN n minutes OTHERWISE p\n"
TIMED_ELSE = TIMED.replace("OTHERWISE p", "OTHERWISE q")
CASES = '[[case]]\nwhen = ["t"]\nobligations = ["o"]\n'
BOTH = CASES + '[[case]]\nwhen = ["t"]\ngiven = { c = true }\nobligations = ["p"]\n'


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    made = Repository(tmp_path)
    made.commit(a_sleec=OLD)
    return made


def config(repository: Repository, *lines: str, block: str = "") -> None:
    """A configuration with these lines, and those of what blocks, in the base."""
    blocks = f"[tool.sleec-verify.block]\n{block}\n" if block else ""
    repository.put("pyproject.toml", "\n".join(["[tool.sleec-verify]", *lines, blocks]))
    repository.keep("pyproject.toml")


def gated(cli: Cli, *arguments: str, base: str = "main") -> tuple[int, dict[str, Any]]:
    """The exit code and the JSON, after it was held against the published schema."""
    ran = cli("gate", "--base", base, "--format", "json", *arguments)
    said = json.loads(ran.out)
    GATE.validate(said)
    assert (said["status"] == "unusable") == bool(ran.err), ran.err
    return ran.code, said


def policies(said: dict[str, Any]) -> set[str]:
    return {block["policy"] for block in said["blocks"]}


# Policies -------------------------------------------------------------------------------------------------


def test_nothing_changed(cli: Cli, repository: Repository) -> None:
    ran = cli("gate", "--base", "main")
    assert ran == Ran(0, "passed: no rulesets examined, 1 unchanged since main\n", "")


@pytest.mark.parametrize(
    ("policy", "new", "blocking", "passing"),
    [
        ("findings", CLASH, 'findings = "error"\nnew-conflicts = false', 'findings = "never"\nnew-conflicts = false'),
        ("findings", DEAD, 'findings = "warning"', 'findings = "error"'),
        ("new-conflicts", CLASH, 'findings = "never"', 'findings = "never"\nnew-conflicts = false'),
        ("lost-obligations", LOST, 'lost-obligations = ["p*"]', 'lost-obligations = ["q*"]'),
        (
            "ruled-out-situations",
            OLD + "ASSUME NOT t OR c\n",
            "ruled-out-situations = true\nfindings = 'never'",
            "findings = 'never'",
        ),
        ("dead-hedges", DEAD, "dead-hedges = true", "dead-hedges = false"),
        ("clause-coverage", LOST, "clause-coverage = 1", "clause-coverage = 0"),
    ],
)
def test_policies_block_and_let_pass(
    cli: Cli, repository: Repository, policy: str, new: str, blocking: str, passing: str
) -> None:
    repository.write(a_sleec=new)
    config(repository, block=blocking)
    code, said = gated(cli)
    assert (code, said["status"]) == (1, "blocked")
    assert policies(said) == {policy}
    config(repository, block=passing)
    code, said = gated(cli)
    assert (code, said["status"], said["blocks"]) == (0, "passed", [])


def test_a_certificate_beside_the_rules_can_be_asked_for(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=LOST)
    config(repository, block="certificates = true")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"certificates"})
    assert "there is no a.certificate beside it" in said["blocks"][0]["what"]
    assert cli("certify", "a.sleec", "-o", "a.certificate").code == 0
    assert gated(cli)[0] == 0
    repository.write(a_sleec=LOST + "\n")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"certificates"})
    assert "a.certificate is refused: " in said["blocks"][0]["what"]


def test_unknown_is_exit_3_unless_it_may_pass(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=TIMED)
    repository.write(a_sleec=TIMED_ELSE)
    config(repository, block="findings = 'never'")
    code, said = gated(cli)
    assert (code, said["status"]) == (3, "unknown")
    assert "of a measure" in said["unknown"][0]["what"]
    config(repository, block="findings = 'never'\nunknown = false")
    assert gated(cli)[0] == 0


@pytest.mark.parametrize(("cases", "percent"), [(CASES, 50), (BOTH, 100)])
def test_clause_coverage_counts_the_clauses_that_cases_reach(
    cli: Cli, repository: Repository, cases: str, percent: int
) -> None:
    repository.write(a_sleec=OLD + "\n", a_cases_toml=cases)
    config(repository, block=f"clause-coverage = {percent}")
    assert gated(cli)[0] == 0
    config(repository, block=f"clause-coverage = {percent + 0.5}" if percent < 100 else "clause-coverage = 100")
    code, said = gated(cli)
    assert code == (1 if percent < 100 else 0)
    assert said["rulesets"][0]["coverage"]["reached"] == percent // 50


def test_coverage_of_rules_with_times_is_unknown(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=TIMED)
    config(repository, block="clause-coverage = 50")
    code, said = gated(cli)
    assert code == 3
    assert any("clause coverage" in block["what"] for block in said["unknown"])


def test_cases_that_are_none(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=LOST, a_cases_toml="[[case]]\nwehn = 1\n")
    config(repository, block="clause-coverage = 50")
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "did you mean when?" in ran.err


def test_assertions(cli: Cli, repository: Repository) -> None:
    repository.put("must.txt", "never p when not c\n")
    config(repository, 'assertions = ["must.txt", "always o when t and not c"]')
    repository.keep("must.txt")
    assert gated(cli)[0] == 0
    code, said = gated(cli, "--assert", "never p")
    assert code == 1
    assert policies(said) == {"assertions"}
    ran = cli("gate", "--base", "main", "--assert", "never pp")
    assert ran.code == 2
    assert "`pp` is not in the rules" in ran.err


def test_the_code_of_targets(cli: Cli, repository: Repository) -> None:
    root = ROOT
    robot = (root / "examples" / "household_robot.py").read_text(encoding="utf-8")
    repository.put("rules/household.sleec", (root / "rulesets" / "household.sleec").read_text(encoding="utf-8"))
    repository.put("robot.py", robot)
    repository.commit()
    target = '[[tool.sleec-verify.targets]]\ncode = "robot.py"\nrules = "rules/household.sleec"'
    config(repository, target)
    assert gated(cli)[0] == 0
    assert "self.refuse_request()" in robot
    repository.put("robot.py", robot.replace("self.refuse_request()", "self.open_curtains()", 1))
    code, said = gated(cli)
    assert code == 1
    assert {block["where"] for block in said["blocks"]} == {"robot.py"}
    repository.put("robot.py", None)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "robot.py" in ran.err


# The base -------------------------------------------------------------------------------------------------


def test_the_base_is_what_both_have_in_common(cli: Cli, repository: Repository) -> None:
    repository.git("checkout", "-q", "-b", "feature")
    repository.git("checkout", "-q", "main")
    repository.commit(a_sleec=LOST)
    repository.git("checkout", "-q", "feature")
    assert gated(cli)[1]["unchanged"] == 1


def test_only_what_changed_is_examined(cli: Cli, repository: Repository) -> None:
    repository.commit(b_sleec=CLASH)
    repository.write(a_sleec=OLD + "\n// the same\n")
    code, said = gated(cli)
    assert (code, [one["path"] for one in said["rulesets"]], said["unchanged"]) == (0, ["a.sleec"], 1)
    code, said = gated(cli, "--all")
    assert (code, len(said["rulesets"])) == (1, 2)


def test_added_and_deleted_files(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=None, b_sleec="RULE b\nWHEN u THEN x\n")
    config(repository, block='lost-obligations = ["o"]')
    code, said = gated(cli)
    assert code == 1
    assert [(block["policy"], block["where"]) for block in said["blocks"]] == [("lost-obligations", "a.sleec")]
    assert [one["relation"] for one in said["rulesets"]] == ["laxer", "stricter"]


def test_the_base_and_rulesets_of_the_configuration(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository.put("rules/b.sleec", OLD)
    config(repository, 'base = "main"', 'rulesets = ["rules"]')
    repository.commit()
    repository.put("rules/b.sleec", CLASH)
    repository.put("a.sleec", "no rules")
    (repository.folder / "rules" / "deep").mkdir()
    monkeypatch.chdir(repository.folder / "rules" / "deep")
    ran = cli("gate", "--format", "json")
    assert ran.code == 1
    assert [one["path"] for one in json.loads(ran.out)["rulesets"]] == ["rules/b.sleec"]


# Suppressions and the baseline ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        DEAD.replace("UNLESS NOT c", "// sleec: allow SLEEC202 because it comes next year\nUNLESS NOT c"),
        DEAD.replace("CASE q", "CASE q  # sleec: allow dead-hedge because it comes next year"),
        "# sleec: allow SLEEC202, SLEEC401 because it comes next year\n" + DEAD,
    ],
)
def test_suppressions_with_a_reason(cli: Cli, repository: Repository, text: str) -> None:
    repository.write(a_sleec=text)
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


def test_each_code_of_a_suppression_counts(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec="# sleec: allow SLEEC202, SLEEC501, dead-rule because it comes next year\n" + DEAD)
    config(repository, block="dead-hedges = true\nunused-suppressions = true\nnew-suppressions = false")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"unused-suppressions"})
    assert said["rulesets"][0]["unused_suppressions"] == [
        {"line": 1, "allowed": ["SLEEC501"]},
        {"line": 1, "allowed": ["dead-rule"]},
    ]
    assert [block["what"] for block in said["blocks"]] == [
        "line 1 allows SLEEC501, and there is no such finding",
        "line 1 allows dead-rule, and there is no such finding",
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
        ("# sleec: allow SLEEC22 because x", "did you mean SLEEC"),
        ("# sleec: allow ded-hedge because x", "did you mean dead-hedge?"),
    ],
)
def test_suppressions_that_are_none(cli: Cli, repository: Repository, comment: str, message: str) -> None:
    repository.write(a_sleec=f"{comment}\n{DEAD}")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"suppressions"})
    assert message in said["blocks"][0]["what"]
    assert "line 1" in said["blocks"][0]["what"]


def test_a_suppressed_conflict_is_no_new_one(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=CLASH.replace("RULE b", "# sleec: allow SLEEC101 because the nurse decides\nRULE b"))
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


@pytest.mark.parametrize("text", ["", "{", "[]", '{"version": 2}', '{"version": 1, "findings": [{}]}', "\udcff"])
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
    assert (code, policies(said), said["rulesets"][0]["baseline"]) == (1, {"new-conflicts"}, 1)


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
    first = both.replace("THEN o\n", "THEN o  # sleec: allow SLEEC101 because the nurse decides\n", 1)
    repository.write(a_sleec=first + "RULE b\nWHEN t THEN NOT o\n")
    code, said = gated(cli)
    assert len(said["rulesets"][0]["allowed"]) == 1
    assert (code, policies(said)) == (1, {"new-conflicts"})


# What git has and what it has not -------------------------------------------------------------------------


def test_a_ruleset_that_has_moved_is_compared_with_what_it_was(cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"', block='lost-obligations = ["*"]')
    repository.commit(a_sleec=CLASH)
    assert cli("gate", "--write-baseline").code == 0
    repository.keep("known.json")
    repository.git("mv", "a.sleec", "b.sleec")
    code, said = gated(cli)
    assert (code, said["rulesets"], said["unchanged"]) == (0, [], 1)
    repository.write(b_sleec="# moved\n" + CLASH)
    code, said = gated(cli)
    (ruleset,) = said["rulesets"]
    assert (code, ruleset["path"], ruleset["moved_from"]) == (0, "b.sleec", "a.sleec")
    assert (ruleset["relation"], ruleset["baseline"], said["stale"]) == ("equivalent", 1, 0)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 0
    assert "| `b.sleec`, was `a.sleec` |" in (repository.folder / "out.md").read_text()
    repository.write(b_sleec=CLASH.replace("UNLESS c IN WHICH CASE p\n", ""))
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
    repository.write(b_sleec=CLASH.replace("p\n", "o\n"))
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
    repository.write(b_sleec="RULE other\nWHEN u THEN x\n")
    assert [one["path"] for one in gated(cli)[1]["rulesets"]] == ["a.sleec", "b.sleec"]


def test_of_what_moved_the_most_alike_belong_together(cli: Cli, repository: Repository) -> None:
    second = "RULE c\nWHEN u THEN x\nUNLESS d IN WHICH CASE y\n"
    repository.commit(b_sleec=second)
    repository.write(a_sleec=None, b_sleec=None, c_sleec=second + "RULE d\nWHEN v THEN z\n", d_sleec=OLD + "# a\n")
    said = gated(cli)[1]
    moved = [(one["path"], one["moved_from"], one["relation"]) for one in said["rulesets"]]
    assert moved == [("c.sleec", "b.sleec", "stricter"), ("d.sleec", "a.sleec", "equivalent")]


def test_a_folder_that_has_moved_is_the_same(cli: Cli, repository: Repository) -> None:
    """More of them than are compared line by line; some of them equal, some of them changed."""
    for number in range(60):
        repository.put(f"old/{number}.sleec", OLD.replace("RULE a", f"RULE r{number // 2}"))
    repository.commit()
    repository.git("mv", "old", "new")
    config(repository, block='lost-obligations = ["*"]')
    code, said = gated(cli)
    assert (code, said["unchanged"], said["rulesets"]) == (0, 61, [])
    repository.put("new/8.sleec", OLD.replace("RULE a", "RULE r4") + "\n# changed\n")
    (ruleset,) = gated(cli)[1]["rulesets"]
    assert (ruleset["path"], ruleset["relation"]) == ("new/8.sleec", "equivalent")
    assert ruleset["moved_from"] in ("old/8.sleec", "old/9.sleec")
    for number in range(60):
        repository.put(f"new/{number}.sleec", OLD.replace("RULE a", f"RULE r{number}") + "\n# changed\n")
    assert len(gated(cli)[1]["rulesets"]) == 120, "too many to be compared with one another"


def test_what_git_ignores_or_keeps_for_itself_is_not_looked_at(cli: Cli, repository: Repository) -> None:
    repository.put(".gitignore", "venv/\n")
    repository.put("venv/x.sleec", "WHEN")
    repository.commit()
    repository.git("branch", "fix.sleec")
    (repository.folder / "nested").mkdir()
    Repository(repository.folder / "nested").commit(x_sleec="WHEN")
    assert gated(cli)[1]["unchanged"] == 1
    assert cli("gate", "--write-baseline", "--baseline", "known.json").code == 0
    (repository.folder / "nested" / "x.sleec").unlink()
    (repository.folder / "venv" / "x.sleec").unlink()
    assert cli("check", ".").code == 0
    assert cli("diff", ".", ".").code == 0


def test_rulesets_that_are_not_added_yet_are_looked_at(cli: Cli, repository: Repository) -> None:
    repository.put("deep/new.sleec", CLASH)
    assert [one["path"] for one in gated(cli)[1]["rulesets"]] == ["deep/new.sleec"]


def test_submodules_are_of_another_repository(cli: Cli, repository: Repository, tmp_path_factory: Any) -> None:
    other = Repository(tmp_path_factory.mktemp("other"))
    other.commit(x_sleec=CLASH)
    repository.git("-c", "protocol.file.allow=always", "submodule", "--quiet", "add", str(other.folder), "sub")
    assert gated(cli)[1]["unchanged"] == 1
    repository.commit()
    assert gated(cli)[1]["unchanged"] == 1
    assert "there is no .sleec file at or below sub" in cli("gate", "--base", "main", "sub").err


def test_links_are_not_followed(cli: Cli, repository: Repository) -> None:
    (repository.folder / "link.sleec").symlink_to("a.sleec")
    (repository.folder / "broken.sleec").symlink_to("nothing.sleec")
    (repository.folder / "loop").symlink_to(".")
    assert gated(cli)[1]["unchanged"] == 1
    repository.commit()
    assert gated(cli)[1]["unchanged"] == 1
    assert gated(cli, "link.sleec")[1]["unchanged"] == 1


def test_what_a_sparse_checkout_leaves_out_is_not_lost(cli: Cli, repository: Repository) -> None:
    repository.put("one/b.sleec", CLASH)
    repository.put("two/c.sleec", OLD)
    repository.commit()
    repository.git("sparse-checkout", "set", "two")
    assert not (repository.folder / "one").exists()
    config(repository, block='lost-obligations = ["*"]')
    assert gated(cli)[1]["unchanged"] == 3
    assert gated(cli, "--all")[1]["rulesets"][1]["path"] == "one/b.sleec"
    assert gated(cli, "one")[1]["unchanged"] == 1


def test_file_names_are_of_any_characters(cli: Cli, repository: Repository) -> None:
    names = [
        "a b.sleec",
        "q'u\"o.sleec",
        "ünï.sleec",
        "new\nline.sleec",
        "-dash.sleec",
        "st*r.sleec",
        "[x].sleec",
        ":c.sleec",
    ]
    names += [os.fsdecode(b"bytes\xff.sleec")]
    for name in names:
        repository.put(name, OLD)
    repository.commit()
    for name in names:
        repository.put(name, CLASH)
    code, said = gated(cli, "--summary", "out.md")
    assert (code, {one["path"] for one in said["rulesets"]}, said["unchanged"]) == (1, set(names), 1)
    (repository.folder / "out.md").read_text(encoding="utf-8")
    for name in names:
        assert [one["path"] for one in gated(cli, "--", f"./{name}")[1]["rulesets"]] == [name]
    for form in FORMATS:
        assert cli("gate", "--base", "main", "--format", form, "--output", "report").code == 1
        (repository.folder / "report").read_bytes()
    assert cli("gate", "--write-baseline", "--baseline", "known.json").code == 0
    repository.keep("known.json")
    assert gated(cli, "--baseline", "known.json")[0] == 0


def test_line_breaks_and_marks_of_editors_change_nothing(cli: Cli, repository: Repository) -> None:
    text = "\ufeff" + OLD + "# sleec: allow SLEEC101 because the nurse decides\nRULE b\nWHEN t THEN NOT o\n"
    (repository.folder / "a.sleec").write_bytes(text.replace("\n", "\r\n").encode())
    config(repository, block="new-suppressions = false")
    code, said = gated(cli)
    assert (code, len(said["rulesets"][0]["allowed"])) == (0, 1)
    (repository.folder / "a.sleec").write_bytes(("\ufeff" + OLD.replace("\n", "\r\n")).encode())
    assert gated(cli)[1]["rulesets"][0]["relation"] == "equivalent"


def test_from_a_folder_below(cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    repository.put("sub/b.sleec", CLASH)
    monkeypatch.chdir(repository.folder / "sub")
    code, said = gated(cli, "--assert", "never p when not c")
    assert (code, {block["where"] for block in said["blocks"]}) == (1, {"sub/b.sleec"})
    assert said["unchanged"] == 0
    code, said = gated(cli, "..", "--assert", "never o")
    assert {block["where"] for block in said["blocks"]} == {"a.sleec", "sub/b.sleec"}
    assert {one["ruleset"] for one in said["assertions"]} == {"a.sleec", "sub/b.sleec"}


def test_detached_shallow_and_other_worktrees(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: Any
) -> None:
    repository.commit()
    repository.git("checkout", "-q", "--detach")
    assert gated(cli)[1]["unchanged"] == 1
    aside = tmp_path_factory.mktemp("aside")
    repository.git("clone", "-q", "--bare", ".", str(aside / "bare"))
    repository.git("-C", str(aside / "bare"), "worktree", "add", "-q", str(aside / "tree"), "main")
    monkeypatch.chdir(aside / "tree")
    assert gated(cli)[1]["unchanged"] == 1
    for folder in (aside / "bare", repository.folder / ".git"):
        monkeypatch.chdir(folder)
        ran = cli("gate", "--base", "main")
        assert (ran.code, "is inside a git directory" in ran.err) == (2, True)
    url = (repository.folder / ".git").as_uri()
    repository.git("clone", "-q", "--depth", "1", "--branch", "main", url, str(aside / "shallow"))
    monkeypatch.chdir(aside / "shallow")
    assert gated(cli)[1]["unchanged"] == 1
    ran = cli("gate", "--base", "origin/release-2026")
    assert "in CI, fetch it first (git fetch origin release-2026), and name it origin/release-2026" in ran.err
    repository.git("-C", str(aside / "shallow"), "checkout", "-q", "--detach")
    repository.git("-C", str(aside / "shallow"), "branch", "-q", "-D", "main")
    assert "did you mean origin/main?" in cli("gate", "--base", "main").err
    alone = Repository(tmp_path_factory.mktemp("alone"))
    alone.write(a_sleec=OLD)
    monkeypatch.chdir(alone.folder)
    ran = cli("gate", "--base", "main")
    assert (ran.code, "nothing has been committed yet" in ran.err) == (2, True)


def test_a_repository_of_somebody_else(cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    ran = cli("gate", "--base", "main")
    assert (ran.code, "git does not trust this repository" in ran.err) == (2, True)
    assert "safe.directory" in ran.err


@pytest.mark.parametrize("place", ["nowhere/summary", "."])
def test_a_summary_that_cannot_be_written(place: str, cli: Cli, repository: Repository, monkeypatch: Any) -> None:
    ran = cli("gate", "--base", "main", "--summary", place)
    assert (ran.code, ran.out) == (2, "")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", place)
    ran = cli("gate", "--base", "main")
    assert (ran.code, "which $GITHUB_STEP_SUMMARY names, cannot be written" in ran.err) == (2, True)


def test_a_long_summary_is_cut(cli: Cli, repository: Repository) -> None:
    rules = "".join(f"RULE r{i}\nWHEN t{i} THEN o{i} AND NOT o{i}\n" for i in range(60))
    repository.write(a_sleec=rules)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 1
    text = (repository.folder / "out.md").read_text(encoding="utf-8")
    assert re.search(r"^- … and \d+ more reasons: see the log$", text, re.MULTILINE)
    assert re.search(r"^- … and \d+ more changes: see the log$", text, re.MULTILINE)
    for number in range(60):
        repository.put(f"many/{number}.sleec", OLD)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 1
    assert "| … and 11 more rulesets: see the log | | |" in (repository.folder / "out.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("data", [b"\xff\xfe\x00", b"RULE a\0", bytes(range(256))])
def test_what_is_no_text(cli: Cli, repository: Repository, data: bytes) -> None:
    (repository.folder / "a.sleec").write_bytes(data)
    assert cli("gate", "--base", "main").code == 2
    repository.commit()
    repository.write(a_sleec=OLD)
    ran = cli("gate", "--base", "main")
    assert (ran.code, "main:a.sleec" in ran.err) == (2, True)


# What stands beside the rules -----------------------------------------------------------------------------


def test_cases_that_are_gone_are_a_change(cli: Cli, repository: Repository) -> None:
    repository.commit(a_cases_toml=BOTH)
    config(repository, block="clause-coverage = 100")
    assert gated(cli)[1]["unchanged"] == 1
    for now in (CASES, None):
        repository.write(a_cases_toml=now)
        code, said = gated(cli)
        assert (code, policies(said)) == (1, {"clause-coverage"})


def test_a_certificate_that_is_gone_is_a_change(cli: Cli, repository: Repository) -> None:
    assert cli("certify", "a.sleec", "-o", "a.certificate").code == 0
    repository.commit()
    config(repository, block="certificates = true")
    assert gated(cli)[1]["unchanged"] == 1
    shutil.rmtree(repository.folder / "a.certificate")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"certificates"})


def test_assertions_are_asked_of_what_is_the_same_and_nothing_else_is(cli: Cli, repository: Repository) -> None:
    repository.commit(b_sleec=CLASH)
    assert gated(cli, "--assert", "never p when not c")[0] == 0
    code, said = gated(cli, "--assert", "never p")
    assert (code, said["unchanged"], said["rulesets"]) == (1, 2, [])
    assert [(block["policy"], block["where"]) for block in said["blocks"]] == [
        ("assertions", "a.sleec"),
        ("assertions", "b.sleec"),
    ]
    repository.commit(b_sleec="WHEN")
    assert gated(cli)[0] == 0
    code, said = gated(cli, "--assert", "never p when not c")
    assert (code, [one["path"] for one in said["rulesets"]]) == (2, ["b.sleec"])


def test_an_assertion_is_asked_of_those_whom_it_concerns(cli: Cli, repository: Repository) -> None:
    repository.commit(b_sleec="RULE b\nWHEN u THEN x\n")
    always = ("--assert", "always x when u")
    code, said = gated(cli, *always)
    assert (code, [one["ruleset"] for one in said["assertions"]]) == (0, ["b.sleec"])
    # Nobody gets around it by taking away what it is about.
    for now in ("RULE c\nWHEN v THEN y\n", None):
        repository.write(b_sleec=now)
        code, said = gated(cli, *always)
        assert (code, policies(said), said["blocks"][0]["where"]) == (1, {"assertions"}, "b.sleec")
        assert cli("gate", "--base", "main", "--format", "sarif", *always).code == 1
    assert cli("gate", "--base", "main", "--assert", "always z when w").code == 2


# The cache ------------------------------------------------------------------------------------------------


def test_what_is_decided_once_is_kept(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: Any
) -> None:
    kept = tmp_path_factory.mktemp("kept")
    monkeypatch.setenv("SLEEC_VERIFY_CACHE", str(kept))
    repository.write(a_sleec=CLASH)
    first = cli("gate", "--base", "main")
    (entry,) = (path for path in kept.rglob("*") if path.is_file() and path.name != ".gitignore")

    def solve(*_: object, **__: object) -> None:
        raise AssertionError("solved again")

    with monkeypatch.context() as patched:
        patched.setattr("sleec_verify.checks.run_checks", solve)
        assert cli("gate", "--base", "main") == first
        assert cli("gate", "--base", "main", "--no-cache").code == 2
    entry.write_bytes(entry.read_bytes().replace(b"SLEEC101", b"SLEEC503"))
    ran = cli("gate", "--base", "main")
    assert (ran.code, ran.out) == (1, first.out)
    assert "is damaged; its results are recomputed" in ran.err


# Bad input ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("[tool.sleec-verify]\nblok = {}", "has an unknown key blok", "did you mean block?"),
        (
            "[tool.sleec-verify.block]\nnew-conflict = true",
            "has an unknown key block.new-conflict",
            "did you mean new-conflicts?",
        ),
        ("[tool.sleec-verify.block]\nzzz = true", "has an unknown key block.zzz", "there are certificates, clause-"),
        ("[tool.sleec-verify]\nbase = 3", "base is 3", "it is a text"),
        ("[tool.sleec-verify]\nrulesets = [3]", "rulesets is [3]", "it is a list of texts"),
        ("[tool.sleec-verify.block]\nunknown = 1", "block.unknown is 1", "true or false"),
        ("[tool.sleec-verify.block]\nfindings = 'bad'", "block.findings is 'bad'", "one of error"),
        ("[tool.sleec-verify.block]\nclause-coverage = 101", "block.clause-coverage is 101", "0 to 100"),
        ("[tool.sleec-verify.block]\nclause-coverage = true", "block.clause-coverage is True", "0 to 100"),
        ("[tool]\nsleec-verify = 3", "the table is 3", "a table"),
        ("[[tool.sleec-verify.targets]]\ncode = 'robot.py'", "targets has no rules", "belong together"),
        ("[[tool.sleec-verify.targets]]\ncod = 'robot.py'", "has an unknown key targets.cod", "did you mean code?"),
    ],
)
def test_configurations_that_are_none(cli: Cli, repository: Repository, text: str, message: str, hint: str) -> None:
    repository.put("pyproject.toml", text)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert f"error: pyproject.toml: [tool.sleec-verify] {message}" in ran.err
    assert hint in ran.err


def test_its_own_file_comes_first(cli: Cli, repository: Repository) -> None:
    repository.put("pyproject.toml", "[tool.sleec-verify]\nnonsense = 1\n")
    repository.put("sleec-verify.toml", 'base = "main"\n')
    repository.keep("sleec-verify.toml")
    assert cli("gate").code == 0
    repository.put("sleec-verify.toml", "bse = 1\n")
    ran = cli("gate")
    assert ran.code == 2
    assert "sleec-verify.toml: has an unknown key bse" in ran.err.replace("toml: ", "toml: ", 1)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "say which revision"),
        (["--base", "mian"], "did you mean main?"),
        (["--base", "main", "--config", "nothing.toml"], "there is no file nothing.toml"),
        (["--base", "main", "--config", "broken.toml"], "is no TOML"),
        (["--base", "main", "--baseline", "nothing.json"], "there is no baseline nothing.json"),
        (["--base", "main", "--summary", "a.sleec"], "exists and is not a summary"),
        (["--base", "main", "nothing.sleec"], "there is no .sleec file at or below nothing.sleec"),
        (["--write-baseline"], "say where"),
    ],
)
def test_bad_usage(cli: Cli, repository: Repository, arguments: list[str], message: str) -> None:
    repository.put("broken.toml", "= 3")
    ran = cli("gate", *arguments)
    assert ran.code == 2
    assert message in ran.err
    assert (repository.folder / "a.sleec").read_text() == OLD


def test_a_ruleset_that_is_none_now(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec="WHEN", b_sleec=CLASH)
    ran = cli("gate", "--base", "main", "--summary", "out.md")
    assert ran.code == 2
    assert "a.sleec:1:5: error" in ran.err
    assert "new conflict: a and b" in ran.out  # the others are examined all the same
    assert "### What cannot be read" in (repository.folder / "out.md").read_text()


def test_a_ruleset_that_was_none_before(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec="WHEN")
    repository.write(a_sleec=OLD)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "main:a.sleec:1:5: error" in ran.err


# The summary ----------------------------------------------------------------------------------------------


def test_the_summary(cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    repository.write(a_sleec=CLASH)
    step = repository.folder / "step.md"
    step.write_text("what other steps say\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(step))
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 1
    text = (repository.folder / "out.md").read_text(encoding="utf-8")
    assert step.read_text() == "what other steps say\n" + text
    assert text.startswith("<!-- written by sleec-verify gate -->\n## SLEEC rules: blocked\n")
    assert "- **new-conflicts**, `a.sleec`: a and b now conflict over o" in text
    assert "| `a.sleec` | incomparable: " in text
    repository.write(a_sleec=OLD)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 0
    assert "passed" in (repository.folder / "out.md").read_text()


def test_nothing_in_the_summary_is_taken_for_markdown(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec="RULE a_b\nWHEN t_x THEN o_z\nUNLESS d < 3 IN WHICH CASE p\n")
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 0
    text = (repository.folder / "out.md").read_text()
    assert "o\\_z" in text
    assert "o_z" not in text.replace("\\_", "")
