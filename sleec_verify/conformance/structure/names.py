"""Which functions implement which obligations: by a mark, or by the name in snake case."""

from __future__ import annotations

import ast
from collections.abc import Collection

from sleec_runtime.dispatch.implementations import snake_case
from sleec_verify.conformance.structure.program import Function
from sleec_verify.conformance.structure.resolve import Resolver
from sleec_verify.conformance.structure.values import Api, ObligationMark


class Names:
    """Which functions implement which obligations: by a mark, or by the name in snake case."""

    def __init__(self, obligations: Collection[str], resolver: Resolver) -> None:
        self.by_method: dict[str, list[str]] = {}
        for name in sorted(obligations):
            self.by_method.setdefault(snake_case(name), []).append(name)
        self.obligations = frozenset(obligations)
        self._resolver = resolver
        self._marks: dict[Function, str | None] = {}
        self.marked: dict[str, Function] = {}
        for function in resolver.program.functions:
            mark = self.mark(function)
            if mark is not None:
                self.marked[mark] = function

    def mark(self, function: Function) -> str | None:
        """The obligation that a function is marked with."""
        if function not in self._marks:
            values = [self._resolver.of(node, function.scope) for node in function.node.decorator_list]
            names = [value.name for value in values if isinstance(value, ObligationMark)]
            self._marks[function] = names[0] if names else None
        return self._marks[function]

    def of(self, function: Function) -> str | None:
        """The obligation that a function implements, by its mark or else by its name."""
        mark = self.mark(function)
        if mark is not None:
            return mark
        # A mark goes before a name: what another function is marked with, this one is not.
        names = [name for name in self.by_method.get(function.name, ()) if not self._elsewhere(name, function)]
        return names[0] if names else None

    def _elsewhere(self, name: str, function: Function) -> bool:
        marked = self.marked.get(name)
        return marked is not None and marked.owner is function.owner

    def called(self, name: str) -> str | None:
        """The obligation that code outside the target implements, if its name says so."""
        names = self.by_method.get(name)
        return names[0] if names else None

    def called_outside(self, function: Api, written: ast.expr) -> str | None:
        """The obligation that a function of another package implements, if its name or the name `written` says so."""
        name = None if function.standard else self.called(function.name.rpartition(".")[2])
        if name is None and isinstance(written, ast.Name) and function.name != f"builtins.{written.id}":
            return self.called(written.id)
        return name
