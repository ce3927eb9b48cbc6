"""Names, paths, reasons and arguments are text of others: none of it steers a terminal, forges a line or gives a
service a command, in any format of any command. Formats for programs stay valid, and hold the names as they are."""

from __future__ import annotations

import ast
import io
import json
import os
import re
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from shutil import rmtree
from typing import Any, NamedTuple
from unicodedata import category
from urllib.parse import unquote_to_bytes
from xml.etree.ElementTree import fromstring

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import sleec_verify
from sleec_runtime.errors import SleecError, UnknownTrigger, UnreadableFile
from sleec_verify.cli import run
from sleec_verify.report import FORMATS
from sleec_verify.report.palette import Palette

CONFLICT = "WHEN A THEN B\nWHEN A THEN NOT B\n"
ROBOT = "import sleec_runtime\nsleec = sleec_runtime.load('rules.sleec')\nsleec.implement({'B': print})\n"
JOINERS = "\u200c\u200d"
PIECES = (
    *("\n", "\r", "\r\n", "\t", "\x0b", "\x0c", "\x1c", "\x85", "\u2028", "\u2029"),  # what ends a line somewhere
    *("\x1b[2J", "\x1b[1;31m", "\x1b]0;title\x07", "\x9b31m", "\x08", "\x7f", "\x1b"),  # what terminals obey
    *("\u202e", "\u2066", "\u200f", "\u061c", "\u200b", "\ufeff", "\u00ad", "\U000e0041"),  # what changes what is seen
    *("::stop-commands::x", "::error::x", "  ::error::x", "##[group]x", "###[error]", "##vso[task.complete]", "%0A"),
    *("<!--", "]]>", "&amp;", "<b>", '"', "'", "`", "|", "@all", "\\", "\\n", ",", ":"),
    *("\udcff", "\ufffe", "\U0010ffff", "\ue000", "\xa0", "ü", "窓", "x", "A", " "),
)
texts = st.lists(st.sampled_from(PIECES), min_size=1, max_size=4).map("".join)
anything = texts | st.text(min_size=1, max_size=6)
arguments = anything.map(lambda text: text.replace("\0", "")).filter(bool)
file_names = arguments.map(lambda text: text.replace("/", "").strip(".")).filter(
    lambda name: 0 < len(os.fsencode(name)) < 80
)


class Ran(NamedTuple):
    code: int
    out: str
    err: str


class Terminal(io.TextIOWrapper):
    def isatty(self) -> bool:
        return True


def ran(*words: str, kind: type[io.TextIOWrapper] = io.TextIOWrapper) -> Ran:
    """A command line in this process, with streams that write nothing but what can be said in UTF-8."""
    streams = [kind(io.BytesIO(), encoding="utf-8", write_through=True) for _ in range(2)]
    with redirect_stdout(streams[0]), redirect_stderr(streams[1]):
        code = run(words)
    return Ran(code, *(stream.buffer.getvalue().decode("utf-8", "surrogateescape") for stream in streams))  # type: ignore[attr-defined]


@pytest.fixture(scope="module")
def folder() -> Iterator[Path]:
    """An empty folder. Examples that Hypothesis makes share it, each with files of its own."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)
        yield Path(name)
        os.chdir(before)


def is_shown(character: str) -> bool:
    return character.isprintable() or character in JOINERS or category(character) == "Zs"


def assert_harmless(text: str) -> None:
    """What people read: lines of printable characters, of which no service obeys one."""
    for line in text.split("\n"):
        assert all(map(is_shown, line)), ascii(line)
        assert not line.lstrip().startswith("::"), ascii(line)
        assert not re.search(r"##[A-Za-z]*\[", line), ascii(line)


ANNOTATION = re.compile(r"::(?:error|warning|notice) (?:[a-zA-Z]+=[^:,\r\n]*,?)+::[^\r\n]*")


def assert_annotations(text: str) -> None:
    others = [line for line in text.split("\n") if not ANNOTATION.fullmatch(line)]
    assert_harmless("\n".join(others))
    assert all(map(is_shown, text.replace("\n", "")))


def assert_valid(form: str, text: str) -> Any:
    """Output in a format, which is harmless, and for programs what it holds."""
    if form in ("full", "concise"):
        assert_harmless(text)
        return None
    if form == "github":
        assert_annotations(text)
        return None
    assert text.isascii()
    assert_harmless(text)
    return fromstring(text) if form == "junit" else json.loads(text)


def in_xml(name: str) -> str:
    """`name` with escapes for what XML cannot hold."""
    return "".join(
        c
        if re.match("[\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", c)
        else c.encode("unicode_escape").decode()
        for c in name
    )


def lines(ran: Ran) -> tuple[int, int]:
    return ran.out.count("\n"), ran.err.count("\n")


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMATS)
@given(name=file_names)
def test_check_of_a_file(form: str, name: str, folder: Path) -> None:
    path = f"{name}.sleec"
    (folder / path).write_text(CONFLICT, encoding="utf-8")
    found = ran("check", f"./{path}", "--format", form)
    assert found.code == 1
    assert_harmless(found.err)
    parsed = assert_valid(form, found.out)
    if form == "json":
        assert parsed["rulesets"][0]["path"] == f"./{path}"
    elif form == "gitlab":
        assert {one["location"]["path"] for one in parsed} == {path}
    elif form == "junit":
        assert parsed[0].get("name") == in_xml(path)
    elif form == "sarif":
        (artifact,) = parsed["runs"][0]["artifacts"]
        assert unquote_to_bytes(artifact["location"]["uri"]) == os.fsencode(path)
    if form != "junit":  # in which a line break is text
        (folder / "benign.sleec").write_text(CONFLICT, encoding="utf-8")
        assert lines(found) == lines(ran("check", "./benign.sleec", "--format", form))


@pytest.mark.parametrize("form", FORMATS)
@given(text=arguments)
def test_check_of_no_rules(form: str, text: str, folder: Path) -> None:
    (folder / "broken.sleec").write_bytes(f"WHEN A THEN {text}(\n{text}".encode("utf-8", "surrogatepass"))
    found = ran("check", "broken.sleec", "--format", form, "--domain", text)
    assert_harmless(found.err)
    assert_valid(form, found.out)


REPORTS = {
    "check": "check X.sleec nowhere/X.sleec --format concise",
    "check -o": "check good.sleec -o X.txt",
    "check of nothing": "check ./X",
    "entail": "entail X.sleec --when A",
    "entail, concise": "entail X.sleec --when A --format concise",
    "entail, when": "entail good.sleec --when X",
    "entail, given": "entail good.sleec --when A --given X",
    "entail, domain": "entail good.sleec --when A --domain X",
    "explain": "explain X.sleec --when A",
    "explain, given": "explain good.sleec --given X",
    "diff, old": "diff X.sleec good.sleec",
    "diff, new": "diff good.sleec X.sleec --format concise",
    "diff, added": "diff nowhere X.sleec",
    "diff --assert": "diff good.sleec good.sleec --assert X",
    "diff --assertions": "diff good.sleec good.sleec --assertions X.txt",
    "diff --git": "diff --git X good.sleec",
    "diff, domain": "diff good.sleec good.sleec --domain X",
    "gate --base": "gate --base X good.sleec",
    "gate of a file": "gate --base HEAD X.sleec",
    "gate --config": "gate --config X.txt",
    "gate --baseline": "gate --base HEAD --baseline X.txt good.sleec",
    "gate --assert": "gate --base HEAD --assert X good.sleec",
    "gate -o": "gate --base HEAD good.sleec -o X.txt",
    "gate --write-baseline": "gate --baseline Xnew --write-baseline good.sleec",
    "fmt --check": "fmt --check X.sleec good.sleec",
    "fmt --write": "fmt --write X.sleec",
    "fmt --diff": "fmt --diff X.sleec",
    "convert, to nothing": "convert good.sleec --to X",
    "convert, domain": "convert good.sleec --to dsl --domain X",
    "compile": "compile good.sleec --to json --domain X",
    "cases -o": "cases good.sleec -o X.txt --force",
    "certify -o": "certify X.sleec -o Xnew",
    "certify, there is one": "certify good.sleec -o X.txt",
    "certify --check": "certify good.sleec --check X",
    "certify --key": "certify good.sleec --check X --key X.txt",
    "conform": "conform X.py --ruleset X.sleec",
    "conform, no target": "conform X --ruleset good.sleec",
    "audit": "audit X.jsonl --ruleset good.sleec --format concise",
    "audit, no log": "audit X --ruleset good.sleec",
    "audit --mapping": "audit X.jsonl --ruleset good.sleec --mapping X.txt",
    "audit --state": "audit X.jsonl --ruleset good.sleec --state X.txt",
    "rules": "rules X",
    "no command": "X",
    "no option": "check --X good.sleec",
    "no such choice": "check good.sleec --format X",
    "no number": "check good.sleec --realizable X",
    "no size": "check good.sleec --max-size X",
}


@pytest.mark.parametrize("role", REPORTS)
@settings(max_examples=25)
@given(name=file_names)
def test_what_people_read(role: str, name: str, folder: Path) -> None:
    files = {"X.sleec": "WHEN A  THEN B\n", "X.txt": CONFLICT, "X.py": ROBOT, "X.jsonl": '{"time": 0, "event": "E"}\n'}
    _repository(folder)
    for known, text in files.items():
        (folder / known.replace("X", name)).write_text(text, encoding="utf-8")
    found = ran(*(word.replace("X", name) for word in REPORTS[role].split()))
    assert_harmless(found.err)
    assert_harmless(found.out)


def _repository(folder: Path) -> None:
    """Make the folder a repository with good.sleec, and without the files of other examples."""
    for file in folder.iterdir():
        if not file.is_dir():
            file.unlink()
        elif file.name != ".git":
            rmtree(file)
    (folder / "good.sleec").write_text("WHEN A THEN C\n", encoding="utf-8")
    if not (folder / ".git").exists():
        identity = ["-c", "user.name=a", "-c", "user.email=a@b"]
        for command in (["init", "-q"], ["add", "good.sleec"], ["commit", "-qm", "base"]):
            subprocess.run(["git", *identity, *command], cwd=folder, check=True)


def in_toml(text: str) -> str:
    return '"' + "".join(f"\\U{min(ord(c), 0xD7FF):08x}" for c in text) + '"'


def settings_of(text: str) -> dict[str, str]:
    said = in_toml(text)
    return {
        "reasons": "",
        "assertions": f"assertions = [{in_toml('never ' + text)}]",
        "files": f"assertions = [{said}]",
        "targets": f"[[targets]]\ncode = {said}\nrules = {said}\ndomain = {said}\n",
        "domains": f'[[targets]]\ncode = "robot.py"\nrules = "good.sleec"\ndomain = {said}\n',
        "rulesets": f"rulesets = [{said}]",
        "policies": f"[policy]\n{said} = 1",
    }


@pytest.mark.parametrize("setting", settings_of(""))
@settings(max_examples=20)
@given(text=arguments, name=file_names, form=st.sampled_from(FORMATS))
def test_gate(setting: str, text: str, name: str, form: str, folder: Path) -> None:
    _repository(folder)
    (folder / "robot.py").write_text(ROBOT, encoding="utf-8")
    # A reason is in a comment, and so is one line.
    reason = re.sub("[\n\r\0\ud800-\udfff]", "", text)
    allowed = f"// sleec: allow SLEEC101 because {reason}\n// sleec: allow SLEEC302, {reason} because x\n"
    (folder / f"{name}.sleec").write_text(allowed + CONFLICT, encoding="utf-8")
    config = 'base = "HEAD"\n' + settings_of(text)[setting]
    (folder / "sleec-verify.toml").write_text(config, encoding="utf-8")
    found = ran("gate", ".", "--format", form, "--summary", "summary.md")
    assert_harmless(found.err)
    if found.out:
        assert_valid(form, found.out)
    assert found.out or setting != "reasons"
    if (folder / "summary.md").exists():
        summary = (folder / "summary.md").read_text(encoding="utf-8")
        # Without the zero-width space, @name would notify somebody.
        assert all(map(is_shown, summary.replace("@\u200b", "@").replace("\n", "")))


@pytest.mark.parametrize("form", FORMATS)
@settings(max_examples=25)
@given(name=file_names, label=arguments)
def test_conform(form: str, name: str, label: str, folder: Path) -> None:
    path = f"{name}.py"
    code = f"{ROBOT}\nclass Robot:\n    @sleec.rule({label!a})\n    def a(self): sleec.layers[{label!a}]\n"
    (folder / path).write_text(code, encoding="utf-8")
    (folder / "rules.sleec").write_text("WHEN A THEN B\n", encoding="utf-8")
    found = ran("conform", f"./{path}", "--ruleset", "rules.sleec", "--format", form)
    assert_harmless(found.err)
    assert_valid(form, found.out)
    (folder / path).unlink()


@pytest.mark.parametrize("form", FORMATS)
@settings(max_examples=25)
@given(name=file_names, text=anything)
def test_audit(form: str, name: str, text: str, folder: Path) -> None:
    log = [
        {"time": 0, "event": text},
        {"time": 1, "conditions": {text: text, "Low": text}},
        {"time": 2, "domain": text},
        {"time": 3, "topic": text, "message": {text: text}},
        {"time": 4, "topic": "/t", "message": {text: text}},
        {"time": 5, text: text},
    ]
    lines = "".join(f"{json.dumps(one)}\n" for one in log)
    (folder / f"{name}.jsonl").write_text(lines + text, encoding="utf-8", errors="surrogatepass")
    (folder / "rules.sleec").write_text("MEASURE Low: number\nWHEN A THEN B UNLESS Low > 1\n", encoding="utf-8")
    (folder / "m.toml").write_text('measures.Low = {topic = "/t", field = "x"}\n', encoding="utf-8")
    options = ("--ruleset", "rules.sleec", "--mapping", "m.toml", "--format", form)
    found = ran("audit", f"./{name}.jsonl", *options)
    assert_harmless(found.err)
    assert_valid(form, found.out)
    (folder / f"{name}.jsonl").unlink()


def test_colours_are_those_of_the_palette_only(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A name cannot hold a colour, even where there are colours."""
    monkeypatch.setattr("sleec_verify.report.palette.Palette.of", lambda *_: Palette(coloured=True))
    (folder / "\x1b[32mgood.sleec").write_text(CONFLICT, encoding="utf-8")
    found = ran("check", "\x1b[32mgood.sleec")
    assert r"\x1b[32mgood.sleec:1:1: " + "\033[1;31merror[SLEEC101]\033[0m" in found.out


@given(text=arguments)
def test_an_error_of_the_runtime_is_a_line(text: str) -> None:
    for error in (SleecError(text, text), UnreadableFile(text), UnknownTrigger(text, [text])):
        assert all(map(is_shown, str(error)))
        assert error.message


def test_a_traceback_is_escaped(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError("\x1b[2J\n::stop-commands::x")

    monkeypatch.setattr("sleec_verify.checks.run_checks", fail)
    (folder / "good.sleec").write_text("WHEN A THEN C\n", encoding="utf-8")
    found = ran("--traceback", "check", "good.sleec")
    assert found.code == 2
    assert "Traceback" in found.err
    assert_harmless(found.err)


def test_a_progress_bar_shows_a_name_escaped(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.cli.progress.PATIENCE", 0)
    monkeypatch.setenv("COLUMNS", "200")
    (folder / "\x1b]0;x\x07.sleec").write_text(CONFLICT, encoding="utf-8")
    found = ran("check", "\x1b]0;x\x07.sleec", "--no-cache", kind=Terminal)
    assert r"\x1b]0;x\x07.sleec: " in found.err
    assert "\x1b]0;x" not in found.err + found.out


@pytest.mark.parametrize("command", ["fmt", "convert --to english", "fmt --diff"])
def test_data_is_escaped_on_a_terminal_only(command: str, folder: Path) -> None:
    (folder / "good.sleec").write_text("// \x1b[2J\u202e\nWHEN  A THEN C\n", encoding="utf-8")
    name, *options = command.split()
    assert "\x1b[2J\u202e" in ran(name, "good.sleec", *options).out
    shown = ran(name, "good.sleec", *options, kind=Terminal).out
    assert r"// \x1b[2J\u202e" in shown
    assert "\x1b" not in shown


PRINTS = {"cli/output.py": 2, "cli/__init__.py": 2, "cli/watch.py": 1, "certificates/theory/theorems.py": 4}
"""How often a module prints by itself: what has no text of others in it, and what is escaped right there."""


def test_all_else_is_printed_in_one_place() -> None:
    (home,) = sleec_verify.__path__
    found = {}
    for path in Path(home).rglob("*.py"):
        calls = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.Call)]
        names = [ast.unparse(node.func) for node in calls]
        number = sum(name in ("print", "click.echo", "echo", "sys.stderr.write", "sys.stdout.write") for name in names)
        if number:
            found[path.relative_to(home).as_posix()] = number
    found["cli/watch.py"] -= 1  # clears the terminal
    assert found == PRINTS
