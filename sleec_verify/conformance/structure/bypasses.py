"""Code outside the variants that executes obligations, calls the methods of rules, or activates layers."""

from __future__ import annotations

import ast
from collections.abc import Collection
from dataclasses import dataclass

from sleec_verify.conformance.structure.abstract_execution import REPLACERS, AbstractExecutor
from sleec_verify.conformance.structure.methods import Group, Method
from sleec_verify.conformance.structure.names import Names
from sleec_verify.conformance.structure.program import Class, Function, Scope
from sleec_verify.conformance.structure.prohibitions import LastingProhibitions
from sleec_verify.conformance.structure.report import Findings
from sleec_verify.conformance.structure.resolve import ADVICE, Resolver
from sleec_verify.conformance.structure.tables import Tables
from sleec_verify.conformance.structure.uses import Use
from sleec_verify.conformance.structure.values import (
    Advice,
    Api,
    ClassOf,
    Code,
    ForeignValue,
    Layer,
    Object,
    OwnLayer,
    RuleMark,
    UnknownValue,
    Value,
)
from sleec_verify.wording.phrases import listed

_ACTIVATORS = {
    f"contextpy3.{name}"
    for name in ("active_layer", "active_layers", "inactive_layer", "inactive_layers", "global_activate_layer",
                 "global_deactivate_layer")
}  # fmt: skip
_CALLERS = {
    "threading.Thread", "threading.Timer", "asyncio.to_thread", "signal.signal", "atexit.register",
    "_thread.start_new_thread", "multiprocessing.Process",
}  # fmt: skip
"""What calls the functions that it is given, whatever the rules say."""
_CODE_AS_IT_RUNS = {"builtins.exec", "builtins.eval", "builtins.compile", "builtins.__import__"}


@dataclass
class BypassCheck:
    """Checks every expression outside the variants, after the variants have been followed."""

    resolver: Resolver
    names: Names
    findings: Findings
    tracer: AbstractExecutor
    tables: Tables
    methods: list[Method]
    layers: Collection[str]
    globally: bool
    """Whether the target activates layers by `activate_globally`: then methods are there to be called."""
    prohibitions: LastingProhibitions

    def __post_init__(self) -> None:
        groups = {group for method in self.methods for group in method.groups}
        self._group_of: dict[Function, Group] = {v.function: group for group in groups for v in group.written}
        self._marked = {group for method in self.methods if method.marks for group in method.groups}
        self._method_names = {group.name for group in self._marked}
        self._handed_on: set[ast.expr] = set()
        self._robots: set[Class] = set(self.tables.robots)
        self._modules: set[Scope] = set(self.tables.modules)
        for method in self.methods:
            if method.class_ is not None:
                self._robots.update(self.resolver.order(method.class_)[0])
            else:
                self._modules.add(method.groups[0].scope)
        self._elsewhere: frozenset[str] = frozenset()
        """Acts that rules forbid for a time, and that the robot does not implement itself: all code with their names
        counts."""
        implemented = (self._implemented(function) for function in self.resolver.program.functions)
        self._implementations = {name for name in implemented if name is not None} | self.tracer.by_name
        self._elsewhere = self.prohibitions.acts - self._implementations

    def look(self, use: Use) -> None:
        """Reports an expression that bypasses the dispatch."""
        if isinstance(use.node, ast.Call):
            self._call(use, use.node)
            self._applied(use, use.node)
        elif isinstance(use.node, (ast.Name, ast.Attribute)):
            if isinstance(use.node.ctx, ast.Load):
                self._reference(use, use.node)
            elif isinstance(use.node, ast.Attribute):
                self._stored(use, use.node)

    # Calls ----------------------------------------------------------------------------------------------

    def _call(self, use: Use, node: ast.Call) -> None:
        value = self.resolver.of(node.func, use.scope)
        if isinstance(value, Code):
            self._code(use, node, value)
        elif isinstance(value, Api):
            self._api(use, node, value)
            self._outside(use, node, value)
            if isinstance(node.func, ast.Attribute):
                self._unresolved(use, node.func)  # an attribute of the robot may hold it
        elif isinstance(node.func, ast.Attribute) and node.func.attr in self.tables.attributes:
            self._in_table(use, node.func)
        elif isinstance(value, UnknownValue) and isinstance(node.func, ast.Attribute):
            self._unresolved(use, node.func)
        elif isinstance(value, UnknownValue) and isinstance(node.func, ast.Name):
            self._perhaps(use, node.func, self.names.called(node.func.id))

    def _applied(self, use: Use, node: ast.Call) -> None:
        """A decorator that is made here, and put to use otherwise than above a definition."""
        if isinstance(self.resolver.of(node, use.scope), (Advice, RuleMark)) and not isinstance(
            use.parent, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Assign)
        ):
            self._handmade(use)

    def _handmade(self, use: Use) -> None:
        why = "a decorator that is called as a function creates methods at run time"
        self.findings.undecided(use.scope.file, use.node, why)

    def _code(self, use: Use, node: ast.Call, value: Code) -> None:
        for function in value.definitions:
            group = self._group_of.get(function)
            if group is not None and group in self._marked:
                if not self.globally and not self._is_super(use, node):
                    self.findings.add(
                        "method-around",
                        f"{group.name} is the method of a rule, but is called here without a trigger",
                        (use.scope.file, node),
                        help="call sleec.trigger(…)",
                    )
                return
        reached: set[str] = set()
        for function in value.definitions:
            name = self._implemented(function)
            reached |= {name} if name is not None else self.tracer.followed.get(function, set())
        if not reached:
            self._perhaps(use, node.func, self.names.called(value.definitions[0].name))
        self._obligations(use, node, sorted(name for name in reached if not self._may_execute(use, name)))

    def _outside(self, use: Use, node: ast.Call, value: Api) -> None:
        """A call of code outside the target."""
        name = self.tables.one(value.name)
        if name is None:
            self._perhaps(use, node.func, self.names.called_outside(value, node.func))
        elif not self._may_execute(use, name):
            self._obligations(use, node, [name])
        if value.name in _CALLERS:
            for argument in (*node.args, *(keyword.value for keyword in node.keywords)):
                self._handed_to_caller(use._replace(node=argument), argument)

    def _perhaps(self, use: Use, node: ast.expr, name: str | None) -> None:
        """Code with the name of an act that a rule forbids for a time: it may implement the act."""
        if name is not None and name in self.prohibitions and not self._may_execute(use, name):
            why = f"this executes {name} outside the dispatch if {ast.unparse(node)} implements it"
            self.findings.undecided(use.scope.file, node, why)

    def _obligations(self, use: Use, node: ast.AST, names: list[str]) -> None:
        for name in names:
            if name not in self.prohibitions.required and name in self.prohibitions:
                self.prohibitions.report(name, node, use)
        names = [name for name in names if name in self.prohibitions.required or name not in self.prohibitions]
        if names:
            verb, it = ("is", "it") if len(names) == 1 else ("are", "them")
            self.findings.add(
                "obligation-around",
                f"{listed(names)} {verb} executed here whatever the rules say: this is not a variant of a rule",
                (use.scope.file, node),
                obligations=tuple(names),
                note=self.prohibitions.note(names),
                help=f"trigger the rule that requires {it}",
            )

    def _in_table(self, use: Use, func: ast.Attribute) -> None:
        """An attribute of the name of one that a table gives, both of them of objects of which little is known."""
        receiver = self.resolver.of(func.value, use.scope)
        for held, name in self.tables.attributes[func.attr]:
            if self._may_execute(use, name):
                continue
            if isinstance(receiver, Object) and isinstance(held, Object):
                if set(self.resolver.order(receiver.class_)[0]) & set(self.resolver.order(held.class_)[0]):
                    self._obligations(use, func, [name])
            elif not isinstance(receiver, Object) and not isinstance(held, Object):
                why = f"this executes {name} outside the dispatch if {ast.unparse(func.value)} implements it"
                self.findings.undecided(use.scope.file, func, why)

    def _unresolved(self, use: Use, func: ast.Attribute) -> None:
        name = self.names.called(func.attr)
        receiver = self.resolver.of(func.value, use.scope)
        if isinstance(receiver, Object) and self._is_robot(receiver):
            if name is not None and name in self.tracer.by_name | self._elsewhere and not self._may_execute(use, name):
                self._obligations(use, func, [name])
            return
        if isinstance(receiver, (Object, ClassOf)) or (isinstance(receiver, ForeignValue) and not receiver.standard):
            self._perhaps(use, func, name)
        if not isinstance(receiver, UnknownValue):
            return
        known = self._implementations | self._elsewhere
        if name is not None and name in known and not self._may_execute(use, name):
            why = f"this executes {name} outside the dispatch if {ast.unparse(func.value)} implements it"
            self.findings.undecided(use.scope.file, func, why)
        elif func.attr in self._method_names and not self.globally and not self._within_variant(use):
            why = f"this calls a rule's method without a trigger if {ast.unparse(func.value)} is the robot"
            self.findings.undecided(use.scope.file, func, why)

    def _api(self, use: Use, node: ast.Call, value: Api) -> None:
        file = use.scope.file
        if value.name in _ACTIVATORS:
            self._activation(use, node)
        elif value.name == "contextpy3.base":
            self._handmade(use)
        elif self._followed(use):
            return  # reported where the variant is followed
        elif value.name in _CODE_AS_IT_RUNS or (value.name in REPLACERS and isinstance(use.parent, ast.Subscript)):
            self.findings.undecided(file, node, "this generates code or binds names at run time")
        elif value.name in ("builtins.setattr", "builtins.delattr") and len(node.args) > 1:
            name = self.resolver.of(node.args[1], use.scope)
            text = getattr(name, "value", None)
            if text is None or text in self._method_names or self._replaces(text):
                self.findings.undecided(file, node, f"{value.name.removeprefix('builtins.')} may replace a method here")
        elif value.name == "builtins.getattr" and len(node.args) > 1:
            receiver = self.resolver.of(node.args[0], use.scope)
            name = self.resolver.of(node.args[1], use.scope)
            if isinstance(name, UnknownValue) and self._is_robot(receiver):
                self.findings.undecided(file, node, "the name of the attribute is known only at run time")

    def _activation(self, use: Use, node: ast.Call) -> None:
        for argument in node.args:
            inner = argument.value if isinstance(argument, ast.Starred) else argument
            value = self.resolver.layer(inner, use.scope)
            if isinstance(value, Layer) and value.name in self.layers:
                self.findings.add(
                    "layer-by-hand",
                    f"{value.name} is a layer of a rule, but is activated or deactivated here by the code",
                    (use.scope.file, node),
                    help="use update() and trigger(), or activate_globally()",
                )
            elif not isinstance(value, (OwnLayer, Layer)):
                why = "this activates or deactivates a layer that is known only at run time"
                self.findings.undecided(use.scope.file, node, why)

    # Other uses -----------------------------------------------------------------------------------------

    def _reference(self, use: Use, node: ast.Name | ast.Attribute) -> None:
        """A method, an implementation or an advice that is spoken of without being called."""
        if self._is_mere_name(use, node):
            return
        value = self.resolver.of(node, use.scope)
        if isinstance(value, (Advice, RuleMark)) or (isinstance(value, Api) and value.name in ADVICE):
            self._handmade(use)
        if isinstance(value, UnknownValue) and isinstance(node, ast.Attribute):
            self._perhaps(use, node, self.names.called(node.attr))
        elif isinstance(value, Api):
            self._perhaps(use, node, self.names.called_outside(value, node))
        if not isinstance(value, Code) or node in self._handed_on:
            return
        for function in value.definitions[:1]:
            group = self._group_of.get(function)
            if group is not None and group in self._marked:
                if not self.globally and value.receiver is not None:
                    self.findings.add(
                        "method-around",
                        f"{group.name} is the method of a rule, but is passed on here to be called without a trigger",
                        (use.scope.file, node),
                        help="pass on a function that calls sleec.trigger(…)",
                    )
                return
            name = self._implemented(function)
            if name is None:
                self._perhaps(use, node, self.names.called(function.name))
            elif not self._may_execute(use, name):
                why = f"the implementation of {name} is passed on here, and may be called outside the dispatch"
                self.findings.undecided(use.scope.file, node, why)

    def _handed_to_caller(self, use: Use, node: ast.expr) -> None:
        """An act that rules forbid for a time, handed to what calls it later."""
        value = self.resolver.of(node, use.scope)
        for function in value.definitions[:1] if isinstance(value, Code) else ():
            name = self._implemented(function)
            if name is not None and name in self.prohibitions and not self._may_execute(use, name):
                self._handed_on.add(node)
                self._obligations(use, node, [name])

    @staticmethod
    def _is_mere_name(use: Use, node: ast.expr) -> bool:
        """Whether an expression is called, looked into, named or put above a definition: none hands it on."""
        parent = use.parent
        if isinstance(parent, ast.Call):
            return parent.func is node
        if isinstance(parent, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            return True
        if isinstance(parent, ast.Assign):
            return all(isinstance(target, ast.Name) for target in parent.targets)
        return isinstance(parent, (ast.Attribute, ast.Compare, ast.Expr))

    def _stored(self, use: Use, node: ast.Attribute) -> None:
        """A method of the robot that is replaced by an assignment to its attribute."""
        receiver = self.resolver.of(node.value, use.scope)
        of_robot = isinstance(receiver, UnknownValue) or getattr(receiver, "class_", None) in self._robots
        if of_robot and (node.attr in self._method_names or self._replaces(node.attr)):
            self.findings.undecided(use.scope.file, node, f"{node.attr} is replaced here at run time")

    def _replaces(self, attribute: str) -> bool:
        """Whether a robot has an implementation of that name in its class."""
        return self.names.called(attribute) is not None and any(
            attribute in class_.inner.bindings for class_ in self._robots
        )

    # Who may execute what -------------------------------------------------------------------------------

    def _implemented(self, function: Function) -> str | None:
        """The obligation that a function of the target implements, if it is known for that."""
        name = self.names.of(function)
        if name is None or name not in self.names.obligations:
            return self.tables.one(function)
        known = (
            self.names.mark(function) is not None
            or function in self.tracer.implementations
            or (function.owner is not None and function.owner in self._robots)
            or (function.owner is None and function.scope in self._modules)
            or name in self._elsewhere
        )
        return name if known else self.tables.one(function)

    def _may_execute(self, use: Use, obligation: str) -> bool:
        """Whether an expression stands in a variant, in what a variant calls, or in an implementation of the same
        obligation."""
        if self.tables.allowed.get(use.node) == obligation:
            return True
        around = _functions_around(use.scope)
        return self._followed(use) or any(
            obligation in (self.names.of(function), *self.tables.callables.get(function, ())) for function in around
        )

    def _followed(self, use: Use) -> bool:
        """Whether an expression stands in a variant, or in what a variant calls."""
        around = _functions_around(use.scope)
        return any(function in self._group_of or function in self.tracer.followed for function in around)

    def _is_robot(self, value: Value) -> bool:
        return isinstance(value, Object) and value.class_ in self._robots

    def _within_variant(self, use: Use) -> bool:
        return any(function in self._group_of for function in _functions_around(use.scope))

    def _is_super(self, use: Use, node: ast.Call) -> bool:
        receiver: Value = (
            self.resolver.of(node.func.value, use.scope) if isinstance(node.func, ast.Attribute) else UnknownValue()
        )
        return isinstance(receiver, Object) and receiver.after is not None and self._within_variant(use)


def _functions_around(scope: Scope) -> list[Function]:
    found: list[Function] = []
    inner: Scope | None = scope
    while inner is not None:
        if inner.function is not None:
            found.append(inner.function)
        inner = inner.outer
    return found
