"""Windows that no robot can mean: each has a message with its place and a hint, in both languages."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse

ENGLISH = "EVENT A, B\nCONSTANT K = 999999999999\nRULE r WHEN A THEN B {}\n"
DSL = (
    "def_start event A event B constant K = 999999999999 constant N = -5 def_end\n"
    "rule_start r when A then B {} rule_end\n"
)

TOO_LONG = "this time is too long: "
AT_MOST = "write at most 1,000,000,000,000 seconds"
ONWARDS = "times count from the trigger onwards"


def problems(text: str) -> list[tuple[str, str, str]]:
    """For each problem: its message, its place in the text, and its hint."""
    with pytest.raises(LanguageError) as caught:
        parse(text)
    return [(one.message, text[one.span.start : one.span.end], one.hint or "") for one in caught.value.problems]


@pytest.mark.parametrize(
    ("window", "message", "place", "hint"),
    [
        ("WITHIN -5 minutes", "a time cannot be negative: -5", "-5", ONWARDS),
        ("WITHIN [-1, 2] minutes", "a time cannot be negative: -1", "-1", ONWARDS),
        ("WITHIN 999999999999 days", TOO_LONG + "999999999999 days", "999999999999 days", AT_MOST),
        ("WITHIN 1 TO 999999999999 days", TOO_LONG + "999999999999 days", "999999999999 days", AT_MOST),
        ("WITHIN K minutes", TOO_LONG + "K minutes", "K minutes", AT_MOST),
        (
            "WITHIN [5, 2] minutes",
            "this window ends (2 minutes) before it begins (5 minutes)",
            "WITHIN [5, 2] minutes",
            "write the earlier end first, for example: WITHIN 1 TO 5 minutes",
        ),
        (
            "AFTER 10 minutes WITHIN 5 minutes",
            "use WITHIN to give a time, instead of `AFTER 10 minutes`",
            "AFTER 10 minutes",
            "WITHIN 5 minutes sets a deadline; WITHIN 5 TO 10 minutes also sets the earliest time",
        ),
    ],
)
def test_structured_english(window: str, message: str, place: str, hint: str) -> None:
    assert problems(ENGLISH.format(window)) == [(message, place, hint)]


@pytest.mark.parametrize(
    ("window", "message", "place", "hint"),
    [
        ("within -5 minutes", "a time cannot be negative: -5", "-5", ONWARDS),
        ("within N minutes", "a time cannot be negative: `N` is -5", "N", "use another value"),
        ("within 999999999999 days", TOO_LONG + "999999999999 days", "999999999999 days", AT_MOST),
        ("within [1, 999999999999] days", TOO_LONG + "999999999999 days", "within [1, 999999999999] days", AT_MOST),
        ("within K minutes", TOO_LONG + "K minutes", "K minutes", AT_MOST),
        (
            "within [5, 2] minutes",
            "this window ends (2 minutes) before it begins (5 minutes)",
            "within [5, 2] minutes",
            "write the earlier end first, for example: within [1, 5] minutes",
        ),
    ],
)
def test_the_dsl(window: str, message: str, place: str, hint: str) -> None:
    assert problems(DSL.format(window)) == [(message, place, hint)]


def test_the_duration_of_a_relation() -> None:
    relation = "relation_start when A then true for 999999999999 days relation_end"
    ((said, _, _),) = problems(DSL.format("within 1 minutes") + relation)
    assert said == TOO_LONG + "999999999999 days"
    ((said, _, _),) = problems(ENGLISH.format("") + "RELATION WHEN A THEN c FOR 999999999999 days\n")
    assert said == TOO_LONG + "999999999999 days"


def test_the_longest_time_is_read() -> None:
    parse(ENGLISH.format("WITHIN 1000000000000 seconds"))
    ((said, _, _),) = problems(ENGLISH.format("WITHIN 1000000000001 seconds"))
    assert said.startswith(TOO_LONG)
