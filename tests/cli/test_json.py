"""The JSON that programs read has the shape that the design promises."""

from __future__ import annotations

import json

import jsonschema
import pytest

from tests.cli.conftest import Cli

SPAN = {
    "type": "object",
    "required": ["line", "column", "end_line", "end_column"],
    "additionalProperties": {"type": "integer", "minimum": 1},
}
NAMES = {"type": "array", "items": {"type": "string"}}
VALUE = {"type": ["boolean", "number", "string"]}
TEXT = {"type": "string", "minLength": 1}
FINDING = {
    "type": "object",
    "required": ["code", "check", "severity", "message", "rules", "clauses", "obligations", "span", "witness"],
    "properties": {
        "code": {"pattern": "^SLEEC[0-9]{3}$"},
        "check": TEXT,
        "severity": {"enum": ["error", "warning", "note"]},
        "message": TEXT,
        "rules": NAMES,
        "clauses": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["rule", "clause"],
                "properties": {"rule": TEXT, "clause": {"type": "integer", "minimum": 0}},
                "additionalProperties": False,
            },
        },
        "obligations": NAMES,
        "span": SPAN,
        "witness": {
            "type": ["object", "null"],
            "required": ["triggers", "conditions"],
            "properties": {"triggers": NAMES, "conditions": {"type": "object", "additionalProperties": VALUE}},
            "additionalProperties": False,
        },
        "domains": NAMES,
        "related": {
            "type": "array",
            "items": {"type": "object", "required": ["span", "message"], "properties": {"span": SPAN}},
        },
        "note": {"type": ["string", "null"]},
        "help": {"type": ["string", "null"]},
    },
    "additionalProperties": False,
}
CHECKED = {
    "type": "object",
    "required": ["path", "sha256", "syntax", "reading", "rules", "hedges", "checks", "findings"],
    "properties": {
        "path": TEXT,
        "sha256": {"pattern": "^[0-9a-f]{64}$"},
        "syntax": {"enum": ["english", "dsl"]},
        "reading": {"enum": ["cascade", "priority"]},
        "rules": {"type": "integer"},
        "hedges": {"type": "integer"},
        "checks": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["name", "verdict", "seconds", "reason"],
                "properties": {
                    "name": TEXT,
                    "verdict": {"enum": ["proved", "refuted", "unknown"]},
                    "seconds": {"type": "number", "minimum": 0},
                    "reason": {"type": ["string", "null"]},
                },
                "additionalProperties": False,
            },
        },
        "findings": {"type": "array", "items": FINDING},
    },
    "additionalProperties": False,
}
UNUSABLE = {
    "type": "object",
    "required": ["path", "error"],
    "properties": {
        "path": TEXT,
        "error": {
            "type": "object",
            "required": ["message", "hint", "problems"],
            "properties": {
                "problems": {
                    "type": "array",
                    "items": {
                        "type": "object",
                        "required": ["message", "hint", "span"],
                        "properties": {"message": TEXT, "span": SPAN},
                    },
                }
            },
        },
    },
    "additionalProperties": False,
}
COUNT = {"type": "integer", "minimum": 0}
REPORT = {
    "type": "object",
    "required": ["tool", "rulesets", "summary"],
    "properties": {
        "tool": {
            "type": "object",
            "required": ["name", "version"],
            "properties": {"name": {"const": "sleec-verify"}, "version": TEXT},
            "additionalProperties": False,
        },
        "rulesets": {"type": "array", "items": {"oneOf": [CHECKED, UNUSABLE]}},
        "summary": {
            "type": "object",
            "required": ["errors", "warnings", "notes"],
            "additionalProperties": COUNT,
        },
    },
    "additionalProperties": False,
}
ENTAILMENT = {
    "type": "object",
    "required": ["consistent", "obligations", "prohibitions", "because"],
    "properties": {
        "consistent": {"type": "boolean"},
        "obligations": NAMES,
        "prohibitions": NAMES,
        "because": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["rule", "clause", "layer", "obligations"],
                "properties": {
                    "rule": TEXT,
                    "clause": COUNT,
                    "layer": {"type": ["string", "null"]},
                    "obligations": NAMES,
                },
                "additionalProperties": False,
            },
        },
        "conflicts": {"type": "array", "items": FINDING, "minItems": 1},
        "broken_assumptions": {"type": "array", "items": SPAN, "minItems": 1},
        "missing": {**NAMES, "minItems": 1},
    },
    "additionalProperties": False,
}

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
    assert "at some time" in later.out
