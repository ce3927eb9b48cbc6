"""`check --fix` applies repairs, and changes nothing else of a file."""

from __future__ import annotations

import io
import os
import stat
from pathlib import Path

import pytest

from sleec_verify.repairs.search import RepairSearch
from sleec_verify.repairs.verification import Rejected
from tests.support.cli import Cli
from tests.support.fixes import CONFLICT, DEAD, SHORTER, TWO, identifiers


def test_the_numbered_repair_is_applied_and_the_rest_is_checked_again(cli: Cli, tmp_path: Path) -> None:
    (name,) = identifiers(cli, SHORTER, CONFLICT)
    ran = cli("check", "--fix", name, "a.sleec")
    assert ran.code == 0
    assert ran.err == f"a.sleec: fixed: {SHORTER}\n"
    assert ran.out.endswith("checks passed (reading cascade; 2 rules, 1 exception)\n")
    assert (tmp_path / "a.sleec").read_text() == CONFLICT.replace("OpenCurtains AND OpenWindow", "OpenWindow")


def test_several_repairs_at_once(cli: Cli) -> None:
    names = [*identifiers(cli, SHORTER, TWO), identifiers(cli, "remove rule `call`", TWO)[0]]
    ran = cli("check", "--fix", names[0], "--fix", names[1], "a.sleec", files={"a.sleec": TWO})
    assert ran.code == 0
    assert ran.err == f"a.sleec: fixed: {SHORTER}; remove rule `call`\n"


def test_fix_alone_applies_what_changes_no_meaning(cli: Cli, tmp_path: Path) -> None:
    text = f"{TWO}{DEAD}UNLESS Rain IN WHICH CASE Speak\n"
    ran = cli("check", "--fix", "a.sleec", files={"a.sleec": text})
    assert ran.code == 1
    assert "SLEEC101" in ran.out
    assert "SLEEC202" not in ran.out
    assert (tmp_path / "a.sleec").read_text() == TWO
    assert len(ran.err.splitlines()) == 2


FALL = "WHEN the user falls THEN call the nurse"
HIDDEN = f"""\
READING cascade
RULE help
{FALL}
UNLESS asleep IN WHICH CASE wake the user
UNLESS NOT asleep IN WHICH CASE call the nurse AND play an alarm
"""


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        (
            HIDDEN,
            [
                (
                    "not fixed: the exception `UNLESS NOT asleep` of rule `help` never applies because of the "
                    "exception `UNLESS asleep`; the exception "
                    "`UNLESS asleep` hides it; --fix SLEEC202:1 would remove the exception `UNLESS NOT asleep` of rule "
                    "`help`"
                )
            ],
        ),
        (
            f"ASSUME NOT (the user falls AND asleep)\nRULE help\n{FALL}\nUNLESS asleep IN WHICH CASE wake the user\n",
            [
                (
                    "not fixed: the exception `UNLESS asleep` of rule `help` never applies because of the "
                    "ASSUME in line 1; "
                    "`ASSUME NOT (the user falls AND asleep)` hides it; --fix SLEEC202:1 would remove the exception "
                    "`UNLESS asleep` of rule `help`"
                )
            ],
        ),
        (
            f"RULE help\n{FALL}\nRULE alone\n{FALL.replace('falls', 'falls AND alone')}\n",
            [
                (
                    "not fixed: rule `alone` can be removed: every situation requires the same without it; "
                    "`help` requires the same; --fix SLEEC301:1 would remove rule `alone`"
                )
            ],
        ),
    ],
)
def test_what_asks_for_something_is_never_removed_alone(text: str, lines: list[str], cli: Cli, tmp_path: Path) -> None:
    ran = cli("check", "--fix", "a.sleec", files={"a.sleec": text})
    assert (tmp_path / "a.sleec").read_text() == text
    assert ran.err.splitlines() == ["a.sleec: nothing to fix without a decision", *(f"a.sleec: {one}" for one in lines)]
    applied = cli("check", "--fix", lines[0].partition("--fix ")[2].split()[0], "a.sleec")
    assert applied.code == 0
    assert "never applies" not in applied.out


def test_equal_rules_are_offered_one_by_one(cli: Cli, tmp_path: Path) -> None:
    text = "RULE a\nWHEN Bell THEN Speak\nRULE b\nWHEN Bell AND Storm THEN Speak\nRULE c\nWHEN Bell THEN Speak\n"
    ran = cli("check", "--fix", "a.sleec", files={"a.sleec": text})
    assert (tmp_path / "a.sleec").read_text() == text
    assert {line.partition("would ")[2] for line in ran.err.splitlines()[1:]} == {
        "remove rule `a`",
        "remove rule `b`",
        "remove rule `c`",
    }


def test_fix_alone_stops_when_nothing_is_left(cli: Cli, tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    ran = cli("check", "--fix", "a.sleec", files={"a.sleec": CONFLICT})
    assert ran.err == "a.sleec: nothing to fix without a decision\n"
    assert ran.code == 1
    assert path.read_text() == CONFLICT


def test_fix_changes_several_files(cli: Cli, tmp_path: Path) -> None:
    files = {"a.sleec": CONFLICT + DEAD, "b.sleec": "WHEN", "c.sleec": CONFLICT + DEAD}
    ran = cli("check", "--fix", ".", files=files)
    assert ran.code == 2
    assert (tmp_path / "a.sleec").read_text() == (tmp_path / "c.sleec").read_text() == CONFLICT
    assert (tmp_path / "b.sleec").read_text() == "WHEN"


@pytest.mark.parametrize("value", ["1", "SLEEC301-1", "folder/"])
def test_a_path_that_cannot_be_read_stops_everything(value: str, cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    ran = cli("check", "--fix", value, "a.sleec", files={"a.sleec": CONFLICT + DEAD})
    assert ran.code == 2
    assert "nothing was written; a value of --fix is a code and a number" in ran.err
    assert ran.out == ""
    assert (tmp_path / "a.sleec").read_text() == CONFLICT + DEAD


def test_a_file_with_two_paths_is_fixed_once(cli: Cli, tmp_path: Path) -> None:
    ran = cli("check", "--fix", "a.sleec", "./a.sleec", str(tmp_path / "a.sleec"), files={"a.sleec": CONFLICT + DEAD})
    assert "was changed since" not in ran.err
    assert ran.code == 1
    assert (tmp_path / "a.sleec").read_text() == CONFLICT


EVERYWHERE = """\
RULE everywhere
WHEN the user falls AND the user is alone THEN call the nurse
DOMAIN hospital
RULE ward
WHEN the user falls THEN call the nurse
DOMAIN home
RULE rest
WHEN the user sleeps THEN be quiet
"""


@pytest.mark.parametrize("option", ["--domain hospital", "--reading priority", "--no-chains"])
def test_fix_alone_keeps_the_meaning_of_the_whole_file(option: str, cli: Cli, tmp_path: Path) -> None:
    ran = cli("check", "--fix", *option.split(), "a.sleec", files={"a.sleec": EVERYWHERE})
    assert ran.code == 2
    name = option.split()[0]
    assert f"--fix without a value keeps the meaning of the whole file, so it cannot be combined with {name}" in ran.err
    assert (tmp_path / "a.sleec").read_text() == EVERYWHERE


@pytest.mark.parametrize("option", ["--domain ward", "--reading cascade"])
def test_an_option_that_changes_no_meaning_goes_with_fix(option: str, cli: Cli, tmp_path: Path) -> None:
    assert cli("check", "--fix", *option.split(), "a.sleec", files={"a.sleec": CONFLICT + DEAD}).code == 1
    assert (tmp_path / "a.sleec").read_text() == CONFLICT


ALLOWED = "// sleec: allow {} because lawyers want it twice"
TWICE = "RULE a\nWHEN Bell THEN Speak\n{}RULE b\nWHEN Bell THEN Speak{}\n"


@pytest.mark.parametrize("code", ["SLEEC509", "duplicate-rule"])
@pytest.mark.parametrize("behind", [True, False])
def test_fix_alone_keeps_what_a_comment_allows(behind: bool, code: str, cli: Cli, tmp_path: Path) -> None:
    comment = ALLOWED.format(code)
    text = TWICE.format("", f" {comment}") if behind else TWICE.format(f"{comment}\n", "")
    ran = cli("check", "--fix", "a.sleec", files={"a.sleec": text})
    assert ran.err == "a.sleec: nothing to fix without a decision\n"
    assert (tmp_path / "a.sleec").read_text() == text


def test_fix_alone_removes_no_comment_that_allows_a_finding(cli: Cli, tmp_path: Path) -> None:
    text = "WHEN it rings THEN take photos // {}\nWHEN it rings THEN take photo // {}\nWHEN it snows THEN take photo\n"
    merged = text.format("one", "two")
    cli("check", "--fix", "a.sleec", files={"a.sleec": merged})
    assert (tmp_path / "a.sleec").read_text().count("WHEN it rings") == 1
    allowed = text.format(*[ALLOWED.format("SLEEC509").removeprefix("// ")] * 2)
    cli("check", "--fix", "a.sleec", files={"a.sleec": allowed})
    assert (tmp_path / "a.sleec").read_text() == allowed


def test_fix_alone_keeps_declarations_beside_a_misread_name(cli: Cli, tmp_path: Path) -> None:
    text = (
        "MEASURE age: number // from the id card\nCONDITION polite\nWHEN the user comes THEN greet\n"
        "UNLESS age is under 6 years IN WHICH CASE wave\n"
    )
    cli("check", "--fix", "a.sleec", files={"a.sleec": text})
    assert (tmp_path / "a.sleec").read_text() == text


def test_diff_shows_and_writes_nothing(cli: Cli, tmp_path: Path) -> None:
    ran = cli("check", "--fix", "--diff", "a.sleec", files={"a.sleec": CONFLICT + DEAD})
    assert ran.code == 1
    assert ran.out.endswith(f"-{DEAD}")
    assert (tmp_path / "a.sleec").read_text() == CONFLICT + DEAD
    assert cli("check", "--fix", "--diff", "b.sleec", files={"b.sleec": CONFLICT}).code == 0


def test_a_link_stays_and_rights_stay(cli: Cli, tmp_path: Path) -> None:
    target = tmp_path / "there" / "a.sleec"
    target.parent.mkdir()
    target.write_text(CONFLICT + DEAD)
    target.chmod(0o640)
    (tmp_path / "link.sleec").symlink_to(target)
    cli("check", "--fix", "link.sleec")
    assert (tmp_path / "link.sleec").is_symlink()
    assert target.read_text() == CONFLICT
    assert stat.S_IMODE(target.stat().st_mode) == 0o640
    assert os.listdir(target.parent) == ["a.sleec"]


def test_numbers_under_a_timeout_are_certain(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def times_out(*_: object) -> None:
        raise Rejected("the timeout has passed", undecided=True)

    monkeypatch.setattr("sleec_verify.repairs.verification.Verification.repaired", times_out)
    ran = cli("check", "--timeout", "100", "--fix", "SLEEC101:1", "a.sleec", files={"a.sleec": CONFLICT})
    assert ran.code == 2
    assert "the repairs for SLEEC101 are not complete: the timeout has passed" in ran.err
    assert (tmp_path / "a.sleec").read_text() == CONFLICT


def test_standard_input_is_only_shown(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO((CONFLICT + DEAD).encode())))
    assert "standard input cannot be changed in place; add --diff" in cli("check", "--fix", "-").err
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO((CONFLICT + DEAD).encode())))
    assert cli("check", "--fix", "--diff", "-").out.endswith(f"-{DEAD}")


REFUSED = [
    (("--fix", "SLEEC101:99"), "there is no repair SLEEC101:99: a.sleec has "),
    (("--fix", "SLEEC301:1"), "a.sleec has no finding with the code SLEEC301"),
    (("--fix", "SLEEC999:1"), "no finding has the code SLEEC999"),
    (("--fix", "SLEEC504:1"), "there is no repair SLEEC504:1: a.sleec has no repairs for SLEEC504"),
    (("--fix", "SLEEC101"), "--fix SLEEC101: write the code and the number of a repair, such as SLEEC101:1"),
    (("--fix", "SLEEC101:0"), "--fix SLEEC101:0: write the code"),
    (("--fix=3",), "--fix 3: write the code"),
    (("--fix", "SLEEC101:1", "--fix", "SLEEC101:2"), "SLEEC101:1 and SLEEC101:2 repair the same finding"),
    (("--fix", "--fix", "SLEEC101:1"), "--fix without a value cannot be combined with --fix CODE:N"),
    (("--fix", "--watch"), "--fix cannot be combined with --watch"),
    (("--fix", "--certify", "folder"), "--fix cannot be combined with --certify"),
    (("--fix", "--diff", "-o", "file"), "--fix cannot be combined with --diff -o"),
    (("--fix", "--diff", "--format", "json"), "--fix cannot be combined with --diff --format"),
    (("--diff",), "--diff needs --fix"),
    (("--fix", "SLEEC101:1", "b.sleec"), "--fix CODE:N needs exactly one file"),
]


@pytest.mark.parametrize(
    ("options", "message"), REFUSED, ids=lambda one: " ".join(one) if isinstance(one, tuple) else ""
)
def test_what_is_refused_writes_nothing(options: tuple[str, ...], message: str, cli: Cli, tmp_path: Path) -> None:
    text = f"{CONFLICT}RULE first\nWHEN Bell THEN Ring\nRULE second\nWHEN Ring THEN Speak\n"
    ran = cli("check", *options, "a.sleec", files={"a.sleec": text, "b.sleec": text})
    assert ran.code == 2
    assert message in ran.err
    assert "Traceback" not in ran.err
    assert ran.out == ""
    assert (tmp_path / "a.sleec").read_text() == (tmp_path / "b.sleec").read_text() == text
    assert sorted(os.listdir(tmp_path)) == ["a.sleec", "b.sleec"]


def test_repairs_of_the_same_text_overlap(cli: Cli, tmp_path: Path) -> None:
    text = "RULE a\nWHEN Bell THEN Speak\nRULE b\nWHEN Bell THEN NOT Speak AND Wave\nRULE c\nWHEN Bell THEN NOT Wave\n"
    names = [name for name in identifiers(cli, "remove rule `b`", text) if name.startswith("SLEEC101:")]
    assert len(names) == 2
    ran = cli("check", "--fix", names[0], "--fix", names[1], "a.sleec")
    assert ran.code == 2
    assert f"{names[0]} and {names[1]} change the same part of the text" in ran.err
    assert (tmp_path / "a.sleec").read_text() == text


@pytest.mark.parametrize(
    ("rest", "why"),
    [("", "are not a repair"), ("RULE c\nWHEN Bell THEN Wave\n", "change the meaning, which each of them keeps")],
)
def test_repairs_that_do_not_go_together(rest: str, why: str, cli: Cli, tmp_path: Path) -> None:
    text = f"RULE a\nWHEN Bell THEN Speak\nRULE b\nWHEN Bell THEN Speak\n{rest}"
    (one,), (other,) = (identifiers(cli, f"remove rule `{label}`", text)[:1] for label in "ab")
    ran = cli("check", "--fix", one, "--fix", other, "a.sleec")
    assert ran.code == 2
    assert f"together, {one} and {other} {why}" in ran.err
    assert (tmp_path / "a.sleec").read_text() == text


def test_a_file_that_changes_meanwhile_is_kept(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.sleec"
    search = RepairSearch.repairs

    def meanwhile(*arguments: object) -> object:
        path.write_text("// mine\n" + CONFLICT)
        return search(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(RepairSearch, "repairs", meanwhile)
    ran = cli("check", "--fix", "SLEEC101:1", "a.sleec", files={"a.sleec": CONFLICT})
    assert ran.code == 2
    assert "a.sleec was changed since the check" in ran.err
    assert path.read_text() == "// mine\n" + CONFLICT


def test_a_file_that_vanishes_meanwhile(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    search = RepairSearch.repairs

    def meanwhile(*arguments: object) -> object:
        (tmp_path / "a.sleec").unlink()
        return search(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(RepairSearch, "repairs", meanwhile)
    ran = cli("check", "--fix", "SLEEC101:1", "a.sleec", files={"a.sleec": CONFLICT})
    assert ran.code == 2
    assert "a.sleec cannot be read: No such file or directory" in ran.err
    assert os.listdir(tmp_path) == []


def test_a_read_only_file_is_kept(cli: Cli, tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_text(CONFLICT)
    path.chmod(0o444)
    ran = cli("check", "--fix", "SLEEC101:1", "a.sleec")
    assert ran.code == 2
    assert "a.sleec is read-only" in ran.err
    assert path.read_text() == CONFLICT


def test_a_failing_write_keeps_the_file(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("os.replace", fail)
    ran = cli("check", "--fix", "SLEEC101:1", "a.sleec", files={"a.sleec": CONFLICT})
    assert ran.code == 2
    assert "a.sleec cannot be written: Permission denied" in ran.err
    assert os.listdir(tmp_path) == ["a.sleec"]


def test_a_file_that_is_not_a_ruleset(cli: Cli, tmp_path: Path) -> None:
    ran = cli("check", "--fix", "SLEEC101:1", "a.sleec", files={"a.sleec": "WHEN"})
    assert ran.code == 2
    assert "a.sleec:1:5" in ran.err
    assert (tmp_path / "a.sleec").read_text() == "WHEN"


@pytest.mark.parametrize("words", [("--fix", "a.sleec"), ("a.sleec", "--fix"), ("--fix", "--", "a.sleec")])
def test_a_path_may_follow_fix(words: tuple[str, ...], cli: Cli, tmp_path: Path) -> None:
    assert cli("check", *words, files={"a.sleec": CONFLICT + DEAD}).code == 1
    assert (tmp_path / "a.sleec").read_text() == CONFLICT
