"""Every expression of the target with the scope that it is evaluated in."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple

from sleec_verify.conformance.structure.program import DEFS, Scope, TargetProgram


class Use(NamedTuple):
    """An expression, its scope, and the node that holds it."""

    node: ast.expr
    scope: Scope
    parent: ast.AST


def uses(program: TargetProgram) -> Iterator[Use]:
    """The expressions of all files, each before those within it."""
    for module in program.modules:
        yield from _below(program, module.node, module)


def _below(program: TargetProgram, node: ast.AST, scope: Scope) -> Iterator[Use]:
    inner = program.scope_of.get(node, scope)
    for name, value in ast.iter_fields(node):
        # Decorators, defaults, annotations and bases belong to the scope around a definition.
        outside = isinstance(node, (*DEFS, ast.ClassDef, ast.Lambda)) and name != "body"
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                if isinstance(child, ast.expr):
                    yield Use(child, scope if outside else inner, node)
                yield from _below(program, child, scope if outside else inner)
