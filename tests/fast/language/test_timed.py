"""What each construct with times becomes, and what concerns, purposes, relations and events become."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    Atom,
    Claim,
    Clause,
    Declaration,
    Effect,
    EventRelation,
    Lasting,
    Length,
    MeasureRef,
    MeasureRelation,
    Not,
    Number,
    Obligation,
    Or,
    Timing,
    Window,
)

NAMES = "CONSTANT Soon = 5\nMEASURE waiting time: integer\n"


def response(text):
    """The obligations of the default of one rule."""
    ruleset = parse(f"{NAMES}WHEN T THEN {text}")
    assert parse(print_ruleset(ruleset)) == ruleset
    return ruleset.rules[0].default.obligations


def statement(text):
    return parse(f"{text}\nWHEN T THEN O").statements[0]


def minutes(amount, unit="minutes"):
    return Length(Number(amount), unit)


def clause(*names):
    return Clause(None, tuple(Obligation(name) for name in names))


@pytest.mark.parametrize(
    ("text", "window"),
    [
        ("WITHIN 10 seconds", Window(minutes(10, "seconds"))),
        ("WITHIN 1 minute", Window(minutes(1))),
        ("WITHIN 2 hours", Window(minutes(2, "hours"))),
        ("WITHIN 1 day", Window(minutes(1, "days"))),
        ("WITHIN 0 seconds", Window(minutes(0, "seconds"))),
        ("WITHIN 1 TO 5 minutes", Window(minutes(5), minutes(1))),
        ("WITHIN [1, 5] minutes", Window(minutes(5), minutes(1))),
        ("WITHIN [1,5] minutes", Window(minutes(5), minutes(1))),
        ("WITHIN 30 seconds TO 5 minutes", Window(minutes(5), minutes(30, "seconds"))),
        ("WITHIN [30 seconds, 5] minutes", Window(minutes(5), minutes(30, "seconds"))),
        ("WITHIN Soon minutes", Window(Length(Number(5, "Soon"), "minutes"))),
        ("WITHIN waiting time hours", Window(Length(MeasureRef("waiting time"), "hours"))),
        (
            "WITHIN Soon TO waiting time minutes",
            Window(Length(MeasureRef("waiting time"), "minutes"), Length(Number(5, "Soon"), "minutes")),
        ),
        ("EVENTUALLY", Window(None)),
    ],
)
def test_windows(text, window):
    assert response(f"call the nurse {text}") == (Obligation("call the nurse", timing=Timing(window)),)
    assert response(f"NOT A {text} AND B") == (Obligation("A", True, timing=Timing(window)), Obligation("B"))


def test_otherwise_and_else_belong_to_the_nearest_obligation():
    window = Window(minutes(5))
    last = Clause(None, (Obligation("C", timing=Timing(None, None, clause("D"))),))
    inner = Obligation("B", timing=Timing(window, last))
    assert response("A OTHERWISE B WITHIN 5 minutes OTHERWISE C ELSE D") == (
        Obligation("A", timing=Timing(None, Clause(None, (inner,)))),
    )
    assert response("A WITHIN 5 minutes AND B WITHIN 5 minutes OTHERWISE C") == (
        Obligation("A", timing=Timing(window)),
        Obligation("B", timing=Timing(window, clause("C"))),
    )


def test_parentheses_hold_several_obligations_and_hedges():
    (obligation,) = response("A OTHERWISE (B AND C UNLESS x IN WHICH CASE D) ELSE E")
    assert obligation.timing.otherwise == Clause(
        None,
        (Obligation("B"), Obligation("C")),
        (Clause(Atom("condition", "x"), (Obligation("D"),)),),
    )
    assert obligation.timing.instead == clause("E")
    assert response("(A OTHERWISE B) AND C") == (Obligation("A", timing=Timing(None, clause("B"))), Obligation("C"))


def test_a_choice_of_a_hedge_stands_in_parentheses():
    text = (
        "WHEN T THEN O UNLESS x IN WHICH CASE (A ELSE B)\nUNLESS y IN WHICH CASE (A OTHERWISE B) AND C AND (D ELSE E)"
    )
    ruleset = parse(text)
    assert print_ruleset(ruleset) == text.replace("O UNLESS", "O\nUNLESS") + "\n"
    # A window says when, so nothing can be meant but that.
    parse("WHEN T THEN O UNLESS x IN WHICH CASE A WITHIN 5 minutes OTHERWISE B")


def test_the_span_of_an_obligation_holds_its_time():
    text = "WHEN T THEN NOT A WITHIN 5 minutes OTHERWISE (B)"
    (obligation,) = parse(text).rules[0].default.obligations
    assert text[obligation.span.start : obligation.span.end] == "NOT A WITHIN 5 minutes OTHERWISE (B)"
    timing = obligation.timing
    assert timing is not None
    assert timing.window is not None
    assert text[timing.window.span.start :].startswith("WITHIN 5")


def test_words_that_are_no_times_stay_in_names():
    assert response("stay within reach") == (Obligation("stay within reach"),)
    rule = parse("WHEN T THEN O UNLESS the user answered within 5 minutes").rules[0]
    assert rule.hedges[0].condition == Atom("condition", "the user answered within 5 minutes")
    parse("WHEN T THEN press the WHITE button AND open the VENT UNLESS the lamp FOR reading is on")


@pytest.mark.parametrize("depth", [33, 34, 50_000])
@pytest.mark.parametrize(("opening", "closing"), [("A OTHERWISE ", ""), ("A ELSE (", ")")])
def test_alternatives_are_not_nested_too_deeply(opening, closing, depth):
    text = "WHEN T THEN " + opening * depth + "B" + closing * depth
    if depth == 33:
        ruleset = parse(text)
        assert parse(print_ruleset(ruleset)) == ruleset
    else:
        with pytest.raises(LanguageError):
            parse(text)


def test_what_the_printer_puts_into_parentheses_can_be_read_again():
    inner = "A"
    for _ in range(24):
        inner = f"A AND B WITHIN 5 minutes OTHERWISE (C UNLESS x IN WHICH CASE {inner})"
    ruleset = parse(f"WHEN T THEN O UNLESS y IN WHICH CASE {inner}")
    assert parse(print_ruleset(ruleset)) == ruleset
    with pytest.raises(LanguageError, match="nested too deeply"):
        parse(f"WHEN T THEN O UNLESS y IN WHICH CASE {inner.replace('IN WHICH CASE A)', f'IN WHICH CASE {inner})')}")


x, y = Atom("condition", "x"), Atom("condition", "y")


def test_concerns_and_purposes():
    assert statement("CONCERN c.1 WHEN A AND x OR y THEN NOT B WITHIN 5 minutes WHILE C AND D") == Claim(
        "concern",
        "c.1",
        "when",
        "A",
        Or((x, y)),
        (Clause(None, (Obligation("B", True, timing=Timing(Window(minutes(5)))),)), clause("C", "D")),
    )
    assert statement("PURPOSE p EXISTS A WHILE B UNLESS x WHILE C MEANWHILE (WHEN B THEN C)") == Claim(
        "purpose",
        "p",
        "exists",
        "A",
        None,
        (Clause(None, (Obligation("B"),), (Clause(x, ()),)), clause("C")),
        Claim("purpose", "", "when", "B", None, (clause("C"),)),
    )
    assert statement("PURPOSE p EXISTS A") == statement("PURPOSE p\nEXISTS A.") == Claim("purpose", "p", "exists", "A")


@pytest.mark.parametrize(
    ("text", "relation"),
    [
        ("A WITNESSES the B", EventRelation("witness", "A", "the B")),
        ("A EQUALS B", EventRelation("equal", "A", "B")),
        ("A EXCLUDES B", EventRelation("mutualExclusive", "A", "B")),
        ("A PRECEDES B", EventRelation("happenBefore", "A", "B")),
        ("ALWAYS NOT x", MeasureRelation("invariant", Not(x))),
        ("ALWAYS x OR y IMPLIES x", MeasureRelation("imply", Or((x, y)), x)),
        ("ALWAYS x EQUALS y", MeasureRelation("iff", x, y)),
        ("ALWAYS x EXCLUDES y", MeasureRelation("mutualExclusive", x, y)),
        ("ALWAYS x OPPOSES y", MeasureRelation("opposite", x, y)),
        ("A CAUSES x", Effect("causation", "A", x)),
        ("A INCLUDES x", Effect("includes", "A", x)),
        ("A FORBIDS NOT x", Effect("forbid", "A", Not(x))),
        ("WHEN A AND x THEN y UNTIL B AND x", Lasting("A", x, y, "B", x)),
        ("WHEN A THEN y UNTIL B", Lasting("A", None, y, "B")),
        ("IF A THEN y FOR 5 minutes", Lasting("A", None, y, duration=minutes(5))),
    ],
)
def test_relations(text, relation):
    assert statement(f"RELATION {text}") == relation
    printed = print_ruleset(parse(f"RELATION {text}\nWHEN T THEN O"))
    assert printed.startswith(f"RELATION {text.replace('IF', 'WHEN')}\n")


def test_events_are_triggers_and_obligations():
    text = "EVENT Fire, the bell rings BY environment\nEVENT Alarm\n\nWHEN Fire THEN Alarm\n\nWHEN Alarm THEN Fire\n"
    ruleset = parse(text)
    assert ruleset.statements[:2] == (
        Declaration("event", ("Fire", "the bell rings"), agent="environment"),
        Declaration("event", ("Alarm",)),
    )
    assert print_ruleset(ruleset) == text
    with pytest.raises(LanguageError, match="no obligation is called"):
        parse("EVENT Fire\nWHEN Fire THEN Alarm")


def test_whose_an_event_is_is_said_once():
    parse("EVENT Fire BY system\nEVENT Fire BY system\nTRIGGER Fire\nWHEN Fire THEN Fire")
    with pytest.raises(LanguageError, match="BY environment here, and BY system in line 1"):
        parse("EVENT Fire BY system\nEVENT Fire BY environment\nWHEN Fire THEN Fire")


def test_claims_and_relations_are_for_the_whole_text():
    text = "DOMAIN ward\n\nWHEN T THEN O\n\nCONCERN c EXISTS O\n\nRELATION T EXCLUDES O\n\nWHEN O THEN T\n"
    ruleset = parse(text)
    assert print_ruleset(ruleset) == text
    assert len(ruleset.in_domain("ward").statements) == 4
    assert len(ruleset.in_domain("home").statements) == 2
