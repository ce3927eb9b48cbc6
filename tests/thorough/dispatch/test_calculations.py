"""Rules at work calculate."""

from __future__ import annotations

import pytest

import sleec_runtime
from sleec_runtime.model import Calculation, Comparison
from tests.support.calculations import guard_of, ruleset_of


@pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")
def test_rules_at_work_calculate():
    ruleset = ruleset_of("R1 when A and (({x} + {y}) > K) then B unless (({x} * {y}) > 9) then C")
    sleec = sleec_runtime.Sleec(ruleset)
    done = []
    sleec.implement({"B": lambda: done.append("B"), "C": lambda: done.append("C")})
    assert set(sleec.vocabulary) == {"x", "y", "z"}
    sleec.update({"x": 1})
    sleec.trigger("A")
    sleec.update({"y": 3})
    sleec.trigger("A")
    sleec.update({"x": 4})
    sleec.trigger("A")
    assert done == ["B", "C"]


def test_the_model_says_what_it_is_made_of():
    guard = guard_of("(({x} + (2 * {y} * {x})) > K)")
    assert isinstance(guard, Comparison)
    assert guard.left == Calculation(((1, ("x",)), (2, ("x", "y"))))
    assert guard.left.measures == ("x", "y")
    assert str(guard.left) == "x + 2 * x * y"
    assert guard.left.value({"x": 3, "y": 2}) == 15
