"""The templates of sentences in the code, as an abstract syntax tree shows them."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache

from tests.support.paths import ROOT

PLACEHOLDER = re.compile(r"\{(\w+)(?::,)?\}")


@cache
def templates() -> dict[str, str | None]:
    """Each template with words, and that of its plural if it has one."""
    found: dict[str, str | None] = {}
    for path in sorted((ROOT / "sleec_verify").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                for one, many in _templates_of(node.func.id, node.args, f"{path}:{node.lineno}"):
                    if re.search(r"[^\W\d_]", PLACEHOLDER.sub("", one)) or "thousands" in one:
                        found[one] = many
    return found


def _templates_of(function: str, arguments: list[ast.expr], place: str) -> Iterator[tuple[str, str | None]]:
    if function == "sentence":
        yield _literal(arguments[0], place), None
    elif function == "plural":
        yield _literal(arguments[1], place), _literal(arguments[2], place)
    elif function == "counted" and isinstance(arguments[1], ast.Constant):
        noun = _literal(arguments[1], place)
        yield f"{{number}} {noun}", f"{{number}} {noun}s"
        yield f"no {noun}s", None


def _literal(node: ast.expr, place: str) -> str:
    assert isinstance(node, ast.Constant), f"{place}: the template is not a literal"
    assert isinstance(node.value, str), place
    return node.value
