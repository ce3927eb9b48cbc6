"""Single facts about the checks and the answers that the comparisons with brute force do not pin down."""

from __future__ import annotations

from itertools import product

import pytest

from sleec_runtime.evaluation.due import broken_assumptions
from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.language import parse
from sleec_runtime.model import Context, Obligation
from sleec_verify.checks import checks_for, run_checks
from sleec_verify.entailment.definition1 import Definition1
from sleec_verify.entailment.entailment import entail
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef


def found(text, check):
    (result,) = run_checks(parse(text), [check])
    return result.findings


def test_definition_1_of_one_obligation():
    definition = Definition1(parse("WHEN t THEN o AND NOT p\nWHEN u THEN p\nWHEN v THEN q"))
    assert definition.entails(Context(frozenset("t")), Obligation("o"))
    assert definition.entails(Context(frozenset("t")), Obligation("p", negated=True))
    assert not definition.entails(Context(frozenset("t")), Obligation("p"))
    assert not definition.entails(Context(frozenset("t")), Obligation("q"))
    assert not definition.entails(Context(frozenset("t")), Obligation("nobody says this"))
    assert definition.entails(Context(frozenset("tu")), Obligation("q")), "to the letter, a conflict entails everything"
    assert definition.entailed(Context(frozenset("tu"))) is None


SCALES = "MEASURE a: low < middle < high\nMEASURE b: low < middle < high\n"


@pytest.mark.parametrize("operator", ["<", "<=", "=", "!=", ">=", ">"])
def test_scales_compared_with_one_another(operator):
    ruleset = parse(f"{SCALES}WHEN t THEN o UNLESS a {operator} b IN WHICH CASE p")
    values = ("low", "middle", "high")
    for rank, a in enumerate(values):
        for other, b in enumerate(values):
            holds = {
                "<": rank < other,
                "<=": rank <= other,
                "=": rank == other,
                "!=": rank != other,
                ">=": rank >= other,
                ">": rank > other,
            }[operator]
            answer = entail(ruleset, Context(frozenset("t"), {"a": a, "b": b}))
            assert answer.obligations == (("p",) if holds else ("o",))


def test_scales_compared_with_one_another_have_a_witness():
    text = SCALES + "WHEN t AND a < b THEN o\nWHEN t AND b < high THEN NOT o"
    (finding,) = found(text, "conflict")
    assert finding.witness.conditions == {"a": "low", "b": "middle"}
    assert not found(text.replace("b < high", "a >= b"), "conflict")


def test_whole_numbers_between_numbers_have_room_or_not():
    text = "MEASURE n: integer\nMEASURE x: integer\nWHEN t AND x < n AND n < {} THEN o\nWHEN t AND x > 3 THEN NOT o"
    assert not found(text.format(5), "conflict")
    (finding,) = found(text.format(6), "conflict")
    assert finding.witness.conditions == {"n": 5, "x": 4}


def test_a_value_between_two_near_constants_is_shown():
    (finding,) = found("WHEN t AND x > 0.25 AND x < 0.26 THEN o AND NOT o", "conflict")
    assert 0.25 < finding.witness.conditions["x"] < 0.26


def test_everything_declared_and_unused_is_noted():
    text = (
        "TRIGGER t, u\nCONDITION c\nOBLIGATION o, p\nMEASURE m: number\nMEASURE n: number\n"
        "CONSTANT k = 1\nCONSTANT l = k\nCONSTANT j = 2\nNEVER o AND p AND n > 1\nASSUME NOT (t AND n > l)\n"
        "WHEN t THEN o"
    )
    messages = [finding.message for finding in found(text, "unused-name")]
    assert messages == [
        "the trigger `u` is declared but never used",
        "the condition `c` is declared but never used",
        "the measure `m` is declared but never used",
        "the constant `j` is declared but never used",
        "a constraint names `p`, but no rule requires or forbids it",
    ]


def test_an_exclusive_of_what_nobody_obliges_is_noted():
    (finding,) = found("EXCLUSIVE o, q\nWHEN t THEN o", "unused-name")
    assert finding.code == "SLEEC502"
    assert finding.obligations == ("q",)


def test_what_is_due_otherwise_is_obliged():
    text = "NEVER p AND c\nCONDITION c\nWHEN t THEN o WITHIN 5 minutes OTHERWISE p\nUNLESS c"
    assert found(text, "unused-name") == ()


def test_a_name_of_two_kinds_names_the_rules_that_hold_it():
    (finding,) = found("RULE a WHEN s THEN Alarm\nRULE b WHEN Alarm THEN c", "trigger-obligation")
    assert finding.rules == ("a", "b")


def test_one_finding_for_one_set_of_clauses_whatever_is_at_odds():
    (finding,) = found("RULE a WHEN t THEN o AND p\nRULE b WHEN u THEN NOT o AND NOT p", "conflict")
    assert finding.obligations == ("o", "p")
    assert finding.clauses == (ClauseRef("a", 0), ClauseRef("b", 0))


def test_a_rule_at_odds_with_itself():
    (finding,) = found("RULE a WHEN t THEN o UNLESS c IN WHICH CASE (p AND NOT p)", "conflict")
    assert finding.clauses == (ClauseRef("a", 1),)
    assert (
        finding.message == "the exception `UNLESS c` of rule `a` cannot be followed: `p` is both required and forbidden"
    )


def test_constraints_that_cannot_be_kept_whatever_the_rules_say():
    text = "CONDITION c\nNEVER o AND c\nNEVER NOT o AND c\nWHEN t THEN p"
    (finding,) = found(text, "conflict")
    assert finding.rules == ()
    assert finding.witness.conditions == {"c": True}
    assert "lines 2" not in finding.message
    assert "NEVER in line 2 and the NEVER in line 3" in finding.message


def test_the_note_on_a_dead_hedge_says_which_kind_it_is():
    (one,) = found("WHEN t THEN o UNLESS x < 1 AND x > 2 IN WHICH CASE p", "dead-hedge")
    assert one.note == "its condition can never be true"
    (two,) = found("WHEN t THEN o UNLESS a IN WHICH CASE p UNLESS NOT a IN WHICH CASE q", "dead-hedge")
    never = "never when the rule is triggered and the conditions of all exceptions before it are true"
    assert two.note == f"its condition can be true, but {never}"
    for text in (
        "WHEN t THEN o UNLESS x > 5 IN WHICH CASE p UNLESS x > 3 IN WHICH CASE q",
        "READING priority\nWHEN t THEN o UNLESS x > 5 IN WHICH CASE p UNLESS x > 3 IN WHICH CASE q",
        "WHEN t THEN o UNLESS x > 5 IN WHICH CASE (p UNLESS x = 3 IN WHICH CASE q)",
    ):
        (one,) = found(text, "dead-hedge")
        then = "whenever the rule is triggered then, the default or another exception applies"
        assert one.note == f"its condition can be true, but {then}"


@pytest.mark.parametrize("window", ["", " WITHIN 1 minute"])
def test_of_rules_that_make_each_other_redundant_not_all_may_go(window):
    """Each comes with the others that go with it, and what follows the advice, one rule after the other, keeps one."""
    rules = {"a": "B", "b": "B AND C", "c": "C", "d": "D"}
    text = "".join(
        f"RULE {label} WHEN A THEN {due.replace(' AND', f'{window} AND')}{window}\n" for label, due in rules.items()
    )
    by_rule = {finding.rules[0]: finding.help for finding in found(text, "redundant-rule")}
    keep = "or keep it and say why in a comment"
    assert by_rule == {
        "a": f"remove it, and check again before you also remove `b`; {keep}",
        "b": f"remove it, and check again before you also remove `a` and `c`; {keep}",
        "c": f"remove it, and check again before you also remove `b`; {keep}",
    }
    (alone,) = found(
        "\n".join(line for line in text.splitlines() if " c " not in line and " d " not in line), "redundant-rule"
    )
    assert (alone.rules, alone.help) == (("a", "b"), f"remove it, {keep}")


def test_a_redundant_rule_names_what_covers_it():
    text = "RULE a WHEN t THEN o AND p\nRULE b WHEN t THEN o\nRULE c WHEN t THEN p\nRULE d WHEN t THEN o"
    by_rule = {finding.rules[0]: finding.rules[1:] for finding in found(text, "redundant-rule")}
    assert by_rule["b"] in {("a",), ("d",)}
    assert set(by_rule) == {"a", "b", "c", "d"}
    assert "c" in by_rule["a"]


def test_many_copies_of_a_rule_take_few_questions(monkeypatch):
    """What covers each copy is found in one formula: a ruleset may be made of copies."""
    asked: list[int] = []
    ask = Question.ask

    def counted(question: Question, *literals: int) -> bool:
        asked.append(1)
        return ask(question, *literals)

    monkeypatch.setattr(Question, "ask", counted)
    copies = 60
    findings = found("WHEN t THEN o AND p UNLESS c IN WHICH CASE q\n" * copies, "redundant-rule")
    assert len(findings) == copies
    assert all(len(finding.rules) == 2 for finding in findings)
    assert len(asked) <= 8 * copies


def test_a_hedge_without_a_response_that_can_be_removed_is_not_asked_about_it():
    (finding,) = found("WHEN t THEN o UNLESS a\nWHEN t THEN o", "redundant-hedge")
    assert finding.help == "it has no response: add the response that you meant, or remove it and check again"
    (finding,) = found("WHEN t THEN o UNLESS a IN WHICH CASE o", "redundant-hedge")
    assert finding.help == "check whether its response is the one that you meant, or remove it and check again"


@pytest.mark.parametrize("reading", ["cascade", "priority"])
def test_a_text_that_states_its_reading_is_not_asked_about_it(reading):
    text = "WHEN t THEN o UNLESS a IN WHICH CASE p UNLESS b IN WHICH CASE q"
    (silent,) = found(text, "reading")
    assert f"READING {reading}" in silent.help
    stated = f"READING {reading}\n{text}"
    assert "reading" not in checks_for(parse(stated))
    assert not [f for result in run_checks(parse(stated)) for f in result.findings if f.severity == "warning"]


@pytest.mark.parametrize(
    ("first", "second"),
    [("({a} or {b})", "{b}"), ("{a}", "({a} and {b})")],
    ids=["priority", "cascade"],
)
def test_a_dsl_text_that_means_the_same_in_both_readings(first, second):
    rule = "R1 when E then O unless {} then P unless {} then Q"
    definitions = "event E event O event P event Q measure a:boolean measure b:boolean"
    text = "def_start {} def_end rule_start {} rule_end"
    (finding,) = found(text.format(definitions, rule.format("{a}", "{b}")), "reading")
    assert "with `or`" in finding.help
    assert "with `and`" in finding.help
    assert not found(text.format(definitions, rule.format(first, second)), "reading")


def test_what_decides_is_told_in_both_readings_and_in_nested_chains():
    text = "RULE r WHEN t AND g THEN o UNLESS a IN WHICH CASE (p UNLESS b IN WHICH CASE q) UNLESS c IN WHICH CASE s"
    context = Context(frozenset("t"), {"g": True, "a": True, "b": True})
    (because,) = entail(parse(text), context).because
    assert (because.clause, because.layer) == (2, "r.hc2")
    assert [(d.clause, d.truth) for d in because.decisions] == [(None, True), (1, True), (2, True), (3, False)]
    (because,) = entail(parse(f"READING priority\n{text}"), context).because
    assert [(d.clause, d.truth) for d in because.decisions] == [(None, True), (1, True), (2, True), (3, False)]


def test_a_chain_inside_the_default_decides_too():
    text = "RULE r WHEN t THEN (o UNLESS b IN WHICH CASE q) UNLESS a IN WHICH CASE p"
    (because,) = entail(parse(text), Context(frozenset("t"), {"b": True})).because
    assert (because.clause, because.obligations) == (1, ("q",))
    assert [(d.clause, d.truth) for d in because.decisions] == [(1, True), (2, False)]


def test_equal_conditions_in_several_constraints_are_one_condition():
    text = "CONDITION C\nNEVER A AND C\nNEVER B AND C OR D AND C\nWHEN T THEN A\nWHEN U THEN B"
    assert not entail(parse(text), Context(frozenset("T"), {"C": True})).consistent
    assert entail(parse(text), Context(frozenset("U"))).obligations == ("B",)


def test_a_vacuous_rule_has_a_situation_whatever_the_measures_are_compared_with():
    text = "MEASURE S: low < top\nNEVER S <= top AND A\nWHEN T THEN A"
    (finding,) = found(text, "vacuous-conflict")
    assert finding.witness.conditions == {"S": "low"}
    text = "ASSUME NOT M <= 0\nRULE r WHEN T THEN O AND NOT P\nRULE s WHEN T THEN P UNLESS M <= M AND M < M"
    assert [finding.rules[0] for finding in found(text, "vacuous-conflict")] == ["r", "s"]


def test_a_situation_is_one_of_each_domain_that_it_is_told_of():
    text = (
        "CONDITION Night, Busy\nWHEN Call THEN Answer UNLESS Busy IN WHICH CASE NOT Answer\nWHEN Call THEN Answer\n"
        "DOMAIN home\nWHEN Ring THEN Wave\nDOMAIN ward\nASSUME NOT (Call AND NOT Night)\nWHEN Ring THEN Wave"
    )
    home, ward = found(text, "conflict")
    assert (home.domains, home.witness.conditions) == (("home",), {"Busy": True})
    assert (ward.domains, ward.witness.conditions) == (("ward",), {"Busy": True, "Night": True})


def test_a_situation_that_cannot_be_says_so():
    answer = entail(parse("ASSUME NOT (t AND c)\nWHEN t THEN o"), Context(frozenset("t"), {"c": True}))
    assert len(answer.broken_assumptions) == 1
    assert answer.obligations == ("o",)


def test_measures_that_matter_and_are_not_given_are_named():
    answer = entail(
        parse("WHEN t THEN o UNLESS x < 1 IN WHICH CASE p\nWHEN u AND y < 1 THEN q"), Context(frozenset("t"))
    )
    assert answer.missing == ("x",)
    assert answer.obligations == ("o",)


def test_a_small_keyword_for_a_time_is_told_where_it_could_be_one():
    text = "WHEN t THEN stay within reach\nUNLESS the nurse is within reach IN WHICH CASE call someone else"
    (obligation,) = found(text, "phrase-keyword")
    assert obligation.message.startswith("`stay within reach`")
    (condition,) = found("WHEN t THEN wait UNLESS the nurse is away otherwise call", "phrase-keyword")
    assert condition.help == "if you mean the keyword, write OTHERWISE"


@pytest.mark.parametrize(
    ("phrase", "told"),
    [
        ("call the nurse after 5 minutes", 1),
        ("be there in 1 hour", 1),
        ("wait for 5 minutes", 0),
        ("wait 5 minutes", 0),
        ("stand by 2 chairs", 0),
    ],
)
def test_a_time_without_its_keyword_is_noted_where_it_tells_when(phrase, told):
    findings = found(f"WHEN no answer in 5 minutes THEN {phrase}", "phrase-keyword")
    assert len(findings) == told
    assert all("WITHIN" in finding.help for finding in findings)


def test_names_in_nested_hedges_of_a_claim_are_used():
    text = (
        "CONDITION x, y, z\nWHEN t THEN o\n"
        "CONCERN c EXISTS t WHILE (o UNLESS x IN WHICH CASE (o UNLESS y IN WHICH CASE (o UNLESS z)))"
    )
    assert not found(text, "unused-name")


def test_assumptions_that_a_situation_can_break():
    # What the replay asks is an index; Definition 1's context asks them all.
    text = "ASSUME a OR b\nASSUME NOT (a AND u)\nASSUME NOT c OR x > 1\nASSUME NOT d\nMEASURE x: integer\nWHEN t THEN o"
    index = RulesetIndex(parse(f"{text}\nWHEN u AND c AND d THEN p"))
    broken = 0
    for *on, x in product([False, True], [False, True], [False, True], [False, True], [False, True], [None, 1, 2]):
        conditions = dict(zip("abcd", on)) | ({} if x is None else {"x": x})
        context = Context(frozenset("tu" if on[4] else "t"), {name: v for name, v in conditions.items() if v})
        asked = index.assumptions_that_may_break(context)
        expected = broken_assumptions(index.ruleset, context)
        assert {a for a in asked if not holds(a.formula, context, index.ruleset.measures)} == set(expected)
        broken += bool(expected)
    assert broken == 96 - 16, "a, b and u leave 4 of 8, c and x 4 of 6, d one of 2"


def test_a_rule_that_only_a_constraint_brings_another_is_vacuous():
    """Where A is due, the constraint and the assumption together bring about t2, and there A is forbidden."""
    rules = "RULE r2\nWHEN t2 THEN NOT A\nRULE r1\nWHEN t1 THEN A\n"
    for constraints in ("NEVER A AND c9\nASSUME c9 OR t2\n", "NEVER A AND NOT t2\n"):
        (finding,) = found(constraints + rules, "vacuous-conflict")
        assert finding.rules == ("r1", "r2")
