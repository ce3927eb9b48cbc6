"""Finds, reads and parses the Python files of a target, and runs none of them."""

from __future__ import annotations

import ast
import os
import re
import sys
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from sleec_runtime.errors import LanguageError, Problem, SleecError, UnreadableFile
from sleec_runtime.language.common.source import normalize_line_breaks, read_standard_input
from sleec_runtime.model import Source, Span
from sleec_runtime.support.files import read_file
from sleec_verify.files.folders import leads_below
from sleec_verify.results.internal_error import internal_errors_of

SUFFIX = ".py"
_STDIN = "-"
_HEAD = re.compile(r"(?:async\s+)?(?:def|class)\s+\w+")
_NOT_IN_PYTHON = re.compile("[\0\ud800-\udfff]")
_NOT_THE_DEVELOPERS = {"__pycache__", "node_modules", "site-packages"}


class NoTarget(SleecError):
    """The target does not exist, or contains no Python code."""


class NotPython(LanguageError):
    """A file that is not Python, with the place of the first error."""


@dataclass(frozen=True, eq=False)
class PythonFile:
    """A file of the target. `parts` are the absolute path's, without the suffix: the module's name is their end."""

    source: Source
    tree: ast.Module
    parts: tuple[str, ...]

    @cached_property
    def _line_starts(self) -> list[int]:
        starts = [0]
        for line in self.source.text.split("\n"):
            starts.append(starts[-1] + len(line) + 1)
        return starts

    def offset(self, line: int, column: int) -> int:
        """The offset of a place as `ast` gives it: lines from 1, columns in bytes of UTF-8."""
        start = self._line_starts[line - 1]
        text = self.source.text[start : self._line_starts[line] - 1]
        return start + (column if text.isascii() else len(text.encode()[:column].decode(errors="ignore")))

    def span(self, node: ast.AST) -> Span:
        """Where a node stands; of a definition, `def` and its name."""
        start = self.offset(node.lineno, node.col_offset)  # type: ignore[attr-defined]
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            head = _HEAD.match(self.source.text, start)
            assert head is not None, "a definition begins with its keyword"
            return Span(start, head.end())
        return Span(start, self.offset(node.end_lineno, node.end_col_offset))  # type: ignore[attr-defined]


def python_files(target: str) -> tuple[PythonFile, ...]:
    """The files of a target: a file, a folder (every ``*.py`` below it), a module's or package's name, or
    ``-``, which is standard input.

    Raises:
        NoTarget: there is no such thing, or no Python in it.
        UnreadableFile: a file is forbidden, or not text in the encoding that it declares.
        NotPython: a file does not parse.
    """
    paths = list(_paths(target))
    if not paths:
        raise NoTarget(f"there is no {SUFFIX} file below {target}", "name the folder with the robot's code")
    files = []
    for path in paths:
        with internal_errors_of(path):
            files.append(_read(path))
    return tuple(files)


def _paths(target: str) -> Iterator[str]:
    if os.path.isdir(target):
        yield from _below(target)
    elif target == _STDIN or os.path.exists(target) or target.endswith(SUFFIX) or os.path.basename(target) != target:
        yield target
    else:
        yield from _module(target)


def _below(folder: str) -> Iterator[str]:
    """Every Python file of the developer's own: hidden folders and virtual environments are left out."""

    def refuse(error: OSError) -> None:
        # What is in there may be what reaches around the dispatch.
        raise UnreadableFile(f"the folder {error.filename} cannot be read: {error.strerror}") from None

    for parent, folders, names in os.walk(folder, onerror=refuse):
        folders[:] = sorted(
            name
            for name in folders
            if name not in _NOT_THE_DEVELOPERS
            and not name.startswith(".")
            and not os.path.exists(os.path.join(parent, name, "pyvenv.cfg"))
        )
        for path in (os.path.join(parent, name) for name in sorted(names) if name.endswith(SUFFIX)):
            if os.path.islink(path) and not (leads_below(path, folder) and os.path.realpath(path).endswith(SUFFIX)):
                # To skip it might hide what reaches around the dispatch.
                raise UnreadableFile(
                    f"the link {path} does not lead to a Python file below {folder}",
                    "name the folder with the code, or remove the link",
                )
            yield path


def _module(name: str) -> Iterator[str]:
    """The files of a module on sys.path. Its parents are looked into, not imported, as importlib.util would."""
    from importlib.machinery import PathFinder, SourceFileLoader

    where = ["", *sys.path]
    spec = None
    for done, part in enumerate(name.split("."), 1):
        try:
            spec = PathFinder.find_spec(part, where)
        except (ImportError, ValueError):
            spec = None
        if spec is None:
            missing = ".".join(name.split(".")[:done])
            raise NoTarget(
                f"file or folder {name} does not exist, and sys.path has no module {missing}",
                "name a Python file or a folder, or add the module to PYTHONPATH",
            )
        where = list(spec.submodule_search_locations or ())
    assert spec is not None, "a name has at least one part"
    if where:
        for folder in where:
            yield from _below(_shortest(folder))
    elif isinstance(spec.loader, SourceFileLoader) and spec.origin is not None:
        yield _shortest(spec.origin)
    else:
        raise NoTarget(f"module {name} has no Python source", "name the file or folder of its source")


def _shortest(path: str) -> str:
    """The path relative to the current folder, if it is below it."""
    try:
        relative = os.path.relpath(path)
    except ValueError:  # another drive
        return path
    return path if relative.startswith(os.pardir) else relative


def _read(path: str) -> PythonFile:
    source = _source(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the developer's escapes and the like
            tree = ast.parse(source.text, path)
    except SyntaxError as error:
        raise NotPython(source, [_problem(source, error)]) from None
    except (RecursionError, MemoryError):
        raise UnreadableFile(f"{path} is nested too deeply to be read") from None
    absolute = os.path.abspath(path).removesuffix(SUFFIX)
    parts = tuple(part for part in absolute.split(os.sep) if part)
    return PythonFile(source, tree, parts[:-1] if parts[-1] == "__init__" else parts)


def _problem(source: Source, error: SyntaxError) -> Problem:
    lines = source.text.split("\n")
    line = min(max(error.lineno or 1, 1), len(lines))
    start = sum(len(before) + 1 for before in lines[: line - 1])
    column = min(max((error.offset or 1) - 1, 0), len(lines[line - 1]))
    span = Span(start + column, min(start + column + 1, len(source.text)))
    return Problem(f"this is not valid Python: {error.msg}", span)


def _bytes(path: str) -> tuple[str, bytes]:
    """The name and the content of a file."""
    if path == _STDIN:
        return "<stdin>", read_standard_input()
    try:
        return path, read_file(path)
    except FileNotFoundError:
        raise NoTarget(f"file {path} does not exist", "check its name and folder") from None
    except (OSError, ValueError) as error:
        raise UnreadableFile(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from None


def _source(path: str) -> Source:
    from hashlib import sha256

    path, data = _bytes(path)
    text = _decoded(path, data)
    found = _NOT_IN_PYTHON.search(text)
    if found is not None:
        line = text.count("\n", 0, found.start()) + 1
        what = "a NUL byte" if found[0] == "\0" else f"the lone surrogate U+{ord(found[0]):04X}"
        raise UnreadableFile(f"{path} is not valid Python: line {line} contains {what}")
    return Source(path, normalize_line_breaks(text), sha256(data).hexdigest())


def _decoded(path: str, data: bytes) -> str:
    """The text that these bytes are in the encoding that they declare. Raises `UnreadableFile`."""
    from io import BytesIO
    from tokenize import detect_encoding

    try:
        encoding, _ = detect_encoding(BytesIO(data).readline)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of escapes in a text that is all escapes
            return data.decode(encoding)
    except SyntaxError as error:  # a cookie that names no encoding, or bytes that are not UTF-8 in the first lines
        raise UnreadableFile(f"{path} cannot be read: {error.msg}", "correct its `# -*- coding` line") from None
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise UnreadableFile(
            f"{path} is not {error.encoding} text: line {line} contains the byte 0x{error.object[error.start]:02x}",
            "save it as UTF-8, or declare its encoding in the first line: # -*- coding: latin-1 -*-",
        ) from None
    except (LookupError, UnicodeError):  # not an encoding of texts, such as `hex`, or one that does not say where
        raise UnreadableFile(
            f"{path} is not text in the encoding {encoding}, which it declares",
            "save it as UTF-8, and remove its `# -*- coding` line",
        ) from None
