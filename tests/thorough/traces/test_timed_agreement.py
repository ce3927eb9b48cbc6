"""The answers about rules with time are those of the second method (tests/support/timed_agreement.py)."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from tests.support.paths import ROOT
from tests.support.timed_agreement import (
    compare_all,
    compare_calculations,
    compare_conflicts,
    compare_english,
    compare_lengths,
    compare_named,
)


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_structured_english_is_answered_as_z3_answers_it():
    """Both readings, several obligations in a response, which may contradict one another, numbers, constraints."""
    compare_english(0, 20)


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_rulesets_that_calculate_are_answered_as_z3_answers_them():
    """The product asks z3, too, but only what single instants can be; the second method shares nothing of that."""
    assert compare_calculations(0, 20) > 80


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_rulesets_whose_conditions_name_events_are_answered_as_z3_answers_them():
    """All questions but `conflict`, which is not decided about these."""
    assert compare_named(0, 60) > 250


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_conflicts_of_random_rulesets_are_those_that_z3_finds():
    assert compare_conflicts(0, 50) > 3


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_windows_whose_lengths_measures_give_are_answered_as_z3_answers_them():
    assert compare_lengths(0, 30) > 150
    assert compare_conflicts(0, 25, lengths=True) > 3


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("first", range(30, 1_030, 100))
def test_many_windows_whose_lengths_measures_give_are_answered_as_z3_answers_them(first):
    compare_lengths(first, first + 100)
    compare_conflicts(first, first + 100, lengths=True)


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("first", range(50, 1_050, 100))
def test_conflicts_of_many_random_rulesets_are_those_that_z3_finds(first):
    compare_conflicts(first, first + 100)


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_random_rulesets_are_answered_as_z3_answers_them():
    """In processes of their own, side by side, where no coverage is measured: that would take several times as long."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("COVERAGE")}
    command = [sys.executable, "-m", "tests.support.timed_agreement"]
    runs = [
        subprocess.Popen(
            [*command, str(first), str(first + 60)],
            cwd=ROOT,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for first in (0, 60, 120)
    ]
    answered = 0
    for run in runs:
        output, errors = run.communicate()
        assert (run.returncode, errors) == (0, "")
        answered += int(output)
    assert answered > 880, "few questions are given up"


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("first", range(180, 5_020, 100))
def test_many_random_rulesets_are_answered_as_z3_answers_them(first):
    compare_all(first, min(first + 100, 5_020), large=True)


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("first", range(20, 1_020, 100))
def test_much_structured_english_is_answered_as_z3_answers_it(first):
    compare_english(first, first + 100)
