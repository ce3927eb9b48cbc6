"""What is due in a situation of rules with time, compared with the check `conflict`."""

from __future__ import annotations

import json

import pytest

from sleec_runtime.language import parse
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.entailment.answer import Entailment
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.situation_text import parse_situation
from tests.support.cli import Cli

DIZZY = """RULE dizzy
WHEN the patient is dizzy THEN call the nurse
RULE round
WHEN the round starts THEN NOT call the nurse WITHIN 10 minutes
"""


def asked(text: str, when: str, given: str = "", untimed: Untimed = "at") -> Entailment:
    ruleset = parse(text)
    return entail(ruleset, parse_situation(ruleset, when, given), untimed=untimed)


def test_an_act_that_is_required_and_forbidden_over_time_is_a_contradiction() -> None:
    answer = asked(DIZZY, "the patient is dizzy, the round starts")
    assert answer.consistent is False
    assert answer.obligations == answer.prohibitions == ()
    assert [one.rules for one in answer.conflicts] == [("dizzy", "round")]
    assert asked(DIZZY, "the round starts").consistent


@pytest.mark.parametrize(
    ("text", "when", "required", "forbidden", "alternatives"),
    [
        ("WHEN A THEN X ELSE Y", "A", (), (), ("X, or else Y",)),
        ("WHEN A THEN X AND Z ELSE Y", "A", ("X",), (), ("Z, or else Y",)),
        ("WHEN A THEN NOT X ELSE Y", "A", (), (), ("NOT X, or else Y",)),
        ("WHEN A THEN X WITHIN 5 minutes OTHERWISE Y", "A", (), (), ("X within 5 minutes, or else Y",)),
        ("WHEN A THEN X WITHIN 5 minutes", "A", ("X",), (), ()),
        # The other side is impossible.
        ("WHEN A THEN X ELSE Y\nWHEN B THEN NOT X", "A,B", ("Y",), ("X",), ("X, or else Y",)),
        ("WHEN A THEN NOT X ELSE Y\nWHEN B THEN NOT Y", "A,B", (), ("X", "Y"), ("NOT X, or else Y",)),
        # An obligation has a later time, so the other side is not required.
        (
            "WHEN A THEN X WITHIN 5 minutes OTHERWISE Y\nWHEN B THEN NOT X",
            "A,B",
            (),
            ("X",),
            ("X within 5 minutes, or else Y",),
        ),
        # The situation decides hedges inside alternatives.
        ("WHEN A THEN X ELSE (Y UNLESS c IN WHICH CASE Z)", "A", (), (), ("X, or else Y",)),
        ("WHEN A THEN X ELSE (Y UNLESS c)\nWHEN B THEN NOT c1", "A", (), (), ("X, or else Y",)),
        ("WHEN A THEN X ELSE (Y ELSE Z)", "A", (), (), ("X, or else Y, or else Z",)),
    ],
)
def test_alternatives_are_shown_as_a_whole(
    text: str, when: str, required: tuple[str, ...], forbidden: tuple[str, ...], alternatives: tuple[str, ...]
) -> None:
    answer = asked(text, when)
    assert answer.consistent
    assert (answer.obligations, answer.prohibitions) == (required, forbidden)
    assert tuple(one.words for one in answer.alternatives) == alternatives


@pytest.mark.parametrize(
    ("text", "when"),
    [
        ("WHEN A THEN X ELSE Y\nWHEN B THEN NOT X\nWHEN C THEN NOT Y", "A,B,C"),
        ("WHEN A THEN X WITHIN 2 seconds\nWHEN B THEN NOT X WITHIN 3 seconds", "A,B"),
        ("WHEN A THEN X\nWHEN X THEN NOT Y\nWHEN A THEN Y", "A"),
        ("RELATION X EXCLUDES Y\nWHEN A THEN X\nWHEN B THEN Y", "A,B"),
        ("RELATION C PRECEDES X\nWHEN A THEN X\nWHEN C THEN Y", "A"),
        ("WHEN A THEN NOT A WITHIN 5 seconds", "A"),
    ],
)
def test_contradictions(text: str, when: str) -> None:
    answer = asked(text, when)
    assert answer.consistent is False
    assert answer.conflicts


def test_a_condition_that_names_an_act_is_decided_by_the_response() -> None:
    text = "EVENT A, B, C, D\nWHEN A AND B THEN C\nWHEN A THEN NOT C\n"
    answer = asked(text + "WHEN D THEN B", "A")
    assert answer.consistent
    assert (answer.obligations, answer.prohibitions) == ((), ("C",))
    assert asked(text + "WHEN A THEN B", "A").consistent is False


def test_a_rule_that_forbids_an_event_of_the_situation_is_no_contradiction() -> None:
    answer = asked("WHEN A THEN NOT B WITHIN 5 seconds\nWHEN B THEN X", "A,B")
    assert answer.consistent
    assert answer.obligations == ("X",)


def test_responses_without_a_window_may_be_due_at_any_time() -> None:
    text = "EXCLUSIVE X, Y\nWHEN A THEN X\nWHEN A THEN Y\nWHEN A THEN Z WITHIN 1 seconds"
    assert asked(text, "A").consistent is False
    assert asked(text, "A", untimed="eventually").consistent


def test_what_nothing_confirms_is_unknown(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.entailment.over_time.none_complies", lambda *_: None)
    when = ("--when", "the patient is dizzy,the round starts")
    for command in ("entail", "explain"):
        ran = cli(command, "rules.sleec", *when, files={"rules.sleec": DIZZY})
        assert ran.code == 3
        assert "it is not known whether the rules contradict each other here" in ran.out
    said = json.loads(cli("entail", "rules.sleec", *when, "--format", "json").out)
    assert said["consistent"] is None
    assert "too many responses" in said["undecided"]


def test_the_exit_code_is_that_of_the_answer(cli: Cli) -> None:
    files = {"rules.sleec": DIZZY}
    for command in ("entail", "explain"):
        assert cli(command, "rules.sleec", "--when", "the patient is dizzy,the round starts", files=files).code == 1
        assert cli(command, "rules.sleec", "--when", "the round starts").code == 0


def test_alternatives_in_the_output(cli: Cli) -> None:
    files = {"rules.sleec": "RULE r\nWHEN A THEN X ELSE NOT Y\nWHEN A THEN Z\n"}
    assert cli("entail", "rules.sleec", "--when", "A", files=files).out.splitlines()[:3] == [
        "required: Z",
        "required: X, or else NOT Y",
        "  r (rules.sleec:2): X, or else NOT Y",
    ]
    assert cli("entail", "rules.sleec", "--when", "A", "--format", "concise").out.splitlines() == [
        "Z",
        "X, or else NOT Y",
    ]
    assert "geboten: X, oder sonst NOT Y" in cli("entail", "rules.sleec", "--when", "A", "--language", "de").out
    said = json.loads(cli("entail", "rules.sleec", "--when", "A", "--format", "json").out)
    assert said["obligations"] == ["Z"]
    assert [one["text"] for one in said["alternatives"]] == ["X, or else NOT Y"]
    assert [[o["obligation"] for o in option] for option in said["alternatives"][0]["options"]] == [["X"], ["Y"]]
    assert said["because"][0]["obligations"] == []
    explained = cli("explain", "rules.sleec", "--when", "A").out
    assert "`A` triggers rule `r`: `X, or else NOT Y` is required (line 2)." in explained
    assert "Required: Z, (X, or else NOT Y)" in explained


def test_a_case_may_name_the_first_of_several_alternatives_or_not() -> None:
    answer = asked("WHEN A THEN X ELSE Y\nWHEN A THEN Z", "A")
    assert answer.with_choices(("X", "Y"), negated=False) == ("X", "Z")
    assert answer.with_choices((), negated=False) == ("Z",)
