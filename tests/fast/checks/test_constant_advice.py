"""What is said of a condition that never changes: who does as advised leaves the meaning of the rules as it is."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import parse
from sleec_runtime.model import And, Clause, Formula, Not, Or, Rule, Ruleset, Span
from sleec_verify.changes.compare import compare
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Finding

MEASURES = "MEASURE heat: number\nMEASURE cold: number\n"
TRUE, FALSE = "(heat > 3 OR heat <= 3)", "(cold > 3 AND cold < 2)"


def advice(finding: Finding) -> str:
    assert finding.help is not None
    return finding.help


def findings(ruleset: Ruleset) -> tuple[Finding, ...]:
    (result,) = run_checks(ruleset, ["constant-condition"])
    return result.findings


def only(text: str) -> Finding:
    (finding,) = findings(parse(text))
    return finding


def without(formula: Formula, span: Span) -> Formula | None:
    """The formula without the part that stands there; None if nothing is left."""
    if formula.span == span:
        return None
    if isinstance(formula, Not):
        inner = without(formula.operand, span)
        assert inner is not None, "what is denied is left out with NOT"
        return replace(formula, operand=inner)
    if isinstance(formula, (And, Or)):
        left = [kept for kept in (without(operand, span) for operand in formula.operands) if kept is not None]
        return left[0] if len(left) == 1 else replace(formula, operands=tuple(left))
    return formula


def with_rule(ruleset: Ruleset, rule: Rule) -> Ruleset:
    return replace(ruleset, statements=tuple(rule if isinstance(s, Rule) else s for s in ruleset.statements))


def what_can_go(finding: Finding) -> Span:
    return finding.related[0][0] if finding.related else finding.span


CONDITIONS = st.recursive(
    st.sampled_from(["c", "d", "e", TRUE, FALSE]),
    lambda inner: st.one_of(
        inner.map(lambda one: f"(NOT {one})"),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: f"({' AND '.join(parts)})"),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: f"({' OR '.join(parts)})"),
    ),
    max_leaves=5,
)


@settings(max_examples=100)
@given(CONDITIONS, st.booleans())
def test_what_can_be_left_out_of_a_condition_changes_nothing(condition, in_guard):
    text = f"WHEN t AND {condition} THEN a" if in_guard else f"WHEN t THEN a UNLESS {condition} IN WHICH CASE b"
    ruleset = parse(MEASURES + text)
    (rule,) = ruleset.rules
    whole = rule.guard if in_guard else rule.hedges[0].condition
    assert whole is not None
    for finding in findings(ruleset):
        left = without(whole, what_can_go(finding))
        if in_guard:
            assert (left is None) == ("remove the whole condition after the trigger" in advice(finding))
            changed = replace(rule, guard=left)
        elif left is None:
            assert advice(finding).startswith("correct it: at present, the exception always applies")
            continue
        else:
            changed = replace(rule, hedges=(replace(rule.hedges[0], condition=left),))
        assert compare(ruleset, with_rule(ruleset, changed)).relation == "equivalent"


@pytest.mark.parametrize(
    ("condition", "leave_out", "said"),
    [
        (f"c AND {TRUE}", TRUE, "remove it"),
        (f"c OR {FALSE}", FALSE, "remove it"),
        (f"c AND (d OR {TRUE})", f"(d OR {TRUE})", "remove the whole OR, which is always true"),
        (f"c OR (d AND {FALSE})", f"(d AND {FALSE})", "remove the whole AND, which is always false"),
        (f"c OR (d AND NOT {TRUE})", f"(d AND NOT {TRUE})", "remove the whole AND, which is always false"),
        (f"c AND NOT {FALSE}", f"NOT {FALSE}", "remove the whole NOT, which is always true"),
    ],
)
def test_the_whole_that_can_go_is_shown(condition, leave_out, said):
    finding = only(f"{MEASURES}WHEN t AND ({condition}) THEN a")
    text = f"{MEASURES}WHEN t AND ({condition}) THEN a"
    span = what_can_go(finding)
    assert text[span.start : span.end].strip("()") == leave_out.strip("()")
    assert advice(finding) == f"correct it, or {said}"


def test_in_the_dsl_the_words_are_those_of_the_dsl():
    finding = only(
        "def_start event Called event Answer measure heat: numeric measure c: boolean measure d: boolean def_end\n"
        "rule_start R1 when Called and ({c} and ({d} or ({heat} = {heat}))) then Answer rule_end"
    )
    assert advice(finding) == "correct it, or remove the whole or, which is always true"


@pytest.mark.parametrize("condition", [TRUE, f"c OR {TRUE}", f"NOT (c AND {FALSE})"])
def test_a_guard_that_is_always_true_can_go(condition):
    old = parse(f"{MEASURES}WHEN t AND ({condition}) THEN a UNLESS d IN WHICH CASE b")
    (finding,) = findings(old)
    assert advice(finding).startswith("correct it, or remove the whole condition after the trigger")
    assert compare(old, with_rule(old, replace(old.rules[0], guard=None))).relation == "equivalent"


PLACES = [(place, length) for length in range(1, 4) for place in range(length)]


@pytest.mark.parametrize("reading", ["cascade", "priority"])
@pytest.mark.parametrize("condition", [TRUE, f"z OR {TRUE}"])
@pytest.mark.parametrize(("place", "length"), PLACES)
def test_a_hedge_that_always_holds(reading, condition, place, length):
    hedges = [f"UNLESS {condition if n == place else f'c{n}'} IN WHICH CASE o{n}" for n in range(length)]
    old = parse(f"{MEASURES}READING {reading}\nWHEN t THEN a {' '.join(hedges)}")
    (finding,) = findings(old)
    assert (advice(finding).count("always applies") == 1) == (
        place + 1 == length and (place == 0 or reading == "priority")
    )
    (rule,) = old.rules
    if "replace the default response by its response," in advice(finding):
        assert "the default response never applies" in advice(finding) or "neither the default response nor" in advice(
            finding
        )
        assert ("remove the exception and those before it" in advice(finding)) == (place > 0)
        response = rule.hedges[place].obligations
        changed = replace(rule, default=replace(rule.default, obligations=response), hedges=rule.hedges[place + 1 :])
    else:
        assert "the exception before it never applies" in advice(finding)
        before = replace(rule.hedges[place - 1], obligations=rule.hedges[place].obligations)
        changed = replace(rule, hedges=(*rule.hedges[: place - 1], before, *rule.hedges[place + 1 :]))
    assert compare(old, with_rule(old, changed)).relation == "equivalent"
    # To leave out the hedge, or no more than its condition, is no way.
    less = replace(rule, hedges=(*rule.hedges[:place], *rule.hedges[place + 1 :]))
    assert compare(old, with_rule(old, less)).relation != "equivalent"


def test_a_hedge_without_a_response_is_not_told_to_move_it():
    finding = only(f"{MEASURES}WHEN t THEN a UNLESS {TRUE}")
    assert (
        advice(finding) == "correct it: at present, the exception always applies, so the default response never applies"
    )


def test_in_a_chain_inside_a_response():
    text = f"{MEASURES}WHEN t THEN a UNLESS c IN WHICH CASE (b UNLESS {TRUE} IN WHICH CASE o)"
    old = parse(text)
    (finding,) = findings(old)
    first = "the response before the first UNLESS"
    assert f"so {first} never applies" in advice(finding)
    assert f"replace {first} by its response" in advice(finding)
    (rule,) = old.rules
    holder = rule.hedges[0]
    changed = Clause(holder.condition, holder.hedges[0].obligations)
    assert compare(old, with_rule(old, replace(rule, hedges=(changed,)))).relation == "equivalent"


@pytest.mark.parametrize(
    ("beside", "said"),
    [
        ("concern_start k exists Called and ({risk} >= low) concern_end", "the concern means the same without it"),
        ("purpose_start k exists Called and ({risk} >= low) purpose_end", "the purpose means the same without it"),
        (
            "concern_start k exists Called and (({heat} > 3) and ({heat} < 2)) concern_end",
            "at present, the concern can never happen",
        ),
        ("relation_start measure invariant ({risk} >= low) relation_end", "check whether you need the relation"),
        (
            "concern_start k when Called then Answer unless (({heat} > 3) and ({heat} < 2)) then Wait concern_end",
            "correct it, or remove the exception",
        ),
    ],
)
def test_beside_the_rules(beside, said):
    finding = only(
        "def_start event Called event Answer event Wait measure heat: numeric measure risk: scale(low, high) def_end\n"
        f"rule_start R1 when Called then Answer R2 when Called then Wait rule_end\n{beside}"
    )
    assert said in advice(finding)
