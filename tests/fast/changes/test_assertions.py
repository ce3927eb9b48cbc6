"""Assertions: what they say, what they mean, and what is said of those that are none."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_runtime.model import And, Atom, Obligation, Or, Ruleset, Source, Span, Truth
from sleec_verify.changes.assertions.assertion import Assertion, Violation
from sleec_verify.changes.assertions.parser import parse_assertion, parse_assertions
from sleec_verify.changes.assertions.verification import verify
from sleec_verify.changes.assertions.vocabulary import Vocabulary
from tests.support import brute_force as brute
from tests.support.small_rulesets import CONDITIONS, OBLIGATIONS, TRIGGERS, booleans, formulas, small_rulesets

RULES = parse(
    """\
MEASURE Risk: low < middle < high
CONSTANT LegalAge = 18
RULE a
WHEN the user falls THEN call the nurse
UNLESS UserAsleep IN WHICH CASE NOT Speak
RULE b
WHEN Request THEN Open AND Greet
UNLESS Risk > low IN WHICH CASE Refuse
UNLESS UserAge < LegalAge IN WHICH CASE AskParents WITHIN 5 minutes
"""
)
KNOWN = Vocabulary([RULES])


def holds(text: str, ruleset: Ruleset = RULES) -> bool:
    answer = verify(ruleset, parse_assertion(text, Vocabulary([ruleset]))).answer
    assert not isinstance(answer, str), answer
    return answer is None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("never Refuse when Risk = low", True),
        ("never Refuse", False),
        ("never Refuse and Open", True),
        ("always Open and Greet when Request and Risk <= low", True),
        ("ALWAYS Open, Greet WHEN Request AND NOT Risk >= middle", True),
        ("always Open when Request", False),
        ("always call the nurse when the user falls and not UserAsleep", True),
        ("always not Speak when the user falls and UserAsleep", True),
        ("never NOT Speak when not UserAsleep", True),
        ("always AskParents when Request and (Risk = middle or Risk = high) and UserAge < LegalAge", True),
        ("always AskParents when Request and Risk = high and 18.5 > UserAge", False),
        ("never Speak when true", True),
        ("always Speak when false", True),
        ("always Speak", False),
    ],
)
def test_what_assertions_mean(text: str, expected: bool) -> None:
    assert holds(text) is expected


def test_assumptions_and_domains_count() -> None:
    home, ward = "RULE a\nWHEN t THEN o\n", "RULE b\nWHEN t THEN p UNLESS c IN WHICH CASE q\n"
    ruleset = parse(f"DOMAIN home\n{home}DOMAIN ward\nASSUME NOT c\n{ward}")
    assert holds("never q", ruleset)
    answer = verify(ruleset, parse_assertion("always o when t", Vocabulary([ruleset]))).answer
    assert isinstance(answer, Violation)
    assert (answer.domain, [one.rule for one in answer.deciding]) == ("ward", ["b"])
    assert verify(ruleset, parse_assertion("always o when t", Vocabulary([ruleset])), domain="home").answer is None


def test_relations_count() -> None:
    ruleset = parse("RELATION ALWAYS c IMPLIES d\nRULE a\nWHEN t THEN o UNLESS c AND NOT d IN WHICH CASE p\n")
    assert holds("never p", ruleset)


@settings(max_examples=100)
@given(
    small_rulesets(rules=3),
    st.sampled_from(("never", "always")),
    st.lists(st.builds(Obligation, st.sampled_from(OBLIGATIONS), st.booleans()), min_size=1, max_size=2, unique=True),
    formulas(st.one_of(booleans, st.sampled_from(TRIGGERS).map(lambda name: Atom("trigger", name))), 2),
)
def test_against_brute_force(ruleset, kind, literals, when) -> None:
    def broken(context) -> bool:
        if not brute.value(when, context):
            return False
        due = brute.due(ruleset, context)
        return all(o in due for o in literals) if kind == "never" else not all(o in due for o in literals)

    names = Ruleset((*ruleset.statements, brute_names(ruleset, when)))
    expected = any(broken(context) for context in brute.contexts(names))
    answer = verify(ruleset, Assertion(kind, tuple(literals), when, Source("t", ""), Span(0, 0))).answer
    assert (answer is not None) == expected
    if isinstance(answer, Violation):
        assert broken(answer.witness.context())


def brute_names(ruleset, when):
    """A constraint that says nothing, over all names at hand."""
    from sleec_runtime.model import Never

    return Never(And((Truth(False), Or((when, *(Atom("condition", name) for name in CONDITIONS))))))


@pytest.mark.parametrize(
    ("text", "column", "message", "hint"),
    [
        ("", 1, "must begin with never or always", "for example"),
        ("mostly Open", 1, "must begin with never or always", "for example"),
        ("never", 6, "an obligation is missing", "must not do"),
        ("never Opn when Request", 7, "`Opn` is not in the rules", "did you mean `Open`?"),
        ("never Request", 7, "`Request` is a trigger", "obligations after never and always"),
        ("never Open or Greet", 12, "only be joined by and", "for each"),
        ("never Open wen Request", 12, "unexpected `wen`", "when"),
        ("never Open when", 16, "a trigger, condition or measure is missing", "which situations"),
        ("never Open when UserAslep", 17, "`UserAslep` is not in the rules", "did you mean `UserAsleep`?"),
        ("never Open when Refuse", 17, "`Refuse` is an obligation", "never and always"),
        ("never Open when Risk", 17, "`Risk` is a measure", "Risk >= high"),
        ("never Open when LegalAge", 17, "`LegalAge` is a constant", "UserAge < LegalAge"),
        ("never Open when Risk > 3", 17, "`3` is not a value of `Risk`", "low < middle < high"),
        ("never Open when Risk = enormous", 24, "`enormous` is not in the rules", ""),
        ("never Open when UserAge > low", 17, "cannot be compared", ""),
        ("never Open when (Request", 25, "a closing parenthesis for the one opened in line 1, column 17", "delete"),
        ("never Open when Request)", 24, "unexpected `)`", "join"),
        ("never Open when 18 Request", 20, "comparison", "18 <= UserAge"),
        ("never Open when " + "(" * 300 + "Request", 117, "more than 100 levels", "simplify"),
        ("never Open when " + "not " * 300 + "Request", 417, "more than 100 levels", "simplify"),
    ],
)
def test_what_is_none_is_refused_with_its_place(text: str, column: int, message: str, hint: str) -> None:
    with pytest.raises(LanguageError) as caught:
        parse_assertion(text, KNOWN)
    (problem,) = caught.value.problems
    assert message in problem.message
    assert hint in (problem.hint or "")
    assert caught.value.source.place(problem.span).column == column


def test_a_file_has_one_a_line() -> None:
    text = "# what must hold\nnever Refuse when Risk = low  # ever\n\nalways Open when Request\n"
    found = parse_assertions(Source("file", text), KNOWN)
    assert [one.text for one in found] == ["never Refuse when Risk = low", "always Open when Request"]


def test_all_problems_of_a_file_are_told() -> None:
    with pytest.raises(LanguageError) as caught:
        parse_assertions(Source("file", "never Opn\nalways Open\nnever\n"), KNOWN)
    assert [caught.value.source.place(p.span)[:2] for p in caught.value.problems] == [(1, 7), (3, 6)]


def test_a_file_without_assertions_is_a_mistake() -> None:
    with pytest.raises(LanguageError, match="no assertion"):
        parse_assertions(Source("file", "# nothing\n"), KNOWN)


MEASURING = "MEASURE c: number\nWHEN t THEN o UNLESS c > 1 IN WHICH CASE p\n"
BESIDE = "MEASURE Age: integer\nMEASURE Risk: low < high\nCONSTANT Grown = 18\nWHEN t THEN o UNLESS c IN WHICH CASE p\n"


@pytest.mark.parametrize(
    ("when", "other", "why"),
    [
        ("c", MEASURING, "`c` is a measure in these rules, but a condition"),
        ("c", "WHEN c THEN o\n", "`c` is a trigger in these rules, but a condition"),
        ("t", "WHEN c THEN o UNLESS t IN WHICH CASE p\n", "`t` is a condition in these rules, but a trigger"),
        ("Age > 3", "WHEN t THEN o UNLESS Age IN WHICH CASE p\n", "`Age` is a condition in these rules, but a measure"),
        ("Risk > low", BESIDE.replace("low < high", "high < low"), "`Risk` has a different scale"),
        ("Age < Grown", BESIDE.replace("18", "21"), "`Grown` has a different value"),
    ],
)
def test_rules_that_take_a_name_otherwise_are_not_asked(when: str, other: str, why: str) -> None:
    """The first ruleset says how the assertion is read; what it would mean to the other nobody said."""
    rulesets = [parse(BESIDE), parse(other)]
    known = Vocabulary(rulesets)
    assertion = parse_assertion(f"never o when {when}", known)
    first, second = (verify(ruleset, assertion, known=known).answer for ruleset in rulesets)
    assert not isinstance(first, str)
    assert isinstance(second, str)
    assert second.startswith(why)


def test_rules_that_do_not_know_a_name_are_asked_all_the_same() -> None:
    rulesets = [parse(BESIDE), parse("WHEN t THEN p\n")]
    known = Vocabulary(rulesets)
    asked = [
        verify(ruleset, parse_assertion("never p when Age < Grown and c", known), known=known) for ruleset in rulesets
    ]
    assert all(isinstance(one.answer, Violation) for one in asked)
