"""The auditor: tolerance, windows, prohibitions, domains, unreported values, and names."""

from __future__ import annotations

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, Reported
from sleec_runtime.audit.wording import message, reasons
from sleec_runtime.errors import UnknownDomain, WrongType
from sleec_runtime.language import parse
from sleec_runtime.model import exact
from tests.support.missions import audit

CURTAINS = """
RULE curtains WHEN CurtainOpenRequest THEN CurtainOpened
  UNLESS UserUndressed IN WHICH CASE NOT CurtainOpened AND RefuseRequest
"""
FALL = """
MEASURE patience: integer
RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 1 minute
RULE rest WHEN UserSleeps THEN NOT Vacuum WITHIN patience minutes
RULE walk WHEN MorningComes THEN OfferWalk WITHIN 10 TO 60 minutes
"""


def mission(text: str) -> list[Observation]:
    """`1 c=true n=3 @home A !X`: at 1 s, two conditions are reported, a domain is entered, A occurs, X is executed."""
    found: list[Observation] = []
    for part in text.split("|"):
        at, *words = part.split()
        exact_time = exact(float(at)) or 0
        for word in words:
            name, _, value = word.partition("=")
            known = {"true": True, "false": False, "?": None}
            if value:
                found.append(Reported(exact_time, {name: known[value] if value in known else int(value)}))
            elif word[0] == "@":
                found.append(Entered(exact_time, word[1:] or None))
            elif word[0] == "!":
                found.append(Executed(exact_time, word[1:]))
            else:
                found.append(Occurred(exact_time, word))
    return found


def kinds(rules: str, text: str, end: int | None = 10**6, **options) -> list[tuple[str, float, str]]:
    found = audit(Auditor(parse(rules), **options), mission(text), end)
    return [(d.kind, float(d.time), d.name or (d.obligation.name if d.obligation else "")) for d in found]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0 UserUndressed=false | 1 CurtainOpenRequest | 1.5 !CurtainOpened", []),
        ("0 UserUndressed=false | 1 CurtainOpenRequest | 2 !CurtainOpened", []),
        (
            "0 UserUndressed=false | 1 CurtainOpenRequest | 2.1 !CurtainOpened",
            [("missed", 1, "CurtainOpened"), ("unrequired", 2.1, "CurtainOpened")],
        ),
        ("0 UserUndressed=true | 1 CurtainOpenRequest | 1.5 !RefuseRequest", []),
        (
            "0 UserUndressed=true | 1 CurtainOpenRequest | 1.5 !RefuseRequest !CurtainOpened",
            [("prohibited", 1.5, "CurtainOpened")],
        ),
        # The prohibition of the first request ends when the second one requires the obligation.
        (
            (
                "0 UserUndressed=true | 1 CurtainOpenRequest | 1.1 !RefuseRequest | 1.2 UserUndressed=false"
                " | 1.3 CurtainOpenRequest | 1.5 !CurtainOpened"
            ),
            [],
        ),
        # A request is decided by what was reported before it.
        ("1 UserUndressed=true CurtainOpenRequest UserUndressed=false | 1.1 !RefuseRequest", []),
        # One obligation is executed twice, for example for two rules.
        ("0 UserUndressed=false | 1 CurtainOpenRequest | 1.5 !CurtainOpened | 1.6 !CurtainOpened", []),
        # Two requests need two executions, also if the first is late.
        (
            "0 UserUndressed=false | 1 CurtainOpenRequest | 1.2 CurtainOpenRequest | 1.5 !CurtainOpened",
            [("missed", 1.2, "CurtainOpened")],
        ),
        (
            (
                "0 UserUndressed=false | 1 CurtainOpenRequest | 1.9 CurtainOpenRequest | 1.9 !CurtainOpened"
                " | 2.5 !CurtainOpened"
            ),
            [],
        ),
        # A coarse clock gives executions the same time.
        ("0 UserUndressed=false | 1 CurtainOpenRequest | 2 CurtainOpenRequest !CurtainOpened !CurtainOpened", []),
        (
            "0 UserUndressed=false | 1 CurtainOpenRequest | 2 CurtainOpenRequest !CurtainOpened",
            [("missed", 2, "CurtainOpened")],
        ),
        # An event that is an obligation, too, does not end the time in which it is required.
        ("0 UserUndressed=false | 1 CurtainOpenRequest | 1.5 CurtainOpened | 2 !CurtainOpened", []),
        (
            "0 UserUndressed=false | 1 CurtainOpenRequest | 1.5 CurtainOpened | 2.1 !CurtainOpened",
            [("unrequired", 2.1, "CurtainOpened")],
        ),
        ("1 CurtainOpenRequest | 1.5 !CurtainOpened", [("undetermined", 1, "")]),
        (
            "0 UserUndressed=false | 1 UserUndressed=? | 2 CurtainOpenRequest | 2.1 !CurtainOpened",
            [("undetermined", 2, "")],
        ),
    ],
)
def test_obligations_without_a_window(text: str, expected: list[tuple[str, float, str]]) -> None:
    assert kinds(CURTAINS, text) == expected


def test_tolerance_zero_is_exact() -> None:
    text = "0 UserUndressed=false | 1 CurtainOpenRequest | 1.1 !CurtainOpened"
    assert kinds(CURTAINS, text, tolerance=0)[0] == ("missed", 1, "CurtainOpened")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("10 UserFell | 310 !CallNurse", []),
        ("10 UserFell | 311 !CallNurse", []),
        ("10 UserFell | 312 !CallNurse | 320 !CallAmbulance", [("unrequired", 312, "CallNurse")]),
        ("10 UserFell | 400 !CallNurse", [("missed", 370, "CallAmbulance"), ("unrequired", 400, "CallNurse")]),
        ("10 UserFell | 20 UserFell | 30 !CallNurse", []),
        ("0 patience=2 | 10 UserSleeps | 130 !Vacuum", [("prohibited", 130, "Vacuum")]),
        ("0 patience=2 | 10 UserSleeps | 130.5 !Vacuum", [("unrequired", 130.5, "Vacuum")]),
        (
            "0 patience=2 | 10 UserSleeps | 20 patience=0 | 30 !Vacuum",
            [("prohibited", 30, "Vacuum")],
        ),
        ("10 UserSleeps | 20 !Vacuum", [("undetermined", 10, "NOT Vacuum"), ("unrequired", 20, "Vacuum")]),
        ("0 MorningComes | 700 !OfferWalk", []),
        ("0 MorningComes | 60 !OfferWalk", [("unrequired", 60, "OfferWalk"), ("missed", 3600, "OfferWalk")]),
    ],
)
def test_windows(text: str, expected: list[tuple[str, float, str]]) -> None:
    found = [(kind, at, name.removeprefix("NOT ")) for kind, at, name in kinds(FALL, text)]
    assert found == [(kind, at, name.removeprefix("NOT ")) for kind, at, name in expected]


def test_a_mission_may_end_before_a_window_closes() -> None:
    assert kinds(FALL, "10 UserFell", end=None) == [("open", 10, "CallNurse")]
    assert kinds(FALL, "10 UserFell", end=311) == [("open", 311, "CallNurse")]
    assert kinds(FALL, "0 patience=2 | 10 UserSleeps", end=None) == []


def test_deviations_come_as_soon_as_they_are_certain() -> None:
    auditor = Auditor(parse(FALL))
    for observation in mission("0 patience=1 | 10 UserFell"):
        assert auditor.observe(observation) == []
    assert auditor.advance(371) == []
    (missed,) = auditor.advance(372)
    assert (missed.kind, missed.time) == ("missed", 370)
    assert message(missed) == "at 370 s, `CallAmbulance` has not been executed, and rule `fall` requires it since 10 s"
    assert reasons(missed) == ["fall requires CallAmbulance within 1 minute"]


DOMAINS = """
DOMAIN home
RULE open WHEN Request THEN Open
DOMAIN hospital
RULE wait WHEN Request THEN Wait
"""


def test_a_domain_change_selects_other_rules() -> None:
    text = "0 @home | 1 Request | 1.1 !Open | 5 @hospital | 6 Request | 6.1 !Wait"
    assert kinds(DOMAINS, text) == []
    assert kinds(DOMAINS, text, domain="hospital") == []
    assert [kind for kind, _, _ in kinds(DOMAINS, "1 Request | 1.1 !Open")] == ["missed"]
    assert kinds(DOMAINS, "1 Request | 1.1 !Open", domain="home") == []
    assert kinds(DOMAINS, "0 @house") == [("unknown-name", 0, "house")]


def test_constraints_of_a_domain_are_decided_when_the_domain_begins() -> None:
    rules = """
        CONDITION Night, Sunny, Loud
        ASSUME NOT (Night AND Loud)
        DOMAIN home
        RULE open WHEN Request THEN Open
        DOMAIN ward
        ASSUME NOT (Night AND Sunny)
    """
    start = "0 @home | 1 Night=true Sunny=true Loud=true | "
    everywhere = [("assumption", 1)]
    for text, expected in (
        ("5 @ward", [("assumption", 5)]),
        ("5 @ward | 6 @home | 7 @ward | 8 @ward", [("assumption", 5), ("assumption", 7)]),
        ("5 Sunny=false @ward | 6 Sunny=true", [("assumption", 6)]),
        ("5 @ward Sunny=false", []),
        ("5 Sunny=? @ward", []),
        ("5 @home", []),
    ):
        assert [(kind, at) for kind, at, _ in kinds(rules, start + text)] == everywhere + expected, text


def test_in_an_unknown_domain_only_the_rules_of_domains_are_not_decided() -> None:
    rules = f"OBLIGATION Open, Wait, Lift, Drop\nRULE lift WHEN Call THEN Lift\n{DOMAINS}NEVER Wait AND Drop\n"
    text = "0 @home | 1 Request | 1.1 !Open | 5 @ward | 6 Request Call | 6.1 !Lift !Wait !Drop | 9 @home | 10 Request"
    found = [(d.kind, float(d.time), d.rule) for d in audit(Auditor(parse(rules)), mission(text), 99)]
    assert found == [
        ("unknown-name", 5, None),
        ("undetermined", 6, "open"),
        ("undetermined", 6, "wait"),
        ("unrequired", 6.1, None),
        ("undetermined", 6, None),
        ("missed", 10, "open"),
    ]
    auditor = Auditor(parse(DOMAINS))
    *_, deviation = audit(auditor, mission("0 @ward | 1 Request"), None)
    assert message(deviation) == "at 1 s, rule `wait` cannot be decided: the domain is not known"
    # A ruleset without domains applies everywhere.
    assert kinds("RULE lift WHEN Call THEN Lift", "0 @ward | 1 Call") == [
        ("unknown-name", 0, "ward"),
        ("missed", 1, "Lift"),
    ]


CONSTRAINTS = """
CONDITION Dark, Sunny
OBLIGATION Stop, Drive
EXCLUSIVE Stop, Drive
NEVER Drive AND Dark
ASSUME NOT (Dark AND Sunny)
RULE go WHEN Go THEN Drive UNLESS Sunny IN WHICH CASE NOT Drive
RULE halt WHEN Halt THEN Stop
"""


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 Go | 1.1 !Drive | 10 Halt | 10.1 !Stop", []),
        ("1 Go | 1.1 !Drive | 1.2 Halt | 1.3 !Stop", []),
        ("1 Halt Go | 1.1 !Drive | 1.3 !Stop", ["constraint"]),
        ("1 Dark=true | 2 Go | 2.1 !Drive", ["constraint"]),
        ("2 Go | 2.05 Dark=true | 2.1 !Drive", ["constraint"]),
        ("2 Go | 2.1 !Drive | 2.2 Dark=true", []),
        ("3 Sunny=true | 4 Dark=true", ["assumption"]),
        ("3 Sunny=true Dark=true", ["assumption"]),
        ("1 Dark=? | 2 Go | 2.1 !Drive", ["undetermined"]),
        ("1 Dark=? | 2 Go | 2.1 !Drive | 2.2 Dark=true | 2.3 !Drive", ["constraint"]),
        ("1 Dark=true | 2 Go | 2.1 !Drive | 2.2 Dark=? | 2.3 !Drive", ["constraint"]),
    ],
)
def test_constraints(text: str, expected: list[str]) -> None:
    assert [kind for kind, _, _ in kinds(CONSTRAINTS, f"0 Dark=false Sunny=false | {text}")] == expected


TOGETHER = """
OBLIGATION Drive, Honk, Stop
NEVER Drive AND NOT Honk
EXCLUSIVE Drive, Stop
RULE go WHEN Go THEN Drive AND Honk
"""
WITNESS = """
def_start
  event Go
  event Drive
  event Honk
def_end
rule_start
  R1 when Go then Drive
  R2 when Go then Honk
rule_end
relation_start
  witness Drive Honk
relation_end
"""


@pytest.mark.parametrize("rules", [TOGETHER, WITNESS])
def test_a_constraint_is_open_if_the_log_ends_before_an_event_that_it_requires(rules: str) -> None:
    text = "1 Go | 1.1 !Drive"
    assert kinds(rules, f"{text} | 1.2 !Honk", end=None) == []
    assert kinds(rules, text, end=None) == [("open", 1.1, ""), ("open", 1.1, "Honk")]
    assert kinds(rules, text, end=2) == [("open", 2, ""), ("open", 2, "Honk")]
    assert [kind for kind, _, _ in kinds(rules, text, end=3)] == ["missed", "constraint"]
    auditor = Auditor(parse(rules))
    assert [message(one) for one in audit(auditor, mission(text), None) if one.statement is not None] == [
        f"at 1.1 s, the log ends within the tolerance, and `{statement}` does not hold yet"
        for statement in ("NEVER Drive AND NOT Honk" if rules is TOGETHER else "Drive WITNESSES Honk",)
    ]


def test_events_that_exclude_each_other_break_a_constraint_also_at_the_end_of_the_log() -> None:
    found = kinds(TOGETHER, "1 Go | 1.1 !Drive !Honk | 1.2 !Stop", end=None)
    assert [kind for kind, _, _ in found] == ["unrequired", "constraint"]


CHAIN = """
RULE guest WHEN GuestArrives THEN TurnOnLight
RULE dark WHEN TurnOnLight THEN CloseCurtains
"""


def test_an_alternative_to_a_window_of_negative_length_is_not_decided() -> None:
    rules = "MEASURE wait: integer\nRULE a WHEN A THEN X WITHIN wait seconds OTHERWISE Y"
    found = audit(Auditor(parse(rules)), mission("0 wait=-3 | 10 A | 12 !Y"), 30)
    assert [message(one) for one in found if one.kind != "unrequired"] == [
        "at 10 s, rule `a` cannot be decided: a window has a negative length"
    ]
    unreported = audit(Auditor(parse(rules)), mission("10 A | 12 !Y"), 30)
    assert message(unreported[0]) == "at 10 s, rule `a` cannot be decided: `wait` was not reported"


def test_with_chains_an_execution_triggers_rules() -> None:
    text = "1 GuestArrives | 1.1 !TurnOnLight"
    assert kinds(CHAIN, text) == [("missed", 1.1, "CloseCurtains")]
    assert kinds(CHAIN, text, chains=False) == []
    assert kinds(CHAIN, "1 TurnOnLight | 1.5 !CloseCurtains", chains=False) == []
    assert kinds(CHAIN, "1 GuestArrives | 1.5 TurnOnLight | 1.6 !CloseCurtains", chains=False) == [
        ("missed", 1, "TurnOnLight")
    ]


@pytest.mark.parametrize(
    ("observation", "detail"),
    [
        (Occurred(1, "UserFel"), "the ruleset has no event 'UserFel'; did you mean `UserFell`?"),
        (Reported(1, {"patince": 3}), "the ruleset has no condition 'patince'; did you mean `patience`?"),
        (Executed(1, "patience"), "the ruleset has no obligation 'patience': this is a condition"),
    ],
)
def test_an_unknown_name_is_reported_once(observation: Observation, detail: str) -> None:
    auditor = Auditor(parse(FALL))
    (found,) = auditor.observe(observation)
    assert (found.kind, found.detail) == ("unknown-name", detail)
    assert auditor.observe(observation) == []


def test_a_wrong_value_counts_as_not_reported() -> None:
    found = kinds(FALL, "0 patience=true | 10 UserSleeps")
    assert found == [("wrong-value", 0, "patience"), ("undetermined", 10, "Vacuum")]


def test_an_observation_out_of_order_counts_as_simultaneous() -> None:
    found = kinds(CURTAINS, "0 UserUndressed=false | 5 CurtainOpenRequest | 4 !CurtainOpened")
    assert found == [("out-of-order", 4, "")]


def test_a_wrong_value_and_a_wrong_order_are_said_in_a_sentence() -> None:
    auditor = Auditor(parse(CURTAINS))
    auditor.observe(Occurred(5, "CurtainOpenRequest"))
    (late, wrong) = auditor.observe(Reported(4, {"UserUndressed": 3}))
    assert message(late) == "at 4 s, an observation is 1 s earlier than the one before it"
    value = "the value of `UserUndressed` does not fit: UserUndressed is a condition, true or false; got 3"
    assert message(wrong) == f"at 5 s, {value}"


def test_wrong_arguments_are_refused() -> None:
    for tolerance in (-1, float("nan"), float("inf"), 10**13, True, "1"):
        with pytest.raises(WrongType):
            Auditor(parse(FALL), tolerance=tolerance)  # type: ignore[arg-type]
    with pytest.raises(UnknownDomain):
        Auditor(parse(DOMAINS), domain="house")


def test_reasons_name_the_conditions_that_decided() -> None:
    auditor = Auditor(parse(CURTAINS))
    text = "0 UserUndressed=true | 1700000000.25 CurtainOpenRequest | 1700000002 CurtainOpenRequest !RefuseRequest"
    found: list[Deviation] = audit(auditor, mission(text))
    assert message(found[0]) == (
        "at 2023-11-14T22:13:20.250000Z, `RefuseRequest` has not been executed, and rule `curtains.hc1` requires it at "
        "this time"
    )
    assert len(found) == 1
    assert reasons(found[0]) == ["clause 1: UserUndressed is true"]
