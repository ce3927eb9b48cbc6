"""The exit code of `cases`."""

from __future__ import annotations

from tests.support.cli import Cli

RULES = "WHEN t THEN o WITHIN n minutes\n"


def test_a_goal_that_is_unknown_has_its_exit_code(cli: Cli) -> None:
    ran = cli("cases", "a.sleec", files={"a.sleec": f"MEASURE n: integer\n{RULES}"})
    assert ran.code == 3
    assert "2 unknown" in ran.err
    bounded = f"MEASURE n: integer\nASSUME n >= 1 AND n <= 2\n{RULES}"
    ran = cli("cases", "b.sleec", files={"b.sleec": bounded})
    assert (ran.code, "unknown" in ran.err) == (0, False)
