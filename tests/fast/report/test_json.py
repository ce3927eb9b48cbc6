"""The JSON that programs read has the shape that the design promises."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from sleec_verify.checks import CHECKS
from sleec_verify.encoding.solver import Undecided
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.schemas import SCHEMAS, validator

REPORT, ENTAILMENT, KINDS, CASES, DIFFERENCE = (SCHEMAS[name] for name in ("check", "entail", "rules", "cases", "diff"))

CLASH = """\
MEASURE Pain: number
RULE one
WHEN Rung THEN Open
UNLESS Night AND Pain > 0.5 IN WHICH CASE Ask
UNLESS Pain > 36.6 IN WHICH CASE Wake
RULE two
WHEN Storm THEN NOT Open
"""


def test_report_has_the_promised_shape(cli: Cli) -> None:
    ran = cli("check", ".", "--format", "json", files={"a.sleec": CLASH, "b.sleec": "WHEN", "c.sleec": "WHEN a THEN b"})
    report = json.loads(ran.out)
    jsonschema.validate(report, REPORT)
    assert ran.code == 2
    assert [ruleset["path"] for ruleset in report["rulesets"]] == ["./a.sleec", "./b.sleec", "./c.sleec"]
    found = report["rulesets"][0]["findings"]
    assert report["summary"]["errors"] == sum(finding["severity"] == "error" for finding in found) > 0
    conflict = next(finding for finding in found if finding["check"] == "conflict")
    assert conflict["rules"] == ["one", "two"]
    assert conflict["obligations"] == ["Open"]
    assert conflict["witness"]["triggers"] == ["Rung", "Storm"]
    assert {"conflict", "dead-rule", "reading"} <= {check["name"] for check in report["rulesets"][0]["checks"]}


def test_every_verdict_without_finding_is_proved(cli: Cli) -> None:
    report = json.loads(cli("check", "a.sleec", "--format", "json", files={"a.sleec": CLASH}).out)
    (ruleset,) = report["rulesets"]
    refuted = {finding["check"] for finding in ruleset["findings"]}
    assert {check["name"]: check["verdict"] for check in ruleset["checks"]} == {
        check["name"]: "refuted" if check["name"] in refuted else "proved" for check in ruleset["checks"]
    }


@pytest.mark.parametrize("given", ["", "Night, Pain=1/3", "Night, Pain=0.75"])
def test_entailment_has_the_promised_shape(cli: Cli, given: str) -> None:
    ran = cli("entail", "a.sleec", "--when", "Rung", "--given", given, "--format", "json", files={"a.sleec": CLASH})
    if "/" in given:
        assert ran.code == 2
    else:
        jsonschema.validate(json.loads(ran.out), ENTAILMENT)
        assert ran.code == 0


def test_conflict_entails_nothing(cli: Cli) -> None:
    ran = cli("entail", "a.sleec", "--when", "Rung,Storm", "--format", "json", files={"a.sleec": CLASH})
    answer = json.loads(ran.out)
    jsonschema.validate(answer, ENTAILMENT)
    assert ran.code == 1
    assert (answer["consistent"], answer["obligations"], answer["prohibitions"]) == (False, [], [])
    assert [because["rule"] for because in answer["because"]] == ["one", "two"]
    assert len(answer["conflicts"]) == 1


def test_the_designs_example(cli: Cli) -> None:
    rules = """\
RULE dress_assist
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
UNLESS UserDistressed IN WHICH CASE (WarnUser AND OpenCurtains)
"""
    line = ("--when", "CurtainOpenRequest", "--given", "UserUndressed", "--format", "json")
    assert json.loads(cli("entail", "a.sleec", *line, files={"a.sleec": rules}).out) == {
        "consistent": True,
        "obligations": ["ExplainWhy", "RefuseRequest"],
        "prohibitions": [],
        "because": [
            {
                "rule": "dress_assist",
                "clause": 1,
                "layer": "dress_assist.hc1",
                "obligations": ["RefuseRequest", "ExplainWhy"],
            }
        ],
    }


def test_rules_as_json(cli: Cli) -> None:
    listed = json.loads(cli("rules", "--format", "json").out)
    jsonschema.validate(listed, KINDS)
    assert [kind["code"] for kind in listed] == sorted(kind["code"] for kind in listed)
    assert all(kind[key] for kind in listed for key in ("severity", "title", "explanation", "mend", "bad", "good"))
    (one,) = json.loads(cli("rules", "dead-hedge", "--format", "json").out)
    assert one["code"] == "SLEEC202"


def test_a_schedule_says_what_is_due_until_when(cli: Cli) -> None:
    rules = (
        "WHEN Smoke THEN CallHelp WITHIN 5 minutes OTHERWISE SoundAlarm\nWHEN CallHelp THEN OpenDoor WITHIN 1 minute\n"
    )
    ran = cli("entail", "a.sleec", "--when", "Smoke", "--format", "json", files={"a.sleec": rules})
    entries = json.loads(ran.out)["schedule"]
    assert [(e["obligation"], e["from"], e["until"], e["after"]) for e in entries] == [
        ("CallHelp", 0, 300, None),
        ("SoundAlarm", 300, 300, None),
        ("OpenDoor", 0, 60, "CallHelp"),
    ]
    assert "schedule:\n  CallHelp " in cli("explain", "a.sleec", "--when", "Smoke").out
    plain = cli("entail", "b.sleec", "--when", "A", "--format", "json", files={"b.sleec": "WHEN A THEN B\n"})
    assert "schedule" not in json.loads(plain.out)
    later = cli(
        "entail", "c.sleec", "--when", "A", "--untimed", "eventually", files={"c.sleec": "WHEN A THEN B ELSE C\n"}
    )
    assert "eventually" in later.out


# The published schemas, on what the commands really print


TIMED = "WHEN Rung THEN Open WITHIN 5 minutes\nWHEN Rung THEN NOT Open WITHIN 10 minutes\n"
CAUSING = "WHEN Rung THEN Open\nWHEN Open THEN Greet\nWHEN Greet THEN Open\n"


@pytest.mark.parametrize("path", sorted((ROOT / "rulesets").glob("*.sleec")), ids=lambda path: path.stem)
def test_reports_on_the_shipped_rulesets_fit_the_schema(path: Path, cli: Cli) -> None:
    jsonschema.validate(json.loads(cli("check", str(path), "--format", "json").out), REPORT)


def test_reports_on_times_fit_the_schema(cli: Cli) -> None:
    report = json.loads(cli("check", "a.sleec", "--format", "json", files={"a.sleec": TIMED}).out)
    jsonschema.validate(report, REPORT)
    (ruleset,) = report["rulesets"]
    assert ruleset["untimed"] == "at"
    assert any("timeline" in finding for finding in ruleset["findings"])


@pytest.mark.parametrize("code", sorted(CHECKED_CODES := {k.code: k.bad for c in CHECKS.values() for k in c.kinds}))
def test_reports_on_every_bad_example_fit_the_schema(code: str, cli: Cli) -> None:
    files = {"a.sleec": CHECKED_CODES[code]}
    report = json.loads(cli("check", "a.sleec", "--realizable", "1", "--format", "json", files=files).out)
    jsonschema.validate(report, REPORT)
    assert code in [finding["code"] for ruleset in report["rulesets"] for finding in ruleset["findings"]]


def test_reports_on_code_fit_the_schema(cli: Cli) -> None:
    rules = str(ROOT / "rulesets" / "household.sleec")
    ran = cli("conform", "empty.py", "--ruleset", rules, "--format", "json", files={"empty.py": "x = 1\n"})
    report = json.loads(ran.out)
    jsonschema.validate(report, REPORT)
    assert ran.code == 1
    assert report["rulesets"][0]["findings"]


@pytest.mark.parametrize("rules", [TIMED, CAUSING])
def test_entailments_with_more_to_tell_fit_the_schema(rules: str, cli: Cli) -> None:
    ran = cli("entail", "a.sleec", "--when", "Rung", "--format", "json", files={"a.sleec": rules})
    answer = json.loads(ran.out)
    jsonschema.validate(answer, ENTAILMENT)
    assert "timed" in answer or "chain" in answer


@pytest.mark.parametrize("criterion", ["clause", "mcdc"])
def test_cases_fit_the_schema(criterion: str, cli: Cli) -> None:
    ran = cli("cases", "a.sleec", "--coverage", criterion, "--format", "json", files={"a.sleec": CLASH})
    jsonschema.validate(json.loads(ran.out), CASES)


ONCE = """\
DOMAIN home
MEASURE Age: number
MEASURE Risk: low < high
EXCLUSIVE Open, Shut
ASSUME NOT (Night AND Noon)
RULE one
WHEN Rung THEN Open
UNLESS Age < 0.3 AND Risk = high IN WHICH CASE Ask
RULE two
WHEN Rung AND Late THEN Greet
"""
DSL = """\
def_start
    event A
    event B
    measure c: boolean
def_end
rule_start
    R1 when A then B unless {c}
rule_end
"""
WEIGHED = ONCE.replace("Late", "Age > Weight").replace("MEASURE Age", "MEASURE Weight: number\nMEASURE Age")
FLAT = "WHEN A THEN B UNLESS C IN WHICH CASE D"
SOON = "WHEN A THEN B WITHIN 5 minutes"


@pytest.mark.parametrize(
    ("old", "new", "relation"),
    [
        pytest.param(ONCE, ONCE, "equivalent", id="the same"),
        pytest.param(ONCE, ONCE.replace("RULE two", "RULE due"), "equivalent", id="renamed"),
        pytest.param(ONCE, ONCE.replace("AND Late", "AND NOT NOT Late"), "equivalent", id="rewritten"),
        pytest.param(ONCE, ONCE.replace("0.3", "0.5"), "incomparable", id="another number"),
        pytest.param(ONCE, ONCE.replace("low < high", "low < middle < high"), "stricter", id="another scale"),
        pytest.param(ONCE, ONCE.replace("Greet", "Shut"), "incomparable", id="a new conflict"),
        pytest.param(ONCE.replace("Greet", "Shut"), ONCE, "incomparable", id="a conflict that is gone"),
        pytest.param(ONCE, ONCE.replace("home", "shop"), "incomparable", id="another domain"),
        pytest.param(ONCE, ONCE.replace("NOT (Night AND Noon)", "Night"), "incomparable", id="situations"),
        pytest.param(ONCE, WEIGHED, "incomparable", id="numbers"),
        pytest.param(ONCE, ONCE.replace("AND Late", "AND Age"), "unknown", id="no ruleset"),
        pytest.param(FLAT, FLAT.replace("C IN", "C > 2 IN"), "unknown", id="a condition that is a measure"),
        pytest.param(SOON, SOON.replace("5", "9"), "laxer", id="times"),
        pytest.param(SOON, f"{SOON} OTHERWISE C", "laxer", id="times with alternatives"),
        pytest.param(SOON, SOON.replace("THEN", "THEN NOT"), "incomparable", id="when"),
        pytest.param(SOON, f"{SOON}\nWHEN C THEN NOT B WITHIN 9 minutes", "incomparable", id="a conflict over time"),
        pytest.param("WHEN A THEN B", DSL, "laxer", id="two languages"),
    ],
)
def test_differences_fit_the_schema(old: str, new: str, relation: str, cli: Cli) -> None:
    files = {"old.sleec": old + "\n", "new.sleec": new + "\n"}
    said = json.loads(cli("diff", "old.sleec", "new.sleec", "--format", "json", files=files).out)
    validator("diff").validate(said)
    assert said["relation"] == relation


def test_differences_that_are_not_counted_fit_the_schema(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.changes.diagram.variables.MOST_NAMES", 1)
    files = {"old.sleec": FLAT, "new.sleec": f"{FLAT} AND E"}
    said = json.loads(cli("diff", "old.sleec", "new.sleec", "--format", "json", files=files).out)
    jsonschema.validate(said, DIFFERENCE)
    (change,) = said["changes"]
    assert change["situations"]["reason"] == "it depends on more than 1 names"


def test_assertions_fit_the_schema(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    """One that holds, one that does not, and, as where a solver gives up, one of which nobody can tell."""
    asserted = ("never Ask when Age > 1", "never Open", "always Greet when Late")
    options = [part for one in asserted for part in ("--assert", one)]
    line = ("diff", "a.sleec", "a.sleec", *options, "--format", "json")
    said = json.loads(cli(*line, files={"a.sleec": ONCE}).out)
    jsonschema.validate(said, DIFFERENCE)
    assert [one["holds"] for one in said["assertions"]] == [True, False, False]

    def undecided(*_: object) -> None:
        raise Undecided("the solver gave up")

    monkeypatch.setattr("sleec_verify.changes.assertions.verification.smallest_situation", undecided)
    said = json.loads(cli(*line).out)
    jsonschema.validate(said, DIFFERENCE)
    assert None in [one["holds"] for one in said["assertions"]]


def test_differences_of_folders_fit_the_schema(cli: Cli) -> None:
    files = {"one/a.sleec": ONCE, "one/b.sleec": ONCE, "two/a.sleec": ONCE, "two/c.sleec": "WHEN"}
    for arguments in ([], ["--missing-as-empty"]):
        said = json.loads(cli("diff", "one", "two", *arguments, "--format", "json", files=files).out)
        jsonschema.validate(said, DIFFERENCE)
        assert len(said["rulesets"]) == 3


def test_every_key_of_a_difference_is_in_the_schema(cli: Cli) -> None:
    """Strict at every level: an unknown key anywhere, and a key that is missing anywhere, are refused."""
    files = {
        "old.sleec": ONCE,
        "new.sleec": ONCE.replace("Greet", "Shut").replace("0.3", "0.5").replace("Noon", "Late"),
    }
    line = ("old.sleec", "new.sleec", "--assert", "never Open", "--assert", "never Ask when Age > 3")
    said = json.loads(cli("diff", *line, "--format", "json", files=files).out)
    assert all(said[key] for key in ("changes", "conflicts", "situations", "names", "rulesets", "assertions"))
    fits = jsonschema.Draft202012Validator(DIFFERENCE).is_valid
    assert fits(said)
    for one in _objects(said):
        one["Unknown"] = {}
        assert not fits(said)
        del one["Unknown"]
        for key in list(one):
            kept = one.pop(key)
            assert not fits(said), key
            one[key] = kept


def _objects(value: Any) -> Iterator[dict[str, Any]]:
    """All objects in it, but for situations: their keys are names."""
    if isinstance(value, dict):
        yield value
        for key, inner in value.items():
            yield from () if key == "conditions" else _objects(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _objects(inner)


@pytest.mark.parametrize("broken", [{"rulesets": []}, {"tool": {}, "rulesets": [{"path": "a"}], "summary": {}}])
def test_the_schema_refuses_what_is_no_report(broken: dict[str, Any]) -> None:
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(broken, REPORT)
