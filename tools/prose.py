"""Check the wording of the documentation: ``python tools/prose.py [FILE …]``, without files everything in prose.toml.

The rules are data, in prose.toml beside this file: substitutions of words, and the length of sentences. To silence a
rule at one place, write the reason into a comment in the line before: ``prose: allow WORD, because REASON``.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parents[1]
TOML = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
SETTINGS: dict[str, Any] = TOML.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))

ALLOWED = re.compile(r"prose: allow (.+), because \w")
FENCED = re.compile(r"^( *)(`{3,}).*?^\1\2`*$", re.MULTILINE | re.DOTALL)
NO_PROSE = re.compile(r"`[^`\n]*`|\]\([^)\s]*\)|<[^>\n]*>|https?://\S+")
BLOCK = re.compile(r"\n\s*\n|\n(?= *(?:[-*|#]|\d+\.) ?)")
SENTENCE = re.compile(r"(?<=[.!?:;])[*_)\"]*\s+(?=[\"(*_[]*[A-Z`0-9])|\|")


class Text(NamedTuple):
    """A piece of prose, and the number of its first line."""

    line: int
    text: str


class Problem(NamedTuple):
    path: str
    line: int
    message: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.message}"


class Substitution(NamedTuple):
    """`pages` are the only files that it is about; None is every file."""

    avoid: re.Pattern[str]
    use: str
    pages: frozenset[str] | None


def substitutions() -> list[Substitution]:
    """All substitutions of prose.toml. A space stands for any white space, and words match whole."""
    found: list[Substitution] = []
    for table in SETTINGS["substitutions"]:
        pages = frozenset(table["pages"]) if "pages" in table else None
        for avoid, use in table["words"].items():
            pattern = avoid.replace(" ", r"\s+")
            found.append(Substitution(re.compile(rf"(?<![\w-]){pattern}(?![\w-])", re.IGNORECASE), use, pages))
    return found


def blank(found: re.Match[str]) -> str:
    """The lines of a block without their text, one word for code, and nothing for an address."""
    return "\n" * found[0].count("\n") or ("X" if found[0].startswith("`") else "")


def markdown(text: str) -> Iterator[Text]:
    """The paragraphs, list items, headings and rows of tables of a page, without code and addresses."""
    prose = NO_PROSE.sub(blank, FENCED.sub(blank, text))
    start = 0
    for end in [*(found.start() for found in BLOCK.finditer(prose)), len(prose)]:
        piece = prose[start:end]
        line = 1 + prose.count("\n", 0, start + len(piece) - len(piece.lstrip()))
        if piece.strip():
            yield Text(line, piece.strip())
        start = end


def python(text: str) -> Iterator[Text]:
    """The docstrings of a module, and its strings of three words or more: messages."""
    whole = list(ast.walk(ast.parse(text)))
    formatted = [node for node in whole if isinstance(node, ast.JoinedStr)]
    parts = {id(part) for node in formatted for part in node.values}
    for node in whole:
        if isinstance(node, ast.JoinedStr):
            found = "".join(str(part.value) if isinstance(part, ast.Constant) else "X" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in parts:
            found = node.value
        else:
            continue
        if len(re.findall(r"[A-Za-z]{2,} ", found)) >= 3:
            yield Text(node.lineno, re.sub(r"``?[^`]*``?", "X", found))


def sentences(text: str) -> Iterator[str]:
    yield from (sentence for sentence in SENTENCE.split(text) if sentence.strip(" -*#|"))


def problems(path: str, text: str) -> Iterator[Problem]:
    """What prose.toml says of a file; `path` is relative to the root of the project."""
    is_page = path.endswith(".md")
    allowed = {number: found[1].lower() for number, line in lines(text) if (found := ALLOWED.search(line))}
    most = SETTINGS["sentences"]["max-words"]
    rules = [rule for rule in substitutions() if rule.pages is None or path in rule.pages]
    for piece in (markdown if is_page else python)(text):
        last = piece.line + piece.text.count("\n")
        excused = {allowed.get(line) for line in range(piece.line - 1, last + 1)}
        for avoid, use, _ in rules:
            for found in avoid.finditer(piece.text):
                if found[0].lower() not in excused:
                    line = piece.line + piece.text.count("\n", 0, found.start())
                    words = " ".join(found[0].split())
                    yield Problem(path, line, f'avoid "{words}": {use}')
        if is_page and "long sentence" not in excused:
            for sentence in sentences(piece.text):
                count = len(re.findall(r"\w[\w'’-]*", sentence))
                if count > most:
                    start = " ".join(sentence.split()[:8])
                    yield Problem(path, piece.line, f"sentence of {count} words, at most {most}: {start} …")


def lines(text: str) -> Iterable[tuple[int, str]]:
    return enumerate(text.splitlines(), 1)


def files() -> list[Path]:
    """The files that prose.toml names."""
    excluded = {ROOT / name for name in SETTINGS["exclude"]}
    return sorted({path for pattern in SETTINGS["files"] for path in ROOT.glob(pattern)} - excluded)


def main(arguments: list[str]) -> int:
    found = [
        problem
        for path in ([Path(name).resolve() for name in arguments] or files())
        for problem in problems(str(path.relative_to(ROOT)), path.read_text(encoding="utf-8"))
    ]
    for problem in found:
        print(problem)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
