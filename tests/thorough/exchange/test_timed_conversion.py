"""What is converted with times means the same: as values, or by an evaluation of its own where rules are split."""

from __future__ import annotations

import re
from dataclasses import replace
from zlib import crc32

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.errors import Unsayable
from sleec_runtime.language import load, parse, print_ruleset
from sleec_runtime.model import RELATIONS, And, Atom, Claim, Comparison, Declaration, Not, Or, Rule, Truth
from sleec_verify.exchange.conversion import Target, convert
from sleec_verify.exchange.conversion.rules import MAX_RULES
from tests.support.dsl_strategies import dsl_rulesets
from tests.support.paths import ROOT
from tests.support.studies import each_dsl_study
from tests.support.timed_language_strategies import timed_rulesets

SEEDS = range(12)


# Meaning, by a truth value for whatever may be so at whatever time ------------------------------------------


def fact(seed, *what):
    """Whether something is so: at random, and mostly."""
    return crc32(repr((seed, what)).encode()) % 8 < 5


def true(formula, seed, at):
    if isinstance(formula, Truth):
        return formula.value
    if isinstance(formula, Not):
        return not true(formula.operand, seed, at)
    if isinstance(formula, (And, Or)):
        return (all if isinstance(formula, And) else any)(true(operand, seed, at) for operand in formula.operands)
    assert isinstance(formula, (Atom, Comparison))
    return fact(seed, repr(formula), at)


def kept(response, chain, reading, seed, at=()):
    """Whether a response with a chain of hedges is kept, in the situation that `seed` and the path `at` stand for."""
    deciding = response
    for hedge in chain:
        if true(hedge.condition, seed, at):
            deciding = hedge
        elif reading == "cascade":
            break
    if deciding.hedges and deciding.hedges is not chain:
        return kept(replace(deciding, hedges=()), deciding.hedges, reading, seed, at)
    return all(done(obligation, reading, seed, at) for obligation in deciding.obligations)


def due(clause, reading, seed, at=()):
    """Whether a response with the chain nested in it is kept."""
    return kept(replace(clause, hedges=()), clause.hedges, reading, seed, at)


def done(obligation, reading, seed, at):
    timing = obligation.timing
    window = timing and timing.window
    if fact(seed, obligation.name, obligation.negated, repr(window), at):
        return True
    if timing is None:
        return False
    late = timing.otherwise is not None and due(timing.otherwise, reading, seed, (*at, repr(window)))
    return late or (timing.instead is not None and due(timing.instead, reading, seed, at))


def claimed(claim, reading, seed):
    if claim is None:
        return True
    return (
        fact(seed, claim.kind, claim.form, claim.event)
        and (claim.condition is None or true(claim.condition, seed, ()))
        and all(due(response, reading, seed) for response in claim.responses)
        and claimed(claim.meanwhile, reading, seed)
    )


def meaning(ruleset, seed):
    """For each event whether what it triggers is kept, and for each claim whether it comes true."""
    said: dict[str, bool] = {}
    for statement in ruleset.statements:
        if isinstance(statement, Rule):
            applies = statement.guard is None or true(statement.guard, seed, ())
            is_kept = not applies or kept(statement.default, statement.hedges, ruleset.reading, seed)
            said[statement.trigger] = said.get(statement.trigger, True) and is_kept
        elif isinstance(statement, Claim):
            said[statement.label] = claimed(statement, ruleset.reading, seed)
    return said


def mean_the_same(one, other):
    for seed in SEEDS:
        assert meaning(one, seed) == meaning(other, seed)
    events = [{(n, s.agent) for s in r.statements if isinstance(s, Declaration) for n in s.names} for r in (one, other)]
    assert events[0] == events[1]
    beside = [[s for s in r.statements if isinstance(s, RELATIONS)] for r in (one, other)]
    assert len(beside[0]) == len(beside[1])


# From one language to the other -----------------------------------------------------------------------------


@pytest.mark.slow
@settings(max_examples=60)
@given(dsl_rulesets())
def test_the_dsl_is_the_same_after_structured_english(ruleset):
    english = convert(ruleset, "english").ruleset
    assert english.statements == ruleset.statements
    flat = replace(ruleset, statements=tuple(map(with_chain_of_default_first, ruleset.statements)))
    assert replace(convert(english, "legos").ruleset, dialect="legos") == flat


def with_chain_of_default_first(statement):
    """A rule without braces around its default, as it is written where structured English has parentheses."""
    if not isinstance(statement, Rule):
        return statement
    default, hedges = statement.default, statement.hedges
    return replace(statement, default=replace(default, hedges=()), hedges=(*default.hedges, *hedges))


@pytest.mark.slow
@settings(max_examples=60)
@given(timed_rulesets(phrases=False), st.sampled_from(("cascade", "priority")))
def test_structured_english_means_the_same_in_the_dsl_and_back(ruleset, reading):
    there = convert(ruleset, "legos").ruleset
    mean_the_same(ruleset, there)
    back = convert(there, "english", reading).ruleset
    assert back.reading == reading
    mean_the_same(ruleset, back)


@pytest.mark.slow
@settings(max_examples=50)
@given(timed_rulesets(phrases=False))
def test_sleec_tk_means_the_same_or_says_what_it_lacks(ruleset):
    try:
        there = convert(ruleset, "dsl").ruleset
    except Unsayable as error:
        lacks = str(error)
    else:
        lacks = ""
        mean_the_same(ruleset, there)
    assert "SLEEC-TK has" in lacks or not lacks


@each_dsl_study
def test_studies_are_the_same_after_structured_english(path):
    study = load(path)
    english = convert(study, "english")
    assert english.text == print_ruleset(english.ruleset)
    back = convert(english.ruleset, "legos").ruleset
    put_right = {d.kind for d in study.defects}
    assert len(english.notes) == len(study.defects)
    if not put_right:
        assert back.statements == study.statements
        to: Target = "dsl" if study.dialect == "sleec-tk" else "legos"
        # The comments stay, too, each in its place; empty lines are the author's in the DSL alone.
        assert without_empty_lines(convert(english.ruleset, to).text) == without_empty_lines(convert(study, to).text)
    else:
        distinct = list(dict.fromkeys(study.statements))
        assert len(back.statements) == len(distinct)
        differ = [(one, other) for one, other in zip(distinct, back.statements) if one != other]
        assert 0 < len(differ) <= len(study.defects)
        assert not back.defects


def without_empty_lines(text):
    return [line for line in text.splitlines() if line]


PAGE = (ROOT / "docs" / "language.md").read_text(encoding="utf-8")
RELATED = re.findall(r"^\| `(RELATION .*?)` \| `(.*?)` \|$", PAGE, flags=re.MULTILINE)


@pytest.mark.parametrize(("english", "dsl"), RELATED)
def test_relations_are_what_the_page_says(english, dsl):
    text = (
        "def_start event A event B measure p: boolean measure q: boolean measure r: boolean def_end "
        f"rule_start R1 when A then B rule_end relation_start {dsl} relation_end"
    )
    assert convert(parse(text), "english").text.endswith(f"{english}\n")
    assert len(RELATED) == 14


# What cannot be said ------------------------------------------------------------------------------------------


def test_several_obligations_in_place_of_one_become_several_rules():
    ruleset = parse(
        "RULE r WHEN t THEN a WITHIN 5 minutes OTHERWISE (b AND c UNLESS x IN WHICH CASE d AND e)\n"
        "CONCERN c1 EXISTS t WHILE a AND b MEANWHILE (WHEN t THEN a AND b)"
    )
    found = convert(ruleset, "legos").ruleset
    assert [rule.label for rule in found.rules] == ["r", "r_2"]
    (claim,) = (s for s in found.statements if isinstance(s, Claim))
    assert [[str(o) for o in clause.obligations] for clause in claim.responses] == [["a"], ["b"]]
    assert claim.meanwhile is not None
    assert len(claim.meanwhile.responses) == 2


def test_too_many_choices_are_refused():
    names = " AND ".join(f"o{number}" for number in range(40))
    ruleset = parse(f"RULE r WHEN t THEN a OTHERWISE ({names}) ELSE ({names})")
    with pytest.raises(Unsayable, match=f"more than {MAX_RULES:,} rules"):
        convert(ruleset, "legos")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("MEASURE waiting time: integer\nWHEN t THEN a WITHIN waiting time minutes", "not a name of the DSL"),
        ("CONCERN c.1 EXISTS a", "not a name of the DSL"),
        ("CONCERN c1 EXISTS the bell rings", "not a name of the DSL"),
        ("RELATION ALWAYS the bell is broken", "not a name of the DSL"),
        ("NEVER a AND b\nWHEN t THEN a OTHERWISE b", "NEVER"),
    ],
)
def test_what_the_dsl_cannot_say_is_refused(text, why):
    with pytest.raises(Unsayable, match=why):
        convert(parse(f"{text}\nWHEN t THEN a"), "legos")


def test_undeclared_names_beside_the_rules_are_defined():
    text = "CONCERN c1 EXISTS a AND x\nRELATION b FORBIDS y AND z > 3\nWHEN t THEN o"
    found = convert(parse(text), "legos").ruleset
    assert found.declared["event"] == {"a", "b", "o", "t"}
    assert found.declared["condition"] == {"x", "y"}
    assert set(found.measures) == {"z"}


def test_whose_an_event_is_stays_though_it_is_a_trigger_too():
    text = "TRIGGER t, u\nOBLIGATION a\nEVENT t, a BY system\nWHEN t THEN a"
    found = convert(parse(text), "legos")
    assert "event t as system" in found.text
    assert "event a as system" in found.text
    assert "event u\n" in found.text
