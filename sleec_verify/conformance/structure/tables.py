"""``implement``: callables for obligations, from which rules without a method are put together."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from sleec_runtime.model import Rule
from sleec_runtime.support.suggestions import nearest
from sleec_verify.conformance.structure.alternatives import alternative_obligations
from sleec_verify.conformance.structure.methods import Method
from sleec_verify.conformance.structure.names import Names
from sleec_verify.conformance.structure.program import Class, Function, Scope
from sleec_verify.conformance.structure.report import Findings
from sleec_verify.conformance.structure.resolve import Resolver, maybe_runtime
from sleec_verify.conformance.structure.target import PythonFile
from sleec_verify.conformance.structure.values import Api, Code, Module, Object, Runtime, Table, Text, Value
from sleec_verify.results.finding import ClauseRef
from sleec_verify.wording.phrases import listed

if TYPE_CHECKING:
    from sleec_verify.conformance.structure.uses import Use


@dataclass
class Tables:
    """All that the target gives to `implement`. `allowed` maps the nodes of an entry's callable to its obligation;
    `robots` are the classes, `modules` the modules, whose members implement. `callables` are the functions, and the
    names of what is outside, that entries are, with their obligations; `attributes` the same for attributes of which
    nothing more is known, by the attribute's name and with what they are attributes of. `missing` are the obligations
    that are reported as having no callable."""

    resolver: Resolver
    names: Names
    findings: Findings
    given: dict[str, ast.AST] = field(default_factory=dict)
    calls: list[tuple[Scope, ast.Call]] = field(default_factory=list)
    allowed: dict[ast.AST, str] = field(default_factory=dict)
    robots: set[Class] = field(default_factory=set)
    modules: set[Scope] = field(default_factory=set)
    callables: dict[Function | str, set[str]] = field(default_factory=dict)
    attributes: dict[str, list[tuple[Value, str]]] = field(default_factory=dict)
    undecided: bool = False
    missing: set[str] = field(default_factory=set)

    def read(self, use: Use) -> None:
        """Takes note of a call of `implement`, or of `replace` with one."""
        node = use.node
        if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
            return
        targets: list[ast.expr] = []
        if node.func.attr == "implement":
            targets = [*node.args[:1], *(k.value for k in node.keywords if k.arg == "target")]
        elif node.func.attr == "replace":
            targets = [k.value for k in node.keywords if k.arg == "implement"]
        owner = self.resolver.of(node.func.value, use.scope)
        if not targets or not (isinstance(owner, Runtime) or maybe_runtime(owner)):
            return
        self.calls.append((use.scope, node))
        self._target(targets[0], use.scope)

    def _target(self, node: ast.expr, scope: Scope) -> None:
        value = self.resolver.of(node, scope)
        if isinstance(value, Table):
            if isinstance(node, ast.Name) and _changed(value, node.id):
                self._unknown(node, scope, "entries are added to this table one by one")
            self._table(value)
        elif isinstance(value, Object):
            self._object(node, scope, value)
        elif isinstance(value, Module):
            self.modules.add(value.scope)
            self._members(self._functions(value.scope), value.scope.node)
        else:
            self._unknown(node, scope, "the obligations that this implements are known only at run time")

    def _unknown(self, node: ast.AST, scope: Scope, why: str) -> None:
        self.undecided = True
        self.findings.undecided(scope.file, node, why)

    def _table(self, table: Table) -> None:
        for key, value in _entries(table.node):
            if key is None:
                merged = self.resolver.of(value, table.scope)
                if isinstance(merged, Table):
                    self._table(merged)
                else:
                    self._unknown(value, table.scope, "the obligations that this adds are known only at run time")
                continue
            name = Text(key) if isinstance(key, str) else self.resolver.of(key, table.scope)
            if not isinstance(name, Text):
                assert isinstance(key, ast.expr), "a key that is not a string is an expression"
                self._unknown(key, table.scope, "the obligation of this entry is known only at run time")
                continue
            self._entry(name.value, key if isinstance(key, ast.expr) else value, value, table.scope)

    def _entry(self, name: str, at: ast.expr, value: ast.expr, scope: Scope) -> None:
        if name not in self.names.obligations:
            near = nearest(name, sorted(self.names.obligations))
            hint = f"did you mean `{near}`?" if near else f"the rules have {listed(sorted(self.names.obligations))}"
            self.findings.add(
                "unknown-obligation", f"the rules have no obligation called `{name}`", (scope.file, at), help=hint
            )
            return
        if isinstance(value, ast.Constant):
            message = f"{ast.unparse(value)} is not callable, but {name} needs a callable"
            self.findings.add("missing-callable", message, (scope.file, value), obligations=(name,))
        self.given[name] = at
        for inner in ast.walk(value):
            self.allowed[inner] = name
        self._callable(name, value, scope)

    def _callable(self, name: str, node: ast.expr, scope: Scope) -> None:
        value = self.resolver.of(node, scope)
        if isinstance(value, Code):
            for function in value.definitions:
                self.callables.setdefault(function, set()).add(name)
        elif isinstance(value, Api):
            if not value.standard:
                self.callables.setdefault(value.name, set()).add(name)
        elif isinstance(node, ast.Attribute):
            self.attributes.setdefault(node.attr, []).append((self.resolver.of(node.value, scope), name))

    def one(self, what: Function | str) -> str | None:
        """The obligation that a callable is given for; None if it is given for none, or for several, as what only says
        something is."""
        names = self.callables.get(what, set())
        return next(iter(names)) if len(names) == 1 else None

    def _object(self, node: ast.expr, scope: Scope, value: Object) -> None:
        order, open_ = self.resolver.order(value.class_)
        self.robots.update(order)
        functions = [function for class_ in order for function in self._functions(class_.inner)]
        self._members(functions, node)
        names = {name for class_ in order for name in (*class_.inner.bindings, *class_.attributes)}
        for name in names & set(self.names.by_method):
            for obligation in self.names.by_method[name]:
                self.given.setdefault(obligation, node)
        if open_ and set(self.names.obligations) - set(self.given):
            self._unknown(node, scope, "it inherits from a class outside the target, which may implement more")

    def _members(self, functions: list[Function], at: ast.AST) -> None:
        for function in functions:
            name = self.names.of(function)
            if name is not None and name in self.names.obligations:
                self.given.setdefault(name, at)

    @staticmethod
    def _functions(scope: Scope) -> list[Function]:
        return [one for bindings in scope.bindings.values() for one in bindings if isinstance(one, Function)]

    # What is missing ------------------------------------------------------------------------------------

    def check(self, rules: list[Rule]) -> list[Rule]:
        """Reports the obligations of rules without a method that have no callable; returns the rules that no table is
        for either."""
        if not self.calls:
            return rules
        if self.undecided:
            return []
        missing: dict[str, list[str]] = {}
        for rule in rules:
            for clause in rule.clauses():
                for literal in clause.obligations:
                    if not literal.negated and literal.name not in self.given:
                        missing.setdefault(literal.name, []).append(rule.label)
        scope, call = self.calls[-1]
        for name, labels in missing.items():
            labels = list(dict.fromkeys(labels))
            self.missing.add(name)
            self.findings.add(
                "missing-callable",
                f"{name} has no callable, but {listed(labels)} {'needs' if len(labels) == 1 else 'need'} it",
                (scope.file, call.func),
                rules=tuple(labels),
                obligations=(name,),
                help=f"add one: implement({{{name!r}: …}})",
            )
        return []

    def check_alternatives(self, rule: Rule, method: Method | None) -> None:
        """Reports the obligations of alternatives of a rule that have no callable, also if the rule has a method."""
        if self.undecided or not (self.calls or method):
            return
        if self.calls:
            scope, call = self.calls[-1]
            at: tuple[PythonFile, ast.AST] = (scope.file, call.func)
        elif method:
            function = method.variants[0].function
            at = (function.file, function.node)
        for name, number, branch in alternative_obligations(rule):
            if name not in self.given and name not in self.missing:
                self.findings.add(
                    "missing-callable",
                    f"{name} has no callable, but {branch} in {rule.label} requires it",
                    at,
                    clause=ClauseRef(rule.label, number),
                    obligations=(name,),
                    note=self.findings.obliged(rule, number),
                    help=f"add one: implement({{{name!r}: …}}); alternatives have no variants",
                )


def _entries(node: ast.Dict | ast.Call) -> Iterator[tuple[ast.expr | str | None, ast.expr]]:
    """The keys and values. The key None means that the value is a whole table."""
    if isinstance(node, ast.Dict):
        yield from zip(node.keys, node.values)
        return
    for argument in node.args:
        yield None, argument
    for keyword in node.keywords:
        yield keyword.arg, keyword.value


def _changed(table: Table, name: str) -> bool:
    """Whether something is stored into a table after it was written out."""
    return any(
        (isinstance(node, ast.Subscript) and isinstance(node.ctx, (ast.Store, ast.Del)) and _is(node.value, name))
        or (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and _is(node.func.value, name))
        for node in ast.walk(table.scope.node)
    )


def _is(node: ast.expr, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name
