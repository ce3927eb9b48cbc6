"""Control flow through a function: which parts always run, and why others may not."""

from __future__ import annotations

import ast
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager

from sleec_verify.conformance.structure.program import Def

STAYS, MAY_LEAVE, LEAVES = 0, 1, 2
"""Whether control leaves the function within a block."""

_AWAITERS = {
    f"asyncio.{module}{name}"
    for module in ("", "tasks.")
    for name in ("wait_for", "shield", "create_task", "ensure_future")
}
"""What awaits, or starts, the one coroutine that it is given: who awaits the call awaits that."""
_RUNNERS = {"asyncio.run", "asyncio.runners.run"}
_GATHERERS = {"asyncio.gather", "asyncio.tasks.gather"}

_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)


def own_nodes(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes below a node, without the bodies of nested functions and classes."""
    for child in ast.iter_child_nodes(node):
        yield child
        if not isinstance(child, _SCOPES):
            yield from own_nodes(child)


def always_raises(body: Sequence[ast.stmt]) -> bool:
    """Whether control leaves a block only by an exception."""
    ways_out = (ast.Return, ast.Break, ast.Continue)
    if any(isinstance(node, ways_out) for statement in body for node in (statement, *own_nodes(statement))):
        return False
    return any(
        isinstance(statement, ast.Raise)
        or (isinstance(statement, ast.If) and always_raises(statement.body) and always_raises(statement.orelse))
        for statement in body
    )


def is_generator(function: Def) -> bool:
    """Whether calling a function runs nothing of it yet."""
    return any(isinstance(node, (ast.Yield, ast.YieldFrom)) for node in own_nodes(function))


class Flow(ABC):
    """Visits statements and expressions in the order of execution. `why` is the reason why code may not run exactly
    once. It is None for code that always runs once."""

    @abstractmethod
    def call(self, node: ast.Call, why: str | None, awaited: bool) -> None:
        """A call, once its arguments are evaluated."""

    @abstractmethod
    def reference(self, node: ast.expr) -> None:
        """A name or attribute that is used, but not called."""

    @abstractmethod
    def nested(self, node: ast.stmt) -> None:
        """A definition within."""

    @abstractmethod
    def suppresses(self, node: ast.expr) -> bool:
        """Whether a context manager may end its block before its end."""

    @abstractmethod
    def within(self, node: ast.AST) -> AbstractContextManager[object]:
        """Enters the scope of a lambda or comprehension."""

    @abstractmethod
    def follows(self, node: ast.Call) -> bool:
        """Whether the analysis follows the call and so visits its arguments there."""

    @abstractmethod
    def outside(self, node: ast.expr) -> str | None:
        """The dotted name of the value of an expression, if the value is from outside the target."""

    # Statements -----------------------------------------------------------------------------------------

    def statements(self, body: Sequence[ast.stmt], why: str | None) -> int:
        """Visits a block. Returns whether control leaves the function in it."""
        leaves = STAYS
        for statement in body:
            how = self.statement(statement, why)
            if how == LEAVES:
                leaves, why = LEAVES, "after the function returns, so it never runs"
            elif how == MAY_LEAVE and leaves == STAYS:
                leaves, why = MAY_LEAVE, why or "after a possible return"
        return leaves

    def statement(self, node: ast.stmt, why: str | None) -> int:
        if isinstance(node, (ast.Return, ast.Raise)):
            for part in ast.iter_child_nodes(node):
                # Who awaits what a method returns awaits it for the method.
                self.part(part, why, awaited=isinstance(node, ast.Return))
            return LEAVES
        if isinstance(node, (ast.Break, ast.Continue)):
            return MAY_LEAVE
        if isinstance(node, ast.If):
            self.expression(node.test, why)
            then = self.statements(node.body, why or "under `if`")
            other = self.statements(node.orelse, why or "under `else`")
            return LEAVES if then == other == LEAVES else min(then + other, MAY_LEAVE)
        if isinstance(node, (ast.For, ast.AsyncFor, ast.While)):
            return self._loop(node, why)
        if isinstance(node, ast.Try) or type(node).__name__ == "TryStar":
            return self._try(node, why)  # type: ignore[arg-type]
        if isinstance(node, (ast.With, ast.AsyncWith)):
            return self._with(node, why)
        if isinstance(node, ast.Match):
            self.expression(node.subject, why)
            ways = [self.statements(case.body, why or "under `case`") for case in node.cases]
            return MAY_LEAVE if any(ways) else STAYS
        if isinstance(node, _SCOPES):
            self.nested(node)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            self._assignment(node, why)
        else:
            for part in ast.iter_child_nodes(node):
                self.part(part, why)
        return STAYS

    def _loop(self, node: ast.For | ast.AsyncFor | ast.While, why: str | None) -> int:
        self.expression(node.test if isinstance(node, ast.While) else node.iter, why)
        body = self.statements(node.body, why or "in a loop")
        other = self.statements(node.orelse, why or "in the `else` of a loop")
        returns = any(isinstance(inner, (ast.Return, ast.Raise)) for inner in own_nodes(node))
        endless = isinstance(node, ast.While) and isinstance(node.test, ast.Constant) and node.test.value
        return MAY_LEAVE if (body or other) and (returns or endless) else STAYS

    def _try(self, node: ast.Try, why: str | None) -> int:
        # A handler that raises again lets no exception pass: what follows runs only if the whole body did.
        catching = [handler for handler in node.handlers if not always_raises(handler.body)]
        caught = "under `try`" if catching else None
        if any(isinstance(inner, ast.Return) for part in node.finalbody for inner in (part, *own_nodes(part))):
            caught = "under a `try` whose `finally` returns"
        body = self.statements(node.body, why or caught)
        ways = []
        for handler in node.handlers:
            way = self.statements(handler.body, why or "under `except`")
            if handler in catching:
                ways.append(way)
        after = "in the `else` of a `try`" if caught else "after a possible return" if body else None
        ways.append(self.statements(node.orelse, why or after))
        final = self.statements(node.finalbody, why)
        if LEAVES in (final, body) and (final == LEAVES or not catching):
            return LEAVES
        return MAY_LEAVE if any((body, final, *ways)) else STAYS

    def _with(self, node: ast.With | ast.AsyncWith, why: str | None) -> int:
        inside = why
        for item in node.items:
            self.expression(item.context_expr, why)
            if self.suppresses(item.context_expr):
                inside = inside or "under `suppress`"
        leaves = self.statements(node.body, inside)
        return MAY_LEAVE if leaves == LEAVES and inside != why else leaves

    def _assignment(self, node: ast.Assign | ast.AnnAssign, why: str | None) -> None:
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        value = node.value
        named = all(isinstance(part, ast.Name) for target in targets for part in _elements(target))
        for part in _elements(value) if value is not None else ():
            # A function under another name is followed where that name is called.
            if not (named and isinstance(part, (ast.Name, ast.Attribute))):
                self.expression(part, why)
        for target in targets:
            self.expression(target, why)

    # Expressions ----------------------------------------------------------------------------------------

    def part(self, node: ast.AST, why: str | None, awaited: bool = False) -> None:
        """An expression, or what holds expressions, such as a keyword argument."""
        if isinstance(node, ast.expr):
            self.expression(node, why, awaited)
        else:
            for inner in ast.iter_child_nodes(node):
                self.part(inner, why)

    def expression(self, node: ast.expr, why: str | None, awaited: bool = False) -> None:
        if isinstance(node, ast.Call):
            self._call(node, why, awaited)
        elif isinstance(node, ast.Await):
            self.expression(node.value, why, awaited=True)
        elif isinstance(node, ast.Lambda):
            with self.within(node):
                self.expression(node.body, why or "in a lambda")
        elif isinstance(node, (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)):
            self.expression(node.generators[0].iter, why)
            with self.within(node):
                for part in ast.iter_child_nodes(node):
                    for inner in ast.iter_child_nodes(part) if isinstance(part, ast.comprehension) else (part,):
                        if inner is not node.generators[0].iter:
                            self.part(inner, why or "in a comprehension")
        elif isinstance(node, ast.BoolOp):
            self.expression(node.values[0], why)
            word = "and" if isinstance(node.op, ast.And) else "or"
            for value in node.values[1:]:
                self.expression(value, why or f"after `{word}`")
        elif isinstance(node, ast.IfExp):
            self.expression(node.test, why)
            for value in (node.body, node.orelse):
                self.expression(value, why or "under `if`")
        else:
            if isinstance(node, (ast.Name, ast.Attribute)) and isinstance(node.ctx, ast.Load):
                self.reference(node)
            for part in ast.iter_child_nodes(node):
                self.part(part, why)

    def _call(self, node: ast.Call, why: str | None, awaited: bool) -> None:
        if isinstance(node.func, ast.Attribute):
            self.expression(node.func.value, why)
        elif not isinstance(node.func, ast.Name):
            self.expression(node.func, why)
        followed = self.follows(node)
        outside = self.outside(node.func)
        gathered = awaited and outside in _GATHERERS
        inside = why or ("one of those in `gather()`, which has no order" if gathered else None)
        passed_on = gathered or outside in _RUNNERS or (awaited and outside in _AWAITERS)
        for argument in (*node.args, *(keyword.value for keyword in node.keywords)):
            if not (followed and isinstance(argument, (ast.Name, ast.Attribute))):
                self.expression(argument, inside, passed_on)
        self.call(node, why, awaited)


def _elements(node: ast.expr) -> list[ast.expr]:
    return node.elts if isinstance(node, ast.Tuple) else [node]
