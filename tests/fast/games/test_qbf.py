"""Quantified formulas against a table of all their values."""

from __future__ import annotations

from itertools import product
from random import Random

import pytest

from sleec_verify.encoding.solver import Undecided
from sleec_verify.games import qbf as quantified
from sleec_verify.games.circuit import FALSE, TRUE, Circuit
from sleec_verify.games.qbf import winning_move


def _random_goal(circuit: Circuit, random: Random, variables: list[int]) -> int:
    if len(variables) < 2:
        return variables[0]
    literals = [variable * random.choice((1, -1)) for variable in variables]
    for _ in range(random.randint(3, 14)):
        a, b = random.sample(literals, 2)
        sign = random.choice((1, -1))
        literals.append(sign * circuit.both(a * random.choice((1, -1)), b * random.choice((1, -1))))
        if abs(literals[-1]) == 1:
            literals.pop()
    return circuit.same(literals[-1], literals[-2])


def _wins(circuit: Circuit, turns: list[list[int]], goal: int) -> bool:
    """Whether the player whose turn it is gets `goal`, by trying all."""
    for values in product((1, -1), repeat=len(turns[0])):
        left = circuit.replaced(goal, dict(zip(turns[0], values)))
        if (left == TRUE) if len(turns) == 1 else not _wins(circuit, turns[1:], -left):
            return True
    return False


@pytest.mark.parametrize("seed", range(400))
def test_who_wins_is_what_trying_all_says(seed: int) -> None:
    random = Random(seed)
    circuit = Circuit()
    turns = [circuit.variables(random.randint(1, 3)) for _ in range(random.randint(1, 5))]
    goal = _random_goal(circuit, random, [variable for turn in turns for variable in turn])
    found = winning_move(circuit, turns[0], goal, turns[1:])
    assert (found is not None) == _wins(circuit, turns, goal)
    if found is not None:
        left = circuit.replaced(goal, found)
        assert left == TRUE if len(turns) == 1 else not _wins(circuit, turns[1:], -left)


def test_equal_parts_are_one_part() -> None:
    circuit = Circuit()
    a, b = circuit.variables(2)
    assert circuit.both(a, b) == circuit.both(b, a)
    assert circuit.both(a, -a) == FALSE
    assert circuit.every(()) == TRUE
    assert circuit.some(()) == FALSE
    assert circuit.choice(TRUE, a, b) == a
    assert circuit.replaced(circuit.same(a, b), {a: TRUE}) == b
    assert circuit.replaced(-TRUE, {}) == FALSE


def test_too_large_is_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.games.circuit.MOST_NODES", 5)
    circuit = Circuit()
    a, b, c, d = circuit.variables(4)
    with pytest.raises(Undecided, match="would need more than"):
        circuit.every([circuit.both(a, b), circuit.both(b, c), circuit.both(c, d)])


def test_too_long_is_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quantified, "MOST_MOVES", 2)
    circuit = Circuit()
    mine, yours = circuit.variables(3), circuit.variables(3)
    goal = circuit.every(circuit.same(a, b) for a, b in zip(mine, yours))
    with pytest.raises(Undecided, match="moves"):
        winning_move(circuit, mine, goal, [yours])
