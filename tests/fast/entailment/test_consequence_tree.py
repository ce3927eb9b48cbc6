"""What becomes due once what is due is done."""

from __future__ import annotations

import pytest

from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_verify.entailment.active_clauses import active_clauses
from sleec_verify.entailment.consequence_tree import DEEPEST, chain
from sleec_verify.report.consequence_tree import lines
from tests.support.timed_strategies import timed_ruleset


def tree(text, when, **given):
    ruleset = parse(text)
    context = Context(frozenset({when}), given)
    return list(lines(chain(ruleset, context, active_clauses(ruleset, context)).steps))


def test_a_chain_with_a_cycle():
    text = "RULE r1 WHEN A THEN B\nRULE r2 WHEN B THEN C UNLESS m IN WHICH CASE D\nRULE r3 WHEN C THEN B AND A"
    assert tree(text, "A") == [
        "  B",
        "    r2: C",
        "      C",
        "        r3: B AND A",
        "          B (already in progress: a cycle)",
        "          A (already in progress: a cycle)",
    ]
    assert tree(text, "A", m=True) == ["  B", "    r2.hc1: D"]


def test_what_two_rules_lead_to_is_shown_once():
    text = "RULE r1 WHEN A THEN B AND C\nRULE r2 WHEN B THEN D\nRULE r3 WHEN C THEN D\nRULE r4 WHEN D THEN E"
    shown = tree(text, "A")
    assert shown.count("        r4: E") == 1
    assert "      D (as above)" in shown


def test_a_prohibition_that_a_chain_meets():
    text = "RULE r1 WHEN A THEN B AND NOT D\nRULE r2 WHEN B THEN D"
    assert tree(text, "A") == ["  B", "    r2: D", "      D (forbidden by r1)"]


def test_what_is_done_at_once_occurs_with_the_triggers_of_the_situation():
    rules = "RULE r1 WHEN A THEN B{}\nRULE r2 WHEN B THEN C UNLESS A IN WHICH CASE D\nRULE r3 WHEN C THEN E"
    assert tree(rules.format(""), "A") == ["  B", "    r2.hc1: D"]
    assert tree(rules.format(" WITHIN 5 minutes"), "A") == ["  B", "    r2: C", "      C", "        r3: E"]


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
    answer = active_clauses(ruleset, context)

    def done_by(trigger):
        here = Context(frozenset({trigger}), context.conditions)
        decisions = (
            decide(rule, here, ruleset.reading, ruleset.measures) for rule in ruleset.rules if rule.trigger == trigger
        )
        return {o.name for d in decisions if d is not None for o in d.obligations if not o.negated}

    stated = {name for because in answer.because for name in because.obligations if not name.startswith("NOT ")}
    closure, ahead = set(), set(stated)
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

    found = stated | set(names(chain(ruleset, context, answer).steps))
    assert found == closure


def forbidden(text, when):
    """What the tree says of each step: the clauses that forbid it, by name."""
    ruleset = parse(text)
    context = Context(frozenset(when), {})
    found = {}

    def walk(steps):
        for step in steps:
            found[step.name] = step.forbidden
            for _, done in step.clauses:
                walk(done)

    answer = chain(ruleset, context, active_clauses(ruleset, context))
    walk(answer.steps)
    return found, dict(answer.at_odds)


WINDOWS = [(0, 0), (0, 2), (1, 3), (2, 2)]


@pytest.mark.parametrize("prohibition", [(0, 0), (0, 2), (0, 5), (1, 3), (2, 6)])
@pytest.mark.parametrize("trigger", ["X", "B", "C"])
@pytest.mark.parametrize("later", WINDOWS)
@pytest.mark.parametrize("first", WINDOWS)
def test_a_step_is_forbidden_if_it_is_at_every_time_at_which_it_may_be_done(first, later, trigger, prohibition):
    def within(window):
        return f"within [{window[0]}, {window[1]}] seconds"

    text = f"""def_start
event A
event B
event C
event X
def_end
rule_start
r1 when A then B {within(first)}
r2 when B then C {within(later)}
r3 when {trigger} then not C {within(prohibition)}
r4 when C then not B {within(prohibition)}
rule_end
"""
    found, _ = forbidden(text, ["A", "X"])
    start, end = prohibition
    courses = [
        {"X": 0, "B": b, "C": b + c} for b in range(first[0], first[1] + 1) for c in range(later[0], later[1] + 1)
    ]
    assert (found["C"] == ("r3",)) == all(start <= times["C"] - times[trigger] <= end for times in courses)
    # What is triggered at last may forbid what was due before.
    assert (found["B"] == ("r4",)) == all(start <= times["B"] - times["C"] <= end for times in courses)


def test_what_the_situation_forbids_for_a_time_is_named():
    text = "R1 when A then B within 5 minutes\nR2 when X then not B within {} minutes\nR3 when B then C\n"
    text = f"def_start\nevent A\nevent B\nevent C\nevent X\ndef_end\nrule_start\n{text}rule_end\n"
    assert forbidden(text.format(10), ["A", "X"])[0] == {"B": ("R2",), "C": ()}
    assert forbidden(text.format(4), ["A", "X"])[0] == {"B": (), "C": ()}
    # Something else may come in place of what is forbidden.
    assert forbidden(text.format("10 minutes otherwise C within 1"), ["A", "X"])[0]["B"] == ()


def test_events_of_the_situation_that_are_forbidden_there():
    text = "RULE r1 WHEN A THEN B\nRULE r2 WHEN B THEN NOT A WITHIN 5 minutes\n"
    text += "RULE r3 WHEN B THEN NOT X WITHIN 1 TO 2 minutes\n"
    assert forbidden(text, ["A", "X"])[1] == {"A": ("r2",)}
    # Without times, that something happened is not that it is done.
    assert forbidden("RULE r1 WHEN A THEN B\nRULE r2 WHEN B THEN NOT A", ["A"])[1] == {}
