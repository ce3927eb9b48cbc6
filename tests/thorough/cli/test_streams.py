"""Standard input, folders, terminals, closed pipes, interruptions, and failures that nobody expected."""

from __future__ import annotations

import io
import os
import pty
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from sleec_verify.cli import main
from sleec_verify.encoding.solver import Undecided
from tests.support.cli import Cli

RULES = "WHEN Rung THEN OpenDoor\nUNLESS Night IN WHICH CASE AskWho\n"
CLASH = RULES + "WHEN Storm THEN NOT OpenDoor\n"
COMMAND = [sys.executable, "-m", "sleec_verify"]


def test_standard_input(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(CLASH.encode())))
    ran = cli("check", "-", "--format", "concise")
    assert ran.out.startswith("<stdin>:1:1: error[SLEEC101]")
    assert ran.code == 1


def test_broken_standard_input(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(b"\xff\xfeW")))
    ran = cli("check", "-", "--format", "json")
    assert ran.code == 2
    assert '"path": "<stdin>"' in ran.out


def test_folder_is_every_file_below_it_sorted(cli: Cli) -> None:
    files = {"b.sleec": RULES, "a/z.sleec": RULES, "a/a.sleec": RULES, "a/notes.txt": "not rules"}
    ran = cli("check", ".", "b.sleec", "./b.sleec", files=files)
    paths = [line.split(":")[0] for line in ran.out.splitlines()]
    assert paths == ["./a/a.sleec", "./a/z.sleec", "./b.sleec", "b.sleec", "4 rulesets"]


def test_each_file_comes_once(cli: Cli) -> None:
    ran = cli("check", "a.sleec", "a.sleec", files={"a.sleec": RULES})
    assert len(ran.out.splitlines()) == 1


def on_terminal(arguments: list[str], **environment: str) -> str:
    """What a program writes to a terminal."""
    leader, follower = pty.openpty()
    env = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")}
    process = subprocess.Popen(
        [*COMMAND, *arguments], stdout=follower, stderr=follower, stdin=follower, env={**env, **environment}
    )
    os.close(follower)
    shown = b""
    try:
        while data := os.read(leader, 4096):
            shown += data
    except OSError:  # Linux ends a terminal without writers so
        pass
    process.wait()
    os.close(leader)
    return shown.decode()


@pytest.fixture
def clash(tmp_path: Path) -> str:
    path = tmp_path / "clash.sleec"
    path.write_text(CLASH)
    return str(path)


def test_colours_on_a_terminal(clash: str) -> None:
    assert "\033[1;31merror[SLEEC101]\033[0m" in on_terminal(["check", clash], TERM="xterm")


@pytest.mark.parametrize("environment", [{"NO_COLOR": "1", "TERM": "xterm"}, {"TERM": "dumb"}])
def test_no_colours_where_they_are_not_wanted(clash: str, environment: dict[str, str]) -> None:
    shown = on_terminal(["check", clash], **environment)
    assert "error[SLEEC101]" in shown
    assert "\033" not in shown


def test_no_colours_in_a_file(clash: str) -> None:
    done = subprocess.run(
        [*COMMAND, "check", clash], capture_output=True, text=True, env={**os.environ, "TERM": "xterm"}
    )
    assert "error[SLEEC101]" in done.stdout
    assert "\033" not in done.stdout
    assert done.returncode == 1


@pytest.mark.parametrize(("environment", "coloured"), [({}, True), ({"NO_COLOR": "1"}, False)])
def test_colours_are_forced_into_a_file(clash: str, environment: dict[str, str], coloured: bool) -> None:
    env = {name: value for name, value in os.environ.items() if name != "NO_COLOR"} | {
        "FORCE_COLOR": "1",
        "TERM": "xterm",
    }
    done = subprocess.run(
        [*COMMAND, "check", clash], capture_output=True, text=True, check=False, env={**env, **environment}
    )
    assert ("\033[1;31merror[SLEEC101]" in done.stdout) == coloured


def test_closed_pipe_is_no_failure(tmp_path: Path) -> None:
    many = tmp_path / "many.sleec"
    many.write_text("".join(f"OBLIGATION o{i}\n" for i in range(20_000)) + "WHEN t THEN o1\n")
    process = subprocess.Popen([*COMMAND, "fmt", str(many)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.readline()
    process.stdout.close()
    assert process.stderr.read() == ""
    process.stderr.close()
    process.wait()


def test_stream_that_cannot_say_a_character(tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_text("WHEN Grün THEN Öffnen\nWHEN Grün THEN NOT Öffnen\n", encoding="utf-8")
    env = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run([*COMMAND, "check", str(path)], capture_output=True, text=True, env=env)
    assert done.returncode == 1
    assert "\\xd6ffnen" in done.stdout


def test_interruption_shows_no_traceback(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("sleec_verify.checks.run_checks", interrupt)
    ran = cli("check", "a.sleec", files={"a.sleec": RULES})
    assert (ran.code, ran.out, ran.err.strip()) == (130, "", "")


@pytest.fixture
def failing(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError("the mistake")

    monkeypatch.setattr("sleec_verify.checks.run_checks", fail)


@pytest.mark.usefixtures("failing")
def test_unexpected_failure_asks_for_a_report(cli: Cli) -> None:
    ran = cli("check", "a.sleec", files={"a.sleec": RULES})
    assert ran.code == 2
    assert "ZeroDivisionError: the mistake" in ran.err
    assert "report it with" in ran.err
    assert "Traceback" not in ran.err


@pytest.mark.usefixtures("failing")
def test_traceback_on_demand(cli: Cli) -> None:
    ran = cli("--traceback", "check", "a.sleec", files={"a.sleec": RULES})
    assert ran.code == 2
    assert "Traceback" in ran.err


def test_main_exits_with_the_code(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    codes: list[int] = []
    monkeypatch.setattr("os._exit", codes.append)
    monkeypatch.setattr("gc.set_threshold", lambda *_: None)
    monkeypatch.setattr("sys.argv", ["sleec-verify", "rules", "SLEEC000"])
    main()
    assert codes == [2]
    assert "no finding code" in capsys.readouterr().err


def test_interruption_before_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(_: object) -> None:
        raise KeyboardInterrupt

    codes: list[int] = []
    monkeypatch.setattr("os._exit", codes.append)
    monkeypatch.setattr("gc.set_threshold", lambda *_: None)
    monkeypatch.setattr("sleec_verify.cli.run", interrupt)
    main()
    assert codes == [130]


def test_question_that_was_given_up_is_unknown(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    def give_up(*_: object, **__: object) -> None:
        raise Undecided("too entangled to say")

    monkeypatch.setattr("sleec_verify.entailment.explanation.entail", give_up)
    ran = cli("entail", "a.sleec", files={"a.sleec": RULES})
    assert ran == (3, "", "error: too entangled to say\n")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_full_disk_is_told(clash: str) -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run([*COMMAND, "check", clash], stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 2
    assert done.stderr == "the output cannot be written: No space left on device\n"


def test_closed_pipe_has_its_own_code(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    def closed(*_: object, **__: object) -> None:
        raise BrokenPipeError

    monkeypatch.setattr("sleec_verify.checks.run_checks", closed)
    assert cli("check", "a.sleec", files={"a.sleec": RULES}) == (141, "", "")


def test_progress_bar_on_a_terminal(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.cli.progress.PATIENCE", 0)
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    assert cli("check", "a.sleec", files={"a.sleec": RULES}).code == 0
    assert "a.sleec: " in terminal.getvalue()


def test_no_progress_bar_for_what_is_quick(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    assert cli("check", "a.sleec", files={"a.sleec": RULES}).code == 0
    assert terminal.getvalue() == ""


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(
    "arguments", [["rules"], ["fmt", "FILE"], ["check", "FILE"], ["--help"], ["check", "--help"], ["--version"]]
)
def test_pipe_closed_from_the_start_is_no_finding(arguments: list[str], clash: str) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    command = [*COMMAND, *(clash if word == "FILE" else word for word in arguments)]
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True)
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, "")


@pytest.mark.parametrize("arguments", [["check", "nowhere"], ["check", "--nonsense"], ["nonsense"]])
def test_closed_pipe_for_messages(arguments: list[str]) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run([*COMMAND, *arguments], stdout=subprocess.PIPE, stderr=writer)
    os.close(writer)
    assert (done.returncode, done.stdout) == (141, b"")


@pytest.mark.skipif(os.name == "nt", reason="needs a POSIX shell")
@pytest.mark.parametrize(
    ("line", "said"),
    [
        (
            "check - <&-",
            "error: standard input is closed\n  = help: give a file, or redirect one to standard input\n",
        ),
        (
            "fmt - <&-",
            "error: standard input is closed\n  = help: give a file, or redirect one to standard input\n",
        ),
        ("check - 0>/dev/null", "error: standard input cannot be read: Bad file descriptor\n"),
        ("check FILE >&-", "error: standard output is closed\n"),
        ("--help >&-", "error: standard output is closed\n"),
        ("fmt --write FILE 2>&-", "error: standard error is closed\n"),
        ("check nowhere 2>&-", "error: standard error is closed\n"),
        ("check FILE >&- 2>&-", ""),
    ],
)
def test_closed_streams_are_told(line: str, said: str, clash: str) -> None:
    script = f"{shlex.join(COMMAND)} {line.replace('FILE', shlex.quote(clash))}"
    done = subprocess.run(["sh", "-c", script], capture_output=True, text=True, cwd=os.path.dirname(clash))
    told = done.stderr if "2>&-" not in line else done.stdout
    assert done.returncode == 2
    assert said in told
    assert "fault in sleec-verify" not in done.stderr + done.stdout
    if not said:
        assert told == ""


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
@pytest.mark.parametrize("words", [["check", "nowhere"], ["check", "--nonsense"], ["check", "FILE"], ["--help"]])
def test_full_disk_under_both_streams_is_no_finding(words: list[str], clash: str) -> None:
    command = [*COMMAND, *(clash if word == "FILE" else word for word in words)]
    with open("/dev/full", "w") as full:
        assert subprocess.run(command, stdout=full, stderr=full).returncode == 2


UMLAUTS = "WHEN Grün THEN Türe\nUNLESS Öl IN WHICH CASE Über\n"
ASCII = {"LC_ALL": "C", "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["fmt"], UMLAUTS),
        (["fmt", "--diff"], "+WHEN Grün THEN Türe\n"),
        (["compile", "--to", "cnf"], "Türe"),
        (["compile", "--to", "dimacs"], "Türe"),
        (["compile", "--to", "smtlib"], "Türe"),
        (["compile", "--to", "sympy"], "Türe"),
        (["cases"], '"Türe"'),
    ],
)
@pytest.mark.parametrize("locale", [ASCII, {"PYTHONIOENCODING": "latin-1"}, {"PYTHONIOENCODING": "utf-16"}])
def test_data_is_utf8_in_every_locale(arguments: list[str], says: str, locale: dict[str, str], tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_text(UMLAUTS.replace("WHEN ", "WHEN  ") if "--diff" in arguments else UMLAUTS, encoding="utf-8")
    done = subprocess.run([*COMMAND, *arguments, str(path)], capture_output=True, env={**os.environ, **locale})
    assert says in done.stdout.decode("utf-8")
    if arguments == ["fmt"]:
        assert done.stdout == UMLAUTS.encode()


def test_shell_completion(clash: str) -> None:
    env = {**os.environ, "_SLEEC_VERIFY_COMPLETE": "bash_complete", "COMP_WORDS": "sleec-verify che", "COMP_CWORD": "1"}
    done = subprocess.run(COMMAND, capture_output=True, text=True, env=env)
    assert done.stdout == "plain,check\n"
