"""Conditions of the robot's own code, such as an `if`, that may keep a call from running at some times."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from contextlib import AbstractContextManager, nullcontext
from functools import cached_property

from sleec_verify.conformance.structure.control import Flow
from sleec_verify.conformance.structure.methods import read_variant
from sleec_verify.conformance.structure.program import DEFS, Function, Scope
from sleec_verify.conformance.structure.resolve import Resolver
from sleec_verify.conformance.structure.uses import Use
from sleec_verify.conformance.structure.values import Code


class OwnConditions:
    """The conditions around the calls of a target, and around the calls of the functions that contain them."""

    def __init__(self, resolver: Resolver, uses: Iterable[Use]) -> None:
        self._resolver = resolver
        self._uses = uses
        self._callers: dict[Function, list[Use]] = {}
        self._passed_on: set[Function] = set()

    def around(self, use: Use) -> str | None:
        """Where a condition of the code may keep `use` from running; None if it runs whenever its entry point does."""
        return self._around(use.node, use.scope, set())

    @cached_property
    def _why(self) -> dict[ast.AST, str | None]:
        """For each expression of the target, why it may not run when its function is called."""
        for use in self._uses:
            self._note(use)
        flow = _Conditions()
        for module in self._resolver.program.modules:
            flow.statements(module.file.tree.body, None)
        return flow.why

    def _note(self, use: Use) -> None:
        callee = isinstance(use.parent, ast.Call) and use.parent.func is use.node
        if isinstance(use.node, ast.Call):
            value = self._resolver.of(use.node.func, use.scope)
            for function in value.definitions if isinstance(value, Code) else ():
                self._callers.setdefault(function, []).append(use)
        elif isinstance(use.node, (ast.Name, ast.Attribute)) and not callee and isinstance(use.node.ctx, ast.Load):
            value = self._resolver.of(use.node, use.scope)
            self._passed_on.update(value.definitions if isinstance(value, Code) else ())

    def _around(self, node: ast.AST, scope: Scope, seen: set[Function]) -> str | None:
        why = self._why.get(node)
        function = scope.function
        if why is not None or function is None:
            return why
        if function in seen:
            return f"in {function.name}"
        seen.add(function)
        if read_variant(function, self._resolver).foreign:
            return f"in {function.name}, which has a decorator"
        callers = self._callers.get(function, ())
        if not callers or function in self._passed_on:
            return None
        found = None
        for caller in callers:
            found = self._around(caller.node, caller.scope, seen)
            if found is None:
                return None
        return found


class _Conditions(Flow):
    """Notes for each expression why it may not run when its function is called."""

    def __init__(self) -> None:
        self.why: dict[ast.AST, str | None] = {}

    def expression(self, node: ast.expr, why: str | None, awaited: bool = False) -> None:
        self.why[node] = why
        if isinstance(node, ast.Lambda):
            self.expression(node.body, why)
        else:
            super().expression(node, why, awaited)

    def nested(self, node: ast.stmt) -> None:
        if isinstance(node, (*DEFS, ast.ClassDef)):
            self.statements(node.body, None)

    def call(self, node: ast.Call, why: str | None, awaited: bool) -> None:
        """Noted as an expression."""

    def reference(self, node: ast.expr) -> None:
        """Noted as an expression."""

    def suppresses(self, node: ast.expr) -> bool:
        return False

    def within(self, node: ast.AST) -> AbstractContextManager[object]:
        return nullcontext()

    def follows(self, node: ast.Call) -> bool:
        return False

    def outside(self, node: ast.expr) -> str | None:
        return None
