"""Realizability: against brute force, and what people read of it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from sleec_runtime.language import load, parse
from sleec_verify.checks import run_checks
from sleec_verify.encoding.solver import Undecided
from sleec_verify.games import realizability
from sleec_verify.games import time_grid as grid
from sleec_verify.games.time_grid import TimeGrid
from sleec_verify.report.strategy import in_words
from sleec_verify.results.finding import Proved, Refuted, Unknown
from sleec_verify.results.strategy import Strategy
from tests.support.game_brute_force import Game
from tests.support.random_games import drawn
from tests.support.studies import OWN, each_study

HEAD = "def_start\n  event A\n  event B\n  event X\n  event Y\n  measure m: boolean\n  measure n: numeric\ndef_end\n"


def _verdict(rules: str, steps: int, relations: str = "", head: str = HEAD) -> Proved | Refuted | Unknown:
    text = f"{head}rule_start\n{rules}\nrule_end\n"
    if relations:
        text += f"relation_start\n{relations}\nrelation_end\n"
    (result,) = run_checks(parse(text), names=(), realizable=steps)
    assert result.name == "realizability"
    return result.verdict


def _words(rules: str, steps: int, relations: str = "", head: str = HEAD) -> list[str]:
    verdict = _verdict(rules, steps, relations, head)
    assert isinstance(verdict, Refuted)
    (finding,) = verdict.findings
    assert finding.strategy is not None
    return list(in_words(finding.strategy))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "kind"),
    [*((n, "") for n in range(150)), *((n, "named") for n in range(60)), *((n, "lengths") for n in range(60))],
)
@pytest.mark.parametrize("steps", [1, 2])
def test_who_wins_is_what_trying_all_says(seed: int, kind: str, steps: int) -> None:
    text, lawful, measures, reach = drawn(seed, named=kind == "named", lengths=kind == "lengths")
    ruleset = parse(text)
    (result,) = run_checks(ruleset, names=(), realizable=steps)
    wins = Game(ruleset, ["A", "B"], ["X"], lawful, measures, reach).environment_wins(steps)
    if isinstance(result.verdict, Unknown):
        assert "plans of up to 4 instants" in result.verdict.why
        assert not result.findings
    else:
        assert isinstance(result.verdict, Refuted) == wins, text


def test_hardly_anything_is_unknown() -> None:
    unknown = 0
    for seed in range(150):
        (result,) = run_checks(parse(drawn(seed).text), names=(), realizable=2)
        unknown += isinstance(result.verdict, Unknown)
    assert unknown <= 3


# What is won and lost -------------------------------------------------------------------------------------


def test_rules_without_a_conflict_are_kept() -> None:
    assert _verdict("  R1 when A then X\n  R2 when B then Y", 5) == Proved()


def test_a_conflict_at_once_is_lost_with_one_act() -> None:
    rules = "  R1 when A then X\n  R2 when B then not X"
    assert _words(rules, 3) == ["at first, `A` and `B` occur", "after this, it is impossible to follow every rule"]


def test_time_to_wait_is_used() -> None:
    # The robot sounds X a little later; B occurs again, and again it has room.
    assert _verdict("  R1 when A then X within 5 minutes\n  R2 when B then not X", 2) == Proved()


def test_more_acts_find_more() -> None:
    rules = "  R1 when A then X within 10 minutes\n  R2 when B then not X within 5 minutes"
    assert _verdict(rules, 1) == Proved()
    assert _words(rules, 2) == [
        "at first, `A` and `B` occur",
        "whatever the robot does, after 5 minutes, `B` occurs",
        "after this, it is impossible to follow every rule",
    ]


def test_whose_an_event_is_counts() -> None:
    head = HEAD.replace("event X", "event X as environment")
    # Nobody makes the environment do X.
    assert isinstance(_verdict("  R1 when A then X within 5 minutes", 1, head=head), Refuted)
    assert _verdict("  R1 when A then X within 5 minutes", 1) == Proved()
    # What only triggers is the environment's, unless it is said that the robot does it: then it can leave it.
    rules = "  R1 when A then X\n  R2 when B then not X"
    assert _verdict(rules, 1, head=HEAD.replace("event B", "event B as system")) == Proved()


def test_relations_bind_the_environment() -> None:
    rules = "  R1 when A then X\n  R2 when B then not X"
    assert _verdict(rules, 3, "  mutualExclusive A B") == Proved()
    assert isinstance(_verdict(rules, 1, "  mutualExclusive A Y"), Refuted)
    hedged = "  R1 when A then X\n  R2 when B and {m} then not X"
    assert _verdict(hedged, 3, "  forbid A {m}") == Proved()
    assert _verdict(hedged, 3, "  measure imply {m} (not {m})") == Proved()


def test_relations_bind_the_robot() -> None:
    assert isinstance(_verdict("  R1 when A then X", 1, "  forbid X {m}"), Refuted)
    assert isinstance(_verdict("  R1 when A then X\n  R2 when A then Y", 1, "  mutualExclusive X Y"), Refuted)
    assert isinstance(_verdict("  R1 when A then X", 1, "  happenBefore B X"), Refuted)
    head = HEAD.replace("event Y", "event Y as system")
    assert isinstance(_verdict("  R1 when A then X", 1, "  happenBefore Y X", head), Refuted)
    assert _verdict("  R1 when A then X within 5 minutes", 1, "  happenBefore Y X", head) == Proved()


def test_relations_alone_can_be_lost() -> None:
    head = HEAD.replace("event Y", "event Y as system")
    verdict = _verdict("  R1 when A then X", 1, "  causation Y {m}\n  forbid Y ({n} > 5)", head)
    assert isinstance(verdict, Refuted)
    assert verdict.findings[0].rules == ()
    assert "the relations cannot" in verdict.findings[0].message


ADAPTIVE = (
    (
        "  R1 when A then X else Y\n  R2 when X then not Z within 5 minutes\n  R3 when Y then not W within 5 minutes\n"
        "  R4 when B then Z\n  R5 when C then W"
    ),
    2,
    "  mutualExclusive A B\n  mutualExclusive A C\n  mutualExclusive B C",
    HEAD.replace("event B\n", "event B\n  event C\n  event Z\n  event W\n"),
)


def test_the_answer_of_the_environment_may_depend_on_the_robot() -> None:
    first, *words = _words(*ADAPTIVE)
    assert first == "at first, `A` occurs"
    said = "\n".join(words)
    assert "if the robot does `X` immediately:\n  after 5 minutes, `B` occurs\n  after this, it is impossible" in said
    assert "if the robot does `Y` immediately:\n  after 5 minutes, `C` occurs\n  after this, it is impossible" in said


def test_only_some_replies_are_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(realizability, "MOST_REPLIES", 1)
    words = _words(*ADAPTIVE)
    assert sum(line.startswith("if the robot") for line in words) == 1
    assert words[-1] == "the environment can answer everything else that the robot can do, too"


def test_a_strategy_that_does_not_replay_is_not_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    found = realizability.StrategySearch.strategy

    def unlawful(self: realizability.StrategySearch) -> Strategy:
        strategy = found(self)
        return replace(strategy, act=replace(strategy.act, events=("A", "B")))

    monkeypatch.setattr(realizability.StrategySearch, "strategy", unlawful)
    verdict = _verdict(*ADAPTIVE)
    assert isinstance(verdict, Unknown)
    assert "rejected a witness" in verdict.why


def test_numbers_and_scales_are_chosen_by_the_environment() -> None:
    rules = "  R1 when A and ({n} > 5) then X\n  R2 when B and ({n} < 7) then not X"
    (first, _) = _words(rules, 1)
    assert first == "at first, `A` and `B` occur while `n` is 6"
    assert _verdict("  R1 when A and ({n} > 5) then X\n  R2 when B and ({n} < 5) then not X", 1) == Proved()


def test_other_parts_do_not_matter() -> None:
    rules = "  R1 when A then X\n  R2 when B then not X\n  R3 when A then Y\n  R4 when Y and {m} then Z"
    verdict = _verdict(rules, 1, head=HEAD.replace("event B\n", "event B\n  event Z\n"))
    assert isinstance(verdict, Refuted)
    (finding,) = verdict.findings
    assert finding.rules == ("R1", "R2")


def test_the_reading_counts() -> None:
    text = (
        HEAD + "rule_start\n  R1 when A then X unless ({m}) then Y unless ({n} > 5) then not X\n"
        "  R2 when B then X unless ({m})\nrule_end\n"
    )
    ruleset = parse(text)
    (priority,) = run_checks(ruleset, names=(), realizable=1)
    (cascade,) = run_checks(replace(ruleset, reading="cascade"), names=(), realizable=1)
    assert isinstance(priority.verdict, Refuted)
    assert cascade.verdict == Proved()


def test_structured_english_is_asked_too() -> None:
    text = "WHEN Fire THEN SoundAlarm\nWHEN Night THEN NOT SoundAlarm\n"
    (result,) = run_checks(parse(text), names=(), realizable=2)
    assert isinstance(result.verdict, Refuted)
    (result,) = run_checks(parse(text + "ASSUME NOT (Fire AND Night)\n"), names=(), realizable=2)
    assert result.verdict == Proved()


# What is unknown ------------------------------------------------------------------------------------------


def test_a_window_that_a_measure_sets_is_unknown() -> None:
    verdict = _verdict("  R1 when A then X within {n} minutes\n  R2 when B then not X", 1)
    assert isinstance(verdict, Unknown)
    assert "n minutes" in verdict.why


def test_a_comparison_of_two_measures_is_unknown() -> None:
    head = HEAD.replace("  measure n", "  measure k: numeric\n  measure n")
    verdict = _verdict("  R1 when A then X\n  R2 when B and ({k} < {n}) then not X", 1, head=head)
    assert isinstance(verdict, Unknown)
    assert verdict.why.startswith("`R1`, `R2`: ")


def test_too_many_times_are_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(grid, "MOST_SLOTS", 4)
    with pytest.raises(Undecided, match="distinct times"):
        TimeGrid([7, 300], 4, 4)


def test_more_plans_than_are_tried_are_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(realizability, "MOST_PLANNED", 0)
    verdict = _verdict("  R1 when A then X within 5 minutes\n  R2 when B then not X", 1)
    assert isinstance(verdict, Unknown)
    assert "plans of up to 0 instants" in verdict.why


# Times ----------------------------------------------------------------------------------------------------


def test_a_grid_has_sums_of_lengths() -> None:
    times = TimeGrid([1, 300], 3, 2).times
    assert {0, 1, 2, 299, 300, 301, 302, 600}.issubset(times)
    assert 150 not in times


def test_a_grid_has_room_between_units() -> None:
    times = TimeGrid([300], 2, 1).times
    assert [time for time in times if time <= 300] == [0, 75, 150, 225, 300]


def test_without_lengths_only_the_order_counts() -> None:
    assert TimeGrid([], 3, 1).times == [0, 1, 2]


# The studies ----------------------------------------------------------------------------------------------


@each_study
def test_the_studies_are_decided_for_two_acts(path: Path) -> None:
    (result,) = run_checks(load(path), names=(), realizable=2)
    assert not isinstance(result.verdict, Unknown)


def test_the_studies_that_two_acts_defeat() -> None:
    defeated = {path.stem for path in OWN.glob("*.sleec") if run_checks(load(path), names=(), realizable=2)[0].findings}
    # A prudent lifeguard calls at once, and meets the deadline before the bather who waves can forbid it.
    assert defeated == {
        "dairy-farm",
        "greenhouse",
        "library-porter",
        "lone-companion",
        "luggage-robot",
        "museum-guide",
        "packing-cobot-revised",
        "parcel-drone",
        "parcel-drone-revised",
    }
