"""What may be named as the target, and how it is read."""

from __future__ import annotations

import encodings
import os
import sys
from contextlib import suppress
from encodings.aliases import aliases
from io import BytesIO, TextIOWrapper
from pathlib import Path
from pkgutil import iter_modules

import pytest

from sleec_runtime.errors import UnreadableFile
from sleec_verify.cli import run
from sleec_verify.conformance.structure.target import NoTarget, NotPython, python_files


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [str(tmp_path / "lib"), *sys.path])
    return tmp_path


def write(path: Path, text: str | bytes = "x = 1\n") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def paths(target: str) -> list[str]:
    return [Path(file.source.path).as_posix() for file in python_files(target)]


def test_a_folder_is_every_file_of_the_developers_own(folder: Path) -> None:
    for name in ("b.py", "a/c.py", "a/__init__.py", ".hidden/x.py", "__pycache__/x.py", "venv/x.py", "note.txt"):
        write(folder / "robot" / name)
    write(folder / "robot" / "venv" / "pyvenv.cfg")
    assert paths("robot") == ["robot/b.py", "robot/a/__init__.py", "robot/a/c.py"]


def test_a_module_is_found_and_not_imported(folder: Path) -> None:
    write(folder / "lib" / "bot" / "__init__.py", "raise SystemExit('imported')")
    write(folder / "lib" / "bot" / "arm.py", "raise SystemExit('imported')")
    write(folder / "lib" / "space" / "leg.py")
    assert paths("bot") == ["lib/bot/__init__.py", "lib/bot/arm.py"]
    assert paths("bot.arm") == ["lib/bot/arm.py"]
    assert paths("space") == ["lib/space/leg.py"]
    assert "bot" not in sys.modules


def test_a_module_of_the_working_folder_is_found(folder: Path) -> None:
    write(folder / "here.py")
    assert paths("here") == ["here.py"]


def test_a_folder_that_may_not_be_read(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(folder / "robot" / "a.py")
    write(folder / "robot" / "closed" / "b.py")
    scandir = os.scandir

    def refusing(path: str) -> object:
        if str(path).endswith("closed"):
            raise PermissionError(13, "Permission denied", path)
        return scandir(path)

    monkeypatch.setattr(os, "scandir", refusing)
    with pytest.raises(UnreadableFile, match="closed cannot be read: Permission denied"):
        python_files("robot")


def test_standard_input(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", TextIOWrapper(BytesIO("\ufeffx = 'ü'\n".encode())))
    (file,) = python_files("-")
    assert (file.source.path, file.source.text) == ("<stdin>", "x = 'ü'\n")
    monkeypatch.setattr(sys, "stdin", TextIOWrapper(BytesIO(b"def")))
    with pytest.raises(NotPython, match="<stdin>"):
        python_files("-")


@pytest.mark.parametrize("name", ["no_such", "bot.no_such", "no.such", ".x", ""])
def test_no_such_module(folder: Path, name: str) -> None:
    write(folder / "lib" / "bot" / "__init__.py")
    with pytest.raises(NoTarget):
        python_files(name)


def test_a_module_without_source(folder: Path) -> None:
    from importlib.machinery import EXTENSION_SUFFIXES

    write(folder / "lib" / f"fast{EXTENSION_SUFFIXES[0]}")
    with pytest.raises(NoTarget, match="no Python source"):
        python_files("fast")


def test_encodings(folder: Path) -> None:
    write(folder / "marked.py", b"\xef\xbb\xbfname = '\xc3\xbc'\r\nother = 1\rthird = 2\n")
    write(folder / "latin.py", b"# -*- coding: latin-1 -*-\nname = '\xfc'\n")
    assert python_files("marked.py")[0].source.text == "name = 'ü'\r\nother = 1\nthird = 2\n"
    assert "ü" in python_files("latin.py")[0].source.text


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"# -*- coding: klingon -*-\n", "unknown encoding"),
        (b"# 1\n# 2\n# 3\nname = '\xfc'\n", "line 4 contains the byte 0xfc"),
        (b"\xff\xfe", "cannot be read"),
        (b"x = 1\n\0", "line 2 contains a NUL byte"),
    ],
)
def test_files_that_are_no_text(folder: Path, data: bytes, message: str) -> None:
    write(folder / "bad.py", data)
    with pytest.raises(UnreadableFile, match=message):
        python_files("bad.py")


def test_a_file_that_is_no_python(folder: Path) -> None:
    write(folder / "robot" / "good.py")
    write(folder / "robot" / "worse.py", "def f(:\n  pass\n")
    with pytest.raises(NotPython, match=r"worse\.py:1:7: this is not valid Python") as caught:
        python_files("robot")
    (problem,) = caught.value.problems
    assert problem.span.start == 6


@pytest.mark.parametrize("text", ["if x:\n", "x = (\n", "  x = 1\n", "'abc\n", "x = 1 +"])
def test_mistakes_have_a_place_in_the_file(folder: Path, text: str) -> None:
    write(folder / "bad.py", text)
    with pytest.raises(NotPython) as caught:
        python_files("bad.py")
    (problem,) = caught.value.problems
    assert 0 <= problem.span.start <= problem.span.end <= len(text)


def test_what_is_nested_too_deeply(folder: Path) -> None:
    write(folder / "deep.py", "x = " + "-" * 100_000 + "1")
    with pytest.raises((UnreadableFile, NotPython)):
        python_files("deep.py")


def test_a_forbidden_file_and_a_folder_with_a_files_name(folder: Path) -> None:
    (folder / "odd.py").mkdir()
    with pytest.raises(NoTarget, match=r"no \.py file below"):
        python_files("odd.py")
    write(folder / "lib" / "a" / "b.txt")
    with pytest.raises(NoTarget):
        python_files("lib/a/b/c")


def test_a_lone_surrogate_is_refused(folder: Path) -> None:
    write(folder / "odd.py", "# coding: raw_unicode_escape\nx = '\\ud800'\n")
    with pytest.raises(UnreadableFile, match="line 2 contains the lone surrogate U\\+D800"):
        python_files("odd.py")


CODECS = sorted({*aliases, *aliases.values(), *(module.name for module in iter_modules(encodings.__path__))})
BODIES = (
    b"x = 1\n",
    b"x = '\xff\xfe\x80\x00'\n",
    b"x = '+2AA-'\n",  # a lone surrogate in UTF-7
    b"x = '\\ud800 \\q \\x'\n",
    bytes(range(256)),
    "x = '\xe4\u1234\ud800'\n",
    "x = '\xe4'\n",
    "",
)


def encoded(body: str | bytes, codec: str) -> bytes | None:
    """A source in the encoding that it declares, as far as the codec can write it; bytes are taken as they are."""
    head = f"# -*- coding: {codec} -*-\n"
    if isinstance(body, bytes):
        return head.encode() + body
    try:
        return (head + body).encode(codec)
    except (LookupError, UnicodeError):
        return None


@pytest.mark.parametrize("codec", CODECS)
def test_every_codec_that_python_knows_is_read_or_refused(codec: str, folder: Path) -> None:
    for body in BODIES:
        data = encoded(body, codec)
        if data is not None:
            write(folder / "odd.py", data)
            with suppress(UnreadableFile, NotPython):
                python_files("odd.py")


@pytest.mark.parametrize("codec", ["rot13", "hex", "undefined", "punycode", "zlib", "utf_7"])
def test_a_codec_that_is_not_of_texts_is_refused(codec: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(folder / "rules.sleec", "WHEN A THEN B\n")
    write(folder / "odd.py", f"# coding: {codec}\nx = '+2AA-\\ud800'\n")
    assert run(["conform", "odd.py", "--ruleset", "rules.sleec"]) == 2
    message = capsys.readouterr().err
    assert message.startswith("error: odd.py is not ")
    assert "internal error" not in message
