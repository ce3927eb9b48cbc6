"""Lines of code: without empty lines, comments and docstrings."""

from __future__ import annotations

import ast
from difflib import SequenceMatcher
from pathlib import Path


def code_lines(path: Path) -> list[str]:
    """The lines of a Python file or of a file of rules that are code. A file that is missing has none."""
    if not path.is_file():
        return []
    text = path.read_text(encoding="utf-8")
    marker = "#" if path.suffix == ".py" else "//"
    documentation = _docstring_lines(text) if path.suffix == ".py" else frozenset[int]()
    return [
        line.rstrip()
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.strip().startswith(marker) and number not in documentation
    ]


def _docstring_lines(text: str) -> frozenset[int]:
    """The numbers of the lines of texts that are statements by themselves: docstrings of modules, classes, functions
    and constants."""
    return frozenset(
        number
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
        for number in range(node.lineno, (node.end_lineno or node.lineno) + 1)
    )


def changed_lines(before: list[str], after: list[str]) -> int:
    """The lines that a developer adds, modifies or removes. A modified line counts once."""
    steps = SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    return sum(max(i2 - i1, j2 - j1) for step, i1, i2, j1, j2 in steps if step != "equal")
