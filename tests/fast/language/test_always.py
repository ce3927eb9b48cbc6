"""ALWAYS and NEVER: rules without a trigger, their instances, and their text."""

from __future__ import annotations

import pytest

from sleec_runtime import Monitor, Sleec
from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Never
from sleec_verify.checks import run_checks

RULES = (
    "WHEN the user calls THEN answer\nUNLESS the user is deaf IN WHICH CASE wave\n\nWHEN the door opens THEN greet\n"
)


def test_an_always_is_a_rule_for_each_trigger() -> None:
    ruleset = parse(f"{RULES}\nALWAYS be polite\nUNLESS the alarm rings IN WHICH CASE NOT be polite\n")
    explicit = parse(
        f"{RULES}\nWHEN the user calls THEN be polite UNLESS the alarm rings IN WHICH CASE NOT be polite\n"
        "WHEN the door opens THEN be polite UNLESS the alarm rings IN WHICH CASE NOT be polite\n"
    )
    instances = [rule for rule in ruleset.rules if rule.always]
    assert [rule.label for rule in instances] == ["always_1_the_user_calls", "always_1_the_door_opens"]
    assert {rule.always for rule in instances} == {"always_1"}
    for one, other in zip(ruleset.rules, explicit.rules):
        assert (one.trigger, one.guard, one.default, one.hedges) == (
            other.trigger,
            other.guard,
            other.default,
            other.hedges,
        )


def test_declared_triggers_count_and_responses_do_not() -> None:
    text = "TRIGGER a, b\nEVENT c, d\nALWAYS smile\nOBLIGATION smile\nWHEN a THEN c\nWHEN c THEN d\n"
    assert [rule.trigger for rule in parse(text).rules if rule.always] == ["a", "c", "b"]


@pytest.mark.parametrize(
    "text",
    [
        f"ALWAYS be polite\n\n{RULES}",
        f"// above\nALWAYS be polite AND NOT shout  // behind\n// inside\nUNLESS the alarm rings  // here\n\n{RULES}",
        f"{RULES}\nDOMAIN hospital\n\nALWAYS whisper WITHIN 5 minutes\n\nALWAYS wear a badge\n",
        f"ALWAYS (smile\n    UNLESS the user is sad IN WHICH CASE comfort)\n\n{RULES}",
        f"NEVER shout UNLESS the alarm rings OR the user is deaf UNLESS NOT awake\n\n{RULES}",
        f"RELATION ALWAYS dry EXCLUDES wet\n\n{RULES}",
        f"NEVER shout AND whisper\nNEVER (shout OR whisper) AND NOT x UNLESS y\n\n{RULES}",
    ],
)
def test_the_text_is_canonical(text: str) -> None:
    ruleset = parse(text)
    assert print_ruleset(ruleset) == text
    assert parse(print_ruleset(ruleset)) == ruleset


def test_the_numbers_of_rules_do_not_change() -> None:
    text = f"ALWAYS be polite\n{RULES}"
    assert [rule.label for rule in parse(text).rules if not rule.always] == ["rule_1", "rule_2"]


def test_comments_inside_a_never_are_kept() -> None:
    text = f"NEVER shout // a\n// b\nUNLESS the alarm rings // c\nUNLESS the user is deaf // d\n{RULES}"
    printed = print_ruleset(parse(text))
    assert sorted(word for word in printed.split() if word in "abcd" and len(word) == 1) == list("abcd")
    assert print_ruleset(parse(printed)) == printed


def test_an_exception_of_never_is_a_negated_condition() -> None:
    (with_exception, *_), (without, *_) = (
        parse(f"{text}\nCONDITION the alarm rings, the user is deaf\n{RULES}").statements
        for text in ("NEVER shout UNLESS the alarm rings", "NEVER shout AND NOT the alarm rings")
    )
    assert isinstance(with_exception, Never)
    assert isinstance(without, Never)
    assert with_exception.formula == without.formula


def test_labels_differ_although_the_triggers_look_alike() -> None:
    rules = parse("ALWAYS smile\nWHEN a b THEN x\nWHEN a_b THEN y\nWHEN a-b THEN z\n").rules
    assert [rule.label for rule in rules if rule.always] == ["always_1_a_b", "always_1_a_b_2", "always_1_a_b_3"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("ALWAYS be polite", "there are no rules in this text"),
        (f"ALWAYS\n{RULES}", "expected an obligation"),
        (f"ALWAYS a OR b\n{RULES}", "expected the end of the response, but found `OR`"),
        (f"ALWAYS a THEN b\n{RULES}", "expected AND, UNLESS or the next statement, but found `THEN`"),
        (f"ALWAYS a UNLESS\n{RULES}", "expected a condition"),
        ("WHEN a THEN ALWAYS b\n", "expected an obligation, but found `ALWAYS`"),
        (f"NEVER shout UNLESS x IN WHICH CASE y\n{RULES}", "expected the next statement, but found `IN WHICH CASE`"),
        (f"NEVER shout UNLESS\n{RULES}", "expected a condition"),
        ("RULE always_1_a WHEN a THEN b\nALWAYS c\n", "`always_1_a` is also the name of the rule without a label"),
    ],
)
def test_mistakes_are_reported(text: str, message: str) -> None:
    with pytest.raises(LanguageError) as raised:
        parse(text)
    (problem,) = raised.value.problems
    assert problem.message.startswith(message)


@pytest.mark.parametrize("keyword", ["NEVER", "ALWAYS"])
@pytest.mark.parametrize(
    "text",
    [
        "WHEN a THEN the robot {} leaves\n",
        "WHEN a THEN robot {} leaves UNLESS c IN WHICH CASE d\n",
        "WHEN a THEN greet\nUNLESS the user is {} alone IN WHICH CASE wave\n",
        "WHEN a AND the user is {} alone THEN greet\n",
        "WHEN a THEN leave WITHIN 5 minutes {} later\n",
        "WHEN a THEN (leave AND wave) {} shout\n",
        "ASSUME the user is {} alone\nWHEN a THEN greet\n",
        "WHEN a THEN greet\nEXCLUSIVE greet, the robot {} leaves\nASSUME c\n",
    ],
)
def test_no_statement_begins_inside_a_sentence(text: str, keyword: str) -> None:
    with pytest.raises(LanguageError) as raised:
        parse(text.format(keyword))
    (problem,) = raised.value.problems
    assert problem.message == f"unexpected `{keyword}`"
    assert problem.hint is not None
    assert problem.hint.startswith("inside a sentence, ")


@pytest.mark.parametrize(
    "before", ["WHEN a THEN greet.", "WHEN a THEN greet\n", "WHEN a THEN Greet_now", "WHEN a THEN B"]
)
def test_a_statement_begins_a_line_or_follows_a_stop_or_name(before: str) -> None:
    assert [type(one) for one in parse(f"{before} NEVER leave alone").statements[1:]] == [Never]
    assert len(parse(f"{before} ALWAYS smile").rules) == 2


def test_what_contradicts_is_found_once() -> None:
    (conflict,) = findings(f"ALWAYS answer politely\nNEVER answer politely UNLESS the alarm rings\n{RULES}", "conflict")
    assert conflict.witness is not None
    assert len(conflict.witness.triggers) == 1
    (conflict,) = findings(f"ALWAYS wait\nWHEN the bell rings THEN NOT wait\n{RULES}", "conflict")
    assert conflict.rules == ("always_1_the_bell_rings", "rule_1")
    assert conflict.witness is not None
    assert conflict.witness.triggers == ("the bell rings",)


def test_a_statement_is_dead_or_redundant_as_a_whole() -> None:
    assert len(findings(f"ALWAYS wait UNLESS x AND NOT x IN WHICH CASE y\n{RULES}", "dead-hedge")) == 1
    assert not findings(f"ALWAYS answer\n{RULES}", "redundant-rule")
    (redundant,) = findings(f"ALWAYS wait\n\nALWAYS wait\n{RULES}", "redundant-rule")[:1]
    assert redundant.rules[0].startswith("always_")
    (own,) = findings(f"ALWAYS greet\n{RULES}", "redundant-rule")
    assert own.rules[0] == "rule_2"


def test_a_trigger_is_mentioned_where_it_is_written() -> None:
    text = "ALWAYS smile\nWHEN a THEN b\nWHEN b THEN c\n"
    (finding,) = findings(text, "trigger-obligation")
    assert finding.rules == ("rule_1", "rule_2")
    assert text[finding.span.start :].startswith("b\nWHEN b")


def findings(text, check):
    (result,) = run_checks(parse(text), [check])
    return result.findings


def test_the_robot_follows_it_at_every_trigger() -> None:
    sleec = Sleec(parse(f"ALWAYS be polite\nUNLESS the alarm rings IN WHICH CASE hurry\n{RULES}"))
    executed: list[str] = []
    names = ("answer", "wave", "greet", "be polite", "hurry")
    sleec.implement({name: lambda name=name: executed.append(name) for name in names})
    sleec.trigger("the door opens")
    assert sorted(executed) == ["be polite", "greet"]
    sleec.update({"the alarm rings": True})
    executed.clear()
    sleec.trigger("the user calls")
    assert sorted(executed) == ["answer", "hurry"]


def test_no_rule_needs_what_never_forbids_alone() -> None:
    assert not findings(f"NEVER shout UNLESS the alarm rings\n{RULES}", "unused-name")
    assert len(findings(f"NEVER shout AND answer UNLESS the alarm rings\n{RULES}", "unused-name")) == 1


def test_the_monitor_sees_what_never_forbids() -> None:
    sleec = Sleec(parse("NEVER shout\nALWAYS be polite\nWHEN the user calls THEN answer\n"))

    class Loud:
        def shout(self) -> None: ...

    loud = Loud()
    sleec.implement({"answer": lambda: loud.shout(), "be polite": lambda: None, "shout": loud.shout})
    seen: list[str] = []
    with Monitor(sleec, lambda difference: seen.append(str(difference)), watch=[loud]):
        sleec.trigger("the user calls")
    assert seen == ["the user calls: executed but not due: shout"]
