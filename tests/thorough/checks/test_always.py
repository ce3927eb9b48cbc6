"""ALWAYS by brute force, and with time against the text with one rule for each trigger."""

from __future__ import annotations

import re
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.evaluation.conflicts import conflict
from sleec_runtime.evaluation.due import due
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Obligation, Rule, Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.entailment.entailment import entail
from sleec_verify.results.finding import Unknown
from tests.support import brute_force as brute
from tests.support.small_rulesets import OBLIGATIONS, TRIGGERS, small_rulesets
from tests.support.timed_english import timed_english

KINDS = f"TRIGGER {', '.join(TRIGGERS)}\nCONDITION c1, c2, c3\n"
PLAIN = small_rulesets(rules=2, hedges=1, nested=False, assumptions=False)
RESPONSE = st.lists(st.sampled_from([*OBLIGATIONS, "NOT o1", "NOT o2", "o4"]), min_size=1, max_size=2, unique=True).map(
    " AND ".join
)
CHAIN = st.lists(
    st.tuples(st.sampled_from(["c1", "NOT c2", "c1 OR t1", "c2 AND c3"]), st.one_of(st.just(""), RESPONSE)), max_size=2
).map(lambda hedges: "".join(f"\nUNLESS {c}{f' IN WHICH CASE ({r})' if r else ''}" for c, r in hedges))
STATEMENT = st.tuples(RESPONSE, CHAIN).map(lambda parts: "ALWAYS " + "".join(parts) + "\n")
NEVER = st.one_of(
    st.just(""), st.sampled_from(["c1", "NOT c2 UNLESS t2", "c3 OR t1"]).map("NEVER o2 UNLESS {}\n".format)
)


def literals(ruleset: Ruleset, statement: Rule, context) -> set[Obligation]:
    """What is due: that of the rules, and wherever something occurs, that of the statement."""
    found: set[Obligation] = set()
    for rule in ruleset.rules:
        number = brute.active(rule, ruleset, context) if rule.always is None else None
        if number is not None:
            found |= set(list(rule.clauses())[number].obligations)
    if context.triggers:
        decided = brute.active(replace(statement, trigger=min(context.triggers)), ruleset, context)
        assert decided is not None
        found |= set(list(statement.clauses())[decided].obligations)
    return found


@settings(max_examples=60, deadline=None)
@given(PLAIN, STATEMENT, NEVER)
def test_it_is_due_wherever_something_occurs(small: Ruleset, always: str, never: str) -> None:
    ruleset = parse(f"{print_ruleset(small)}\n{KINDS}{always}{never}")
    printed = print_ruleset(ruleset)
    assert parse(printed) == ruleset
    assert print_ruleset(parse(printed)) == printed
    statement = next(rule for rule in ruleset.rules if rule.always)
    conflicting = set()
    for context in brute.contexts(ruleset):
        expected = literals(ruleset, statement, context)
        assert set(due(ruleset, context).literals) == expected
        clashes = brute.clash(ruleset, context, expected)
        assert (conflict(ruleset, context) is not None) == clashes
        answer = entail(ruleset, context)
        assert answer.consistent != clashes
        if clashes:
            conflicting.add((context.triggers, tuple(sorted(context.conditions.items()))))
        else:
            assert set(answer.obligations) == {o.name for o in expected if not o.negated}
    (result,) = run_checks(ruleset, ["conflict"])
    assert bool(result.findings) == bool(conflicting)
    assert {about(finding.clauses) for finding in result.findings} == {
        frozenset((_statement(label), number) for label, number in cause) for cause in brute.causes(ruleset)
    }


def about(clauses) -> frozenset[tuple[str, int]]:
    """The clauses of a finding, with the statement instead of its instances."""
    return frozenset((_statement(label), number) for label, number in clauses)


def _statement(label: str) -> str:
    return "always_1" if label.startswith("always_1_") else label


def explicit(text: str, response: str) -> str:
    """The rules of `text`, and one rule with this response for each of their triggers, with the labels of the
    instances."""
    triggers = dict.fromkeys(re.findall(r"^RULE \w+ WHEN (\w)", text, re.MULTILINE))
    rules = "".join(f"RULE always_1_{trigger} WHEN {trigger} THEN {response}\n" for trigger in triggers)
    return text + rules


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_with_time_it_is_one_rule_for_each_trigger(seed: int) -> None:
    text = timed_english(seed)
    choose = Random(seed)
    response = choose.choice(["A", "NOT B", "C WITHIN 2 seconds", "NOT A WITHIN 1 TO 2 seconds", "B UNLESS m"])
    always, plain = parse(f"{text}ALWAYS {response}\n"), parse(explicit(text, response))
    names = ["conflict", "dead-rule"]
    for one, other in zip(run_checks(always, names), run_checks(plain, names)):
        if isinstance(one.verdict, Unknown) or isinstance(other.verdict, Unknown):
            assert type(one.verdict) is type(other.verdict)
            continue
        if one.name == "conflict":
            assert {about(f.clauses) for f in one.findings} == {about(f.clauses) for f in other.findings}
        else:
            assert {f.rules[0] for f in one.findings} <= {f.rules[0] for f in other.findings}
