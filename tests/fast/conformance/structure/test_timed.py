"""Rules with time: a correct robot has no finding, and each mistake in it is found or undecided."""

from __future__ import annotations

import pytest

from tests.support.structure import kinds
from tests.support.timed_robot import MISTAKES, ROBOT, RULES, Mistake


def test_the_correct_robot() -> None:
    assert kinds(RULES, robot=ROBOT) == []


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.name)
def test_a_mistake(mistake: Mistake) -> None:
    assert mistake.old in ROBOT
    found = kinds(RULES, robot=ROBOT.replace(mistake.old, mistake.new))
    assert mistake.kind in found
