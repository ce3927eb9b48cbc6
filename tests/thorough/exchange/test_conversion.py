"""What is converted obliges the same in every situation; what cannot be said is refused."""

from __future__ import annotations

import pytest
from click.testing import CliRunner
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from sleec_runtime.errors import Unsayable
from sleec_runtime.language import load, parse, print_ruleset
from sleec_runtime.model import Rule, Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.cli.convert import command
from sleec_verify.exchange.conversion import TARGETS, convert, of_domain
from sleec_verify.exchange.conversion.readings import with_reading
from tests.support.brute_force import contexts, due
from tests.support.paths import ROOT
from tests.support.small_rulesets import small_rulesets
from tests.support.strategies import rulesets

RULESETS = ROOT / "rulesets"
RULES_ONLY = small_rulesets(constraints=False, assumptions=False, rules=2)


def oblige_the_same(one: Ruleset, other: Ruleset) -> None:
    for context in contexts(one):
        assert due(one, context) == due(other, context), context


@settings(max_examples=150)
@given(RULES_ONLY, st.sampled_from(("cascade", "priority")))
def test_a_rewritten_reading_obliges_the_same(ruleset, reading):
    rewritten = with_reading(ruleset, reading)
    assert rewritten.reading == reading
    oblige_the_same(ruleset, rewritten)


@settings(max_examples=150)
@given(RULES_ONLY)
def test_structured_english_and_legos_oblige_the_same_there_and_back(ruleset):
    there = convert(ruleset, "legos")
    assert there.ruleset.reading == "priority"
    oblige_the_same(ruleset, there.ruleset)
    back = convert(there.ruleset, "english", "cascade")
    assert (back.ruleset.reading, back.ruleset.syntax) == ("cascade", "english")
    oblige_the_same(ruleset, back.ruleset)


@settings(max_examples=80)
@given(small_rulesets(constraints=False, assumptions=False, rules=2, measures=True))
def test_sleec_tk_obliges_the_same_or_refuses_prohibitions(ruleset):
    assume(all(rule.default.obligations for rule in ruleset.rules))
    prohibits = any(o.negated for rule in ruleset.rules for clause in rule.clauses() for o in clause.obligations)
    if prohibits:
        with pytest.raises(Unsayable, match="no prohibition without a window"):
            convert(ruleset, "dsl")
    else:
        oblige_the_same(ruleset, convert(ruleset, "dsl").ruleset)


def test_comments_and_the_order_stay():
    ruleset = parse(
        "// the file\n\nMEASURE x: integer  // how many\nRULE a  // first\n// when it happens\nWHEN t THEN p AND q\n"
        "// but\nUNLESS x > 3  // many\nRULE b WHEN u THEN r\n// the end\n"
    )
    for to in TARGETS:
        text = convert(ruleset, to).text
        said = ("the file", "how many", "first", "when it happens", "but", "many", "the end")
        assert [text.count(f"// {comment}") for comment in said] == [1] * len(said), to
        assert text.index("p") < text.index("q")
    assert convert(parse(convert(ruleset, "legos").text), "english").ruleset.reading == "priority"


def test_a_response_of_several_obligations_becomes_several_rules():
    ruleset = parse("RULE a_2 WHEN t THEN p\nRULE a WHEN t THEN p AND q UNLESS c UNLESS d IN WHICH CASE r")
    found = convert(ruleset, "legos").ruleset
    assert [rule.label for rule in found.rules] == ["a_2", "a", "a_2_"]


REFUSED = {
    "NEVER a AND b\nWHEN t THEN a": "NEVER",
    "EXCLUSIVE a, b\nWHEN t THEN a": "EXCLUSIVE",
    "ASSUME c\nWHEN t THEN a UNLESS c": "ASSUME",
    "DOMAIN home\nWHEN t THEN a": "no domains",
    "WHEN t THEN a UNLESS the user sleeps": "not a name of the DSL",
    "RULE a.b WHEN t THEN a": "not a name of the DSL",
    "WHEN event THEN a": "keyword of the DSL",
    "CONSTANT k = 1.5\nWHEN t AND x > k THEN a": "not a whole number",
    "WHEN t AND x > 1.5 THEN a": "not a whole number",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_the_dsl_cannot_say_is_refused(text):
    with pytest.raises(Unsayable, match=REFUSED[text]):
        convert(parse(text), "legos")


DSL = """def_start
  event A{agent}
  event B
  measure m: boolean
  measure one: scale(a, b)
  measure two: scale(c, d)
def_end
rule_start
  R1 when A {rest}
rule_end
"""


def dsl(rest, beside="", agent=""):
    return parse(DSL.replace("{rest}", rest).replace("{agent}", agent) + beside)


@pytest.mark.parametrize(
    ("rest", "beside", "said"),
    [
        ("then B within 5 minutes", "", "THEN B WITHIN 5 minutes"),
        ("then B otherwise A", "", "THEN B OTHERWISE A"),
        ("then B eventually", "", "THEN B EVENTUALLY"),
        ("then B else A", "", "THEN B ELSE A"),
        ("then B", "purpose_start p1 exists A purpose_end", "PURPOSE p1 EXISTS A"),
        ("then B", "relation_start equal A B relation_end", "RELATION A EQUALS B"),
    ],
)
def test_structured_english_says_all_that_the_dsl_does(rest, beside, said):
    english = convert(dsl(rest, beside), "english")
    assert said in english.text
    assert convert(english.ruleset, "legos").ruleset == dsl(rest, beside)


def test_what_is_only_read_because_others_read_it_is_put_right():
    foreign = convert(dsl("and {one} = d then B"), "english")
    assert "WHEN A AND one = b THEN B" in foreign.text
    note = "line 9: `d` is a value of `two`, not of `one`; it is read as `b`, which has the same place"
    assert foreign.notes == [note]
    for written, meant in (
        ("{one} >= 1", "one >= b"),
        ("0 = {one}", "a = one"),
        ("{one} < 2", "one >= a"),
        ("{one} = 2", "one < a"),
        ("2 <= {one}", "one < a"),
        ("-1 != {one}", "one >= a"),
        ("-1 > {one}", "one < a"),
    ):
        number = convert(dsl(f"and ({written}) then B"), "english")
        assert f"WHEN A AND {meant} THEN B" in number.text
        (note,) = number.notes
        assert note.startswith("line 9: `one` is a scale, but ")
    twice = convert(dsl("then B R1 when B then A R1_2 when B then A"), "english")
    assert [rule.label for rule in twice.ruleset.rules] == ["R1", "R1_2_", "R1_2"]
    assert twice.notes[0] == "line 9: rule `R1#2` is renamed to `R1_2_`"
    assert [note for note in twice.notes[1:] if "doing B and A triggers nothing" not in note] == []


def test_whose_an_event_is_stays():
    english = convert(dsl("then B", agent=" as system"), "english")
    assert "EVENT A BY system\nEVENT B\n" in english.text
    assert "event A as system" in convert(english.ruleset, "dsl").text


@pytest.mark.parametrize(
    "rest",
    [
        "then not B",
        "then not B eventually",
        "then B eventually",
        "then B otherwise A",
        "then B else A",
        "then B within [1, 2] days",
        "then not B within 1 days otherwise A",
        "then B within 1 days otherwise {A eventually unless m}",
    ],
)
def test_what_sleec_tk_cannot_say_is_refused(rest):
    with pytest.raises(Unsayable, match="SLEEC-TK has"):
        convert(dsl(rest), "dsl")


def test_the_dsl_has_one_reading():
    with pytest.raises(Unsayable, match="only the reading priority"):
        convert(parse("WHEN t THEN a"), "legos", "cascade")


@pytest.mark.parametrize("path", sorted(RULESETS.glob("*.sleec")), ids=lambda path: path.stem)
def test_rulesets_that_people_copy_are_rewritten_for_the_other_reading(path):
    ruleset = load(path)
    other = convert(ruleset, "english", "priority").ruleset
    assert other.reading == "priority"
    assert len(other.rules) == len(ruleset.rules)


def test_one_domain_can_be_converted():
    ruleset = of_domain(load(RULESETS / "hospital.sleec"), "hospital")
    found = convert(ruleset, "legos")
    assert found.notes
    assert len([s for s in found.ruleset.statements if isinstance(s, Rule)]) == len(ruleset.rules)


@settings(max_examples=80)
@given(rulesets(max_rules=4))
def test_every_domain_can_be_converted_and_its_rules_keep_their_labels(ruleset):
    for domain in ruleset.domains:
        labels = [rule.label for rule in ruleset.in_domain(domain).rules]
        if labels:
            converted = convert(of_domain(ruleset, domain), "english").ruleset
            assert [rule.label for rule in converted.rules] == labels
        else:
            with pytest.raises(Unsayable, match="no rule applies in the domain"):
                of_domain(ruleset, domain)


@pytest.mark.parametrize(
    ("text", "declared"),
    [
        ("DOMAIN a WHEN T THEN X DOMAIN b WHEN U THEN Y ASSUME NOT (T AND U)", "TRIGGER T, U"),
        ("DOMAIN a WHEN T THEN X UNLESS c DOMAIN b WHEN U THEN Y NEVER Y AND c", "CONDITION c"),
        ("DOMAIN a WHEN T THEN X UNLESS m < 3 DOMAIN b WHEN U THEN Y UNLESS c", None),
        ("DOMAIN a WHEN T THEN X UNLESS m < 3 DOMAIN b WHEN U THEN Y UNLESS m < n", None),
        ("DOMAIN a WHEN T THEN X DOMAIN b WHEN U THEN Y NEVER X AND Y", None),
        ("TRIGGER T, U DOMAIN a WHEN T THEN X DOMAIN b WHEN U THEN Y ASSUME NOT (T AND U)", "TRIGGER T, U"),
    ],
)
def test_names_stay_what_the_rules_of_other_domains_make_them(text, declared):
    part = of_domain(parse(text), "b")
    converted = convert(part, "english").ruleset
    assert (converted.triggers, converted.conditions) == (part.triggers, part.conditions)
    assert converted.obligations == part.obligations
    assert [line for line in print_ruleset(converted).splitlines() if line.startswith(("TRIG", "COND", "OBL"))] == (
        [declared] if declared else []
    )


def test_a_condition_of_another_domain_stays_one_beside_declared_obligations():
    text = "OBLIGATION X, Y DOMAIN a WHEN T THEN X UNLESS c DOMAIN b WHEN U THEN Y NEVER Y AND c"
    part = of_domain(parse(text), "b")
    assert "CONDITION c\n" in print_ruleset(part)
    assert parse(print_ruleset(part)).conditions == part.conditions == {"c"}


def test_a_rule_that_is_called_by_its_number_keeps_it():
    ruleset = parse("DOMAIN a WHEN T THEN X DOMAIN b WHEN U THEN Y")
    assert "RULE rule_2\n" in convert(of_domain(ruleset, "b"), "english").text
    assert "RULE" not in convert(of_domain(ruleset, "a"), "english").text


@pytest.mark.parametrize(
    ("response", "to", "noted"),
    [
        ("B", "dsl", True),
        ("B WITHIN 5 minutes", "dsl", False),
        ("B WITHIN 5 minutes OTHERWISE C", "dsl", True),
        ("B", "legos", False),
    ],
)
def test_what_sleec_tk_takes_its_time_for_is_noted(response, to, noted):
    converted = convert(parse(f"WHEN A THEN {response}"), to)
    assert [note for note in converted.notes if "SLEEC-TK" in note] == list(converted.notes)
    assert bool(converted.notes) == noted


def test_names_that_sleec_tk_keeps_for_itself_are_noted():
    text = "CONDITION d\nMEASURE c: number\nCONSTANT Q = 2\nWHEN P AND d AND c > Q THEN Stop WITHIN 1 minute"
    (_, note) = convert(parse(text), "dsl").notes
    assert note == "the editor of SLEEC-TK rejects P, Q, c and d as names"
    assert [one for one in convert(parse(text), "legos").notes if "SLEEC-TK" in one] == []
    (note,) = convert(parse("WHEN STOP THEN Halt WITHIN 1 minute"), "dsl").notes
    assert note == "the editor of SLEEC-TK rejects STOP as a name"


CHAIN = "RULE one WHEN A THEN B\nRULE two WHEN B THEN C\nRULE three WHEN A THEN NOT C"


@pytest.mark.parametrize("text", [CHAIN, CHAIN.replace("B\n", "B WITHIN 0 seconds\n"), CHAIN.replace("N B", "N D")])
def test_check_counts_the_same_chains_in_both_languages(text):
    def conflicts(ruleset):
        (result,) = run_checks(ruleset, ["conflict"])
        return {finding.rules for finding in result.findings}

    legos = convert(parse(text), "legos").ruleset
    english = convert(legos, "english").ruleset
    assert conflicts(parse(text)) == conflicts(legos) == conflicts(english) != set()


def test_what_sleec_tk_wrote_is_what_it_means():
    ruleset = parse("""def_start event A event B measure m: boolean def_end
    rule_start r when A then B unless not m rule_end""")
    assert ruleset.dialect == "sleec-tk"
    assert convert(ruleset, "dsl").notes == []


def test_the_command_prints_notes_apart():
    result = CliRunner().invoke(command, [str(RULESETS / "hospital.sleec"), "--to", "legos", "--domain", "hospital"])
    assert result.exit_code == 0
    assert "rule_end" in result.stdout
    assert "note: " in result.stderr
