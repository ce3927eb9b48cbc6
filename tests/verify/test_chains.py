"""What becomes due once what is due is done."""

from __future__ import annotations

import pytest

from sleec_runtime.evaluation import decide
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_verify.chains import DEEPEST, chain, lines
from sleec_verify.entailment import entail
from tests.timed_strategies import timed_ruleset


def tree(text, when, **given):
    ruleset = parse(text)
    context = Context(frozenset({when}), given)
    return list(lines(chain(ruleset, context, entail(ruleset, context))))


def test_a_chain_with_a_cycle():
    text = "RULE r1 WHEN A THEN B\nRULE r2 WHEN B THEN C UNLESS m IN WHICH CASE D\nRULE r3 WHEN C THEN B AND A"
    assert tree(text, "A") == [
        "  B",
        "    r2: C",
        "      C",
        "        r3: B AND A",
        "          B (which happens already: a cycle)",
        "          A (which happens already: a cycle)",
    ]
    assert tree(text, "A", m=True) == ["  B", "    r2.hc1: D"]


def test_what_two_rules_lead_to_is_shown_once():
    text = "RULE r1 WHEN A THEN B AND C\nRULE r2 WHEN B THEN D\nRULE r3 WHEN C THEN D\nRULE r4 WHEN D THEN E"
    shown = tree(text, "A")
    assert shown.count("        r4: E") == 1
    assert "      D (as above)" in shown


def test_a_prohibition_that_a_chain_meets():
    text = "RULE r1 WHEN A THEN B AND NOT D\nRULE r2 WHEN B THEN D"
    assert tree(text, "A") == ["  B", "    r2: D", "      D (which r1 forbids)"]


def test_nothing_is_shown_where_nothing_follows():
    assert tree("RULE r1 WHEN A THEN B", "A") == []


def test_a_chain_without_end_in_sight_is_cut():
    text = "".join(f"RULE r{n} WHEN E{n} THEN E{n + 1}\n" for n in range(3 * DEEPEST))
    shown = tree(text, "E0")
    assert shown[-1].endswith("(and so on)")
    assert len(shown) < 3 * DEEPEST


@pytest.mark.parametrize("seed", range(200))
def test_the_steps_are_the_closure(seed):
    ruleset = timed_ruleset(seed)
    conditions = {"m": seed % 2 == 0, "n": seed % 3 == 0, "risk": "low"}
    context = Context(
        frozenset({"A"}), {k: v for k, v in conditions.items() if k in (*ruleset.conditions, *ruleset.measures)}
    )
    answer = entail(ruleset, context)

    def done_by(trigger):
        here = Context(frozenset({trigger}), context.conditions)
        decisions = (
            decide(rule, here, ruleset.reading, ruleset.measures) for rule in ruleset.rules if rule.trigger == trigger
        )
        return {o.name for d in decisions if d is not None for o in d.obligations if not o.negated}

    closure, ahead = set(), set(answer.obligations)
    while ahead:
        name = ahead.pop()
        closure.add(name)
        ahead |= (set() if name == "A" else done_by(name)) - closure

    def names(steps):
        for step in steps:
            yield step.name
            for because, done in step.clauses:
                yield from (name for name in because.obligations if not name.startswith("NOT "))
                yield from names(done)

    found = set(answer.obligations) | set(names(chain(ruleset, context, answer)))
    assert found == closure
