"""`resolve` asks for each conflict, applies the choice, and records it as a comment."""

from __future__ import annotations

import os
import re
from datetime import date
from pathlib import Path

import pytest

from sleec_runtime.language import load
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Proved
from tests.support.cli import Cli
from tests.support.fixes import TWO
from tests.support.resolve import Answer, left

TODAY = f"// decision {date.today().isoformat()}: "


def number_of(title: str, output: str) -> str:
    """The number of the choice with this title, in the last list."""
    numbers: list[str] = re.findall(rf"^ *(\d+)  {re.escape(title)}$", output, re.MULTILINE)
    return numbers[-1]


AIR = "add to the trigger of rule `air`: `AND NOT UserUndressed`"
QUIET = "add to the trigger of rule `quiet`: `AND NOT Storm`"


def test_each_conflict_is_resolved_and_recorded(answer: Answer, tmp_path: Path) -> None:
    first = number_of(AIR, answer("quit").output)
    second = number_of(QUIET, answer(first, "", "quit").output)
    ran = answer(first, "privacy first", second, "", "")
    assert ran.return_value == 0
    assert "a.sleec: 2 conflicts\n" in ran.output
    assert "a.sleec: 1 conflict\n" in ran.output
    assert "a.sleec: no conflicts\n" in ran.output
    expected = TWO.replace("RULE air", f"{TODAY}`air` gives way to `privacy`: privacy first\nRULE air")
    expected = expected.replace("RULE quiet", f"{TODAY}`quiet` gives way to `call`\nRULE quiet")
    expected = expected.replace("AND RoomStuffy", "AND RoomStuffy AND NOT UserUndressed")
    assert left(tmp_path) == expected.replace("WHEN Bell THEN", "WHEN Bell AND NOT Storm THEN")
    (conflict,) = run_checks(load(tmp_path / "a.sleec"), ["conflict"])
    assert conflict.verdict == Proved()


def test_the_situation_and_the_effects_are_shown(answer: Answer) -> None:
    shown = answer("quit").output
    assert "situation: When `CurtainsRequested` occurs, `RoomStuffy` is true and `UserUndressed` is true" in shown
    effect = (
        "rule `air`, in 1 of 4 situations in which `CurtainsRequested` occurs: `OpenCurtains` and `OpenWindow` are no "
        "longer required; "
        "in the situation of the conflict, the rules then require `NOT OpenCurtains`; nothing else changes"
    )
    assert f"  {AIR}\n     {effect}\n" in shown


def test_skip_goes_to_the_next_conflict(answer: Answer, tmp_path: Path) -> None:
    ran = answer("s", "skip", "")
    assert ran.return_value == 1
    assert ran.output.count("error[SLEEC101]") == 2
    assert "a.sleec: 2 conflicts, 1 skipped\n" in ran.output
    assert left(tmp_path) == TWO


def test_undo_restores_the_file_and_what_was_skipped(answer: Answer, tmp_path: Path) -> None:
    ran = answer("1", "", "1", "", "undo", "undo", "skip", "u", "q")
    assert ran.return_value == 1
    assert ran.output.count("the last choice is undone") == 2
    assert left(tmp_path) == TWO


def test_nothing_to_undo_is_not_offered(answer: Answer) -> None:
    assert "`undo` is not a choice; type one of: 1 to " in answer("undo", "q").output


@pytest.mark.parametrize("typed", ["0", "99", "x", "", "-1", "1 2", "s" * 100, "\x1b[2J", "१"])
def test_anything_else_is_asked_again(typed: str, answer: Answer, tmp_path: Path) -> None:
    ran = answer(typed, "q")
    assert "type one of: 1 to " in ran.output
    assert "\x1b" not in ran.output
    assert left(tmp_path) == TWO


@pytest.mark.parametrize("lines", [(), ("1",), ("1", "", "1")])
def test_the_end_of_input_keeps_the_last_choice(lines: tuple[str, ...], answer: Answer, tmp_path: Path) -> None:
    ran = answer(*lines)
    assert ran.exception is None
    assert ran.return_value == 1
    assert left(tmp_path).count("// decision ") == len(lines) // 2


def test_nothing_is_asked_without_conflicts(answer: Answer, tmp_path: Path) -> None:
    ran = answer(text="WHEN Bell THEN Speak\n")
    assert ran.return_value == 0
    assert ran.output == "a.sleec: no conflicts\n"


def test_a_reason_is_one_line_of_text(answer: Answer, tmp_path: Path) -> None:
    answer("1", "  Würde \x1b[31m zuerst\x07\tund\u2028 immer ", "q")
    assert ": Würde [31m zuerst und immer\n" in left(tmp_path)


def test_rules_without_labels_are_named_by_their_triggers(answer: Answer, tmp_path: Path) -> None:
    answer("1", "", "q", text="WHEN Bell THEN Speak\nWHEN Bell AND Late THEN NOT Speak\n")
    assert left(tmp_path).startswith(f"{TODAY}`WHEN Bell` gives way to `WHEN Bell AND Late`\n")


def test_a_change_by_somebody_else_is_kept(answer: Answer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.sleec"
    asked: list[str] = []

    def type_while_editing(question: str) -> str:
        asked.append(question)
        if question.startswith("Why"):
            path.write_text(f"// mine\n{TWO}")
        return "1" if len(asked) < 3 else "q"

    monkeypatch.setattr("builtins.input", type_while_editing)
    ran = answer()
    assert "a.sleec was changed since the check" in ran.output
    assert path.read_text() == f"// mine\n{TWO}"


def test_a_read_only_file_is_refused_at_once(answer: Answer, cli: Cli, tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_text(TWO)
    path.chmod(0o444)
    ran = cli("resolve", "a.sleec")
    assert (ran.code, ran.out) == (2, "")
    assert "a.sleec is read-only" in ran.err


def test_the_plan_without_a_terminal(cli: Cli, tmp_path: Path) -> None:
    ran = cli("resolve", "a.sleec", files={"a.sleec": TWO})
    assert ran.code == 1
    assert ran.out.endswith("\na.sleec: 2 conflicts\n")
    proposals = re.findall(r"^proposal: sleec-verify (check --fix SLEEC101:\d+ a.sleec)$", ran.out, re.MULTILINE)
    assert len(proposals) == 2
    assert left(tmp_path) == TWO
    for proposal in proposals:
        assert cli(*proposal.split(), files={"a.sleec": TWO}).out.count("error[SLEEC101]") == 1


def test_bad_input(cli: Cli, tmp_path: Path) -> None:
    assert "file no.sleec does not exist" in cli("resolve", "no.sleec").err
    ran = cli("resolve", "a.sleec", files={"a.sleec": "WHEN"})
    assert ran.code == 2
    assert "a.sleec:1:5" in ran.err
    assert os.listdir(tmp_path) == ["a.sleec"]
