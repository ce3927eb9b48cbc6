"""What a conflict can go through: rules that have to do with it by ways that are easily left out."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.language import parse
from sleec_verify.timed import conflicts
from sleec_verify.timed.conflict_cone import Cone
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.program import Program
from tests import timed_oracle as oracle
from tests.timed_agreement import answered

WAYS = {
    "what else forbids what is due, where this rule forbids it for a part of its window": """
        RULE other WHEN A THEN NOT C WITHIN 1 seconds
        RULE r WHEN T THEN NOT C WITHIN [2, 5] seconds UNLESS m
        RULE due WHEN D THEN C WITHIN 3 seconds""",
    "what the event that is due calls for": """
        RULE other WHEN A THEN NOT E WITHIN 3 seconds
        RULE calls WHEN C THEN E WITHIN 1 seconds
        RULE r WHEN T THEN NOT C WITHIN [2, 5] seconds UNLESS m
        RULE due WHEN D THEN C WITHIN 3 seconds""",
    "what comes in place of what is due": """
        RULE other WHEN A THEN NOT E WITHIN 3 seconds
        RULE calls WHEN C THEN E WITHIN 1 seconds
        RULE r WHEN T THEN NOT C WITHIN [2, 5] seconds UNLESS m
        RULE answers WHEN X THEN E
        RULE due WHEN D THEN C WITHIN 3 seconds OTHERWISE X""",
    "what comes in place of what is forbidden": """
        RULE r WHEN T THEN X
        RULE forbids WHEN S THEN NOT X WITHIN 5 seconds OTHERWISE Y WITHIN 2 seconds
        RULE other WHEN U THEN NOT Y WITHIN 100 seconds""",
    "what comes in place of what is forbidden, and calls for something": """
        RULE r WHEN T THEN X
        RULE forbids WHEN S THEN NOT X WITHIN 5 seconds OTHERWISE Y
        RULE calls WHEN Y THEN Z
        RULE other WHEN U THEN NOT Z WITHIN 100 seconds""",
    "what comes in place of what this rule forbids": """
        RULE r WHEN T THEN NOT X WITHIN 1 seconds
        RULE calls WHEN S THEN X WITHIN 1 seconds OTHERWISE Y
        RULE other WHEN U THEN NOT Y WITHIN 100 seconds""",
    "what triggers the prohibition later": """
        RULE r WHEN T THEN X WITHIN [3, 3] seconds
        RULE forbids WHEN S THEN NOT X
        RULE calls WHEN P THEN S WITHIN [4, 4] seconds""",
    "measures that suit only one of two rules at a time to come": """
        CONDITION m
        RULE r WHEN T THEN X WITHIN [2, 2] seconds
        RULE calls WHEN X THEN Bad UNLESS m
        RULE bad WHEN Bad THEN NOT Bad
        RULE past WHEN S THEN Y WITHIN [3, 3] seconds
        RULE other WHEN Y AND m THEN Bad""",
    "measures that a relation keeps from what suits": """
        CONDITION m
        RULE r WHEN T THEN X WITHIN [1, 1] seconds
        RULE calls WHEN X THEN Bad UNLESS m
        RULE bad WHEN Bad THEN NOT Bad
        RELATION WHEN S THEN NOT m FOR 2 seconds""",
    "what a relation ties to an event": """
        RULE r WHEN T THEN X WITHIN 2 seconds
        RELATION X EQUALS Y
        RULE calls WHEN Y THEN Z
        RULE other WHEN U THEN NOT Z WITHIN 5 seconds""",
}


@pytest.mark.parametrize("text", WAYS.values(), ids=WAYS.keys())
def test_a_conflict_by_way_of(text):
    program = Program(parse(text if "CONDITION" in text or "UNLESS" not in text else f"CONDITION m\n{text}"))
    rule = program.ruleset.by_label["r"]
    found = conflict(program, rule)
    assert found is not None
    assert oracle.conflict(program.ruleset, "r", past=len(found.instants) - 1, later=2, longest=4).found


class Whole(Cone):
    """All rules and events, whatever they have to do with each other."""

    def __init__(self, program, rule):
        self.rules = dict(program.ruleset.by_label)
        self.events = {rule.trigger for rule in program.rules}
        self.events |= {what.event for rule in program.rules for what in program.windows(rule)}


def sparse(seed):
    """A text whose rules have less to do with each other than those of tests/timed_strategies.py."""
    draw = Random(seed)
    events = [f"E{n}" for n in range(draw.randint(4, 9))]
    windows = ("",) * 3 + tuple(f" WITHIN {w} seconds" for w in ("1", "2", "[1, 2]", "[2, 2]")) + (" EVENTUALLY",)
    conditions = ("m", "NOT m", "n", "NOT n", "m AND n")

    def response(otherwise):
        text = ("NOT " if draw.random() < 0.35 else "") + draw.choice(events) + draw.choice(windows)
        return f"{text} OTHERWISE {response(otherwise - 1)}" if otherwise and draw.random() < 0.3 else text

    lines = ["CONDITION m", "CONDITION n"]
    for number in range(draw.randint(3, 6)):
        guard = f" AND {draw.choice(conditions)}" if draw.random() < 0.3 else ""
        line = f"RULE R{number} WHEN {draw.choice(events)}{guard} THEN {response(2)}"
        if "OTHERWISE" not in line and draw.random() < 0.4:
            line += f" UNLESS {draw.choice(conditions)} IN WHICH CASE {response(0)}"
        lines.append(line)
    return "\n".join(lines)


def nothing_else_matters(seed, monkeypatch):
    """How many conflicts were looked for among all rules as well."""
    program = Program(parse(sparse(seed)))
    count = 0
    for rule in program.rules if program.is_acyclic else ():
        if len(Cone(program, rule).rules) < len(program.rules):
            ours = answered(lambda: conflict(program, rule) is not None)  # noqa: B023
            with monkeypatch.context() as patch:
                patch.setattr(conflicts, "Cone", Whole)
                whole = answered(lambda: conflict(program, rule) is not None)  # noqa: B023
            if ours is not None and whole is not None:
                assert ours == whole, f"seed {seed}, {rule.label}\n{program.ruleset.source.text}"
                count += 1
    return count


@pytest.mark.parametrize("first", [0, 20])
def test_nothing_else_matters(first, monkeypatch):
    assert sum(nothing_else_matters(seed, monkeypatch) for seed in range(first, first + 20)) > 0


@pytest.mark.long
@pytest.mark.parametrize("first", range(40, 1000, 40))
def test_nothing_else_matters_to_many(first, monkeypatch):
    for seed in range(first, first + 40):
        nothing_else_matters(seed, monkeypatch)


def chain(count):
    return "\n".join(f"RULE R{n} WHEN E{n} THEN E{n + 1} WITHIN 5 seconds" for n in range(count))


def test_a_long_chain():
    count = 2_000
    program = Program(parse(f"{chain(count)}\nRULE shut WHEN S THEN NOT E{count} WITHIN 5 seconds"))
    cone = Cone(program, program.rules[count // 2])
    # What was triggered before may press, and what is triggered now leads on.
    assert len(cone.rules) == count + 1


def test_what_can_be_done_whatever_else_is_the_case_concerns_nothing():
    program = Program(parse(f"{chain(100)}\nRULE other WHEN E0 THEN NOT E0 OTHERWISE E50"))
    assert list(Cone(program, program.rules[50]).rules) == ["R50"]
    # E0 is forbidden, but nothing calls for it again.
    assert conflict(program, program.rules[0]) is None
    assert conflict(program, program.rules[100]) is None
