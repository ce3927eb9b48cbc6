"""The scopes, classes and functions of the target, before any analysis of their meaning."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple, TypeGuard, Union

from sleec_verify.conformance.structure.target import PythonFile

Def = Union[ast.FunctionDef, ast.AsyncFunctionDef]
DEFS = (ast.FunctionDef, ast.AsyncFunctionDef)


class Assignment(NamedTuple):
    """A name that is bound to the value of an expression. With `annotation`, it is bound to an object of the annotated
    class."""

    value: ast.expr
    annotation: bool = False


class Import(NamedTuple):
    """A name bound by an import: of `module`, or of `attribute` in it. `level` counts the dots of a relative one."""

    module: str
    attribute: str | None
    level: int


class Opaque(NamedTuple):
    """A name bound in a way that is not followed: a loop's variable, an exception, a pattern, an update in place."""

    node: ast.AST


@dataclass(eq=False, repr=False)
class Scope:
    """A module, class or function body, with what its names are bound to."""

    file: PythonFile
    node: ast.AST
    outer: Scope | None
    bindings: dict[str, list[Binding]] = field(default_factory=dict)
    stars: list[Import] = field(default_factory=list)
    class_: Class | None = None
    function: Function | None = None

    def bind(self, name: str, binding: Binding) -> None:
        self.bindings.setdefault(name, []).append(binding)

    @property
    def module(self) -> Scope:
        return self if self.outer is None else self.outer.module


@dataclass(eq=False, repr=False)
class Function:
    """One `def`. `owner` is the class whose body it stands in; `certain` is False for one defined under a condition."""

    node: Def
    scope: Scope
    inner: Scope
    certain: bool

    @property
    def name(self) -> str:
        return self.node.name

    @property
    def owner(self) -> Class | None:
        return self.scope.class_

    @property
    def file(self) -> PythonFile:
        return self.scope.file

    @property
    def parameters(self) -> list[ast.arg]:
        arguments = self.node.args
        return [*arguments.posonlyargs, *arguments.args]


@dataclass(eq=False, repr=False)
class Class:
    """One `class`. `attributes` are the values that its methods assign to attributes of `self`, by name."""

    node: ast.ClassDef
    scope: Scope
    inner: Scope
    attributes: dict[str, list[tuple[Assignment | None, Scope]]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        return self.node.name


Binding = Union[Assignment, Import, Opaque, Function, Class]


class TargetProgram:
    """All files of a target."""

    def __init__(self, files: tuple[PythonFile, ...]) -> None:
        self.files = files
        self.functions: list[Function] = []
        self.classes: list[Class] = []
        self.scope_of: dict[ast.AST, Scope] = {}
        self.modules = [self._module(file) for file in files]

    def _module(self, file: PythonFile) -> Scope:
        scope = Scope(file, file.tree, None)
        self.scope_of[file.tree] = scope
        _Collector(self, scope).block(file.tree.body, certain=True)
        return scope

    def module_named(self, name: str, level: int, importer: PythonFile) -> Scope | None:
        """The module of the target that `import name` means in `importer`, if it is one of the target's."""
        wanted = tuple(name.split(".")) if name else ()
        home = importer.parts if _is_package(importer) else importer.parts[:-1]
        if level:
            exact = (*home[: len(home) - level + 1], *wanted)
            return next((module for module in self.modules if module.file.parts == exact), None)
        beside = next((module for module in self.modules if module.file.parts == (*home, *wanted)), None)
        if beside is not None or wanted[0] in sys.stdlib_module_names or wanted[0] in _APIS:
            return None if wanted[0] in _APIS else beside
        packages = {module.file.parts for module in self.modules if _is_package(module.file)}
        ending = [
            module
            for module in self.modules
            if module.file.parts[-len(wanted) :] == wanted and module.file.parts[: -len(wanted)] not in packages
        ]
        return ending[0] if len(ending) == 1 else None


_APIS = ("sleec_runtime", "contextpy3")


def _is_package(file: PythonFile) -> bool:
    return file.source.path.endswith("__init__.py")


class _Collector:
    """Visits a body and records its bindings."""

    def __init__(self, program: TargetProgram, scope: Scope) -> None:
        self.program = program
        self.scope = scope
        self.outward: set[str] = set()

    def block(self, statements: list[ast.stmt], certain: bool) -> None:
        for statement in statements:
            self.statement(statement, certain)

    def statement(self, node: ast.stmt, certain: bool) -> None:
        if isinstance(node, DEFS):
            self._function(node, certain)
        elif isinstance(node, ast.ClassDef):
            self._class(node)
        elif isinstance(node, (ast.Global, ast.Nonlocal)):
            self.outward.update(node.names)
        elif isinstance(node, ast.Import):
            for alias in node.names:
                whole = alias.name if alias.asname else alias.name.partition(".")[0]
                self._bind(alias.asname or whole, Import(whole, None, 0))
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                imported = Import(node.module or "", alias.name, node.level)
                if alias.name == "*":
                    self.scope.stars.append(imported)
                else:
                    self._bind(alias.asname or alias.name, imported)
        elif isinstance(node, ast.Assign):
            for target in node.targets:
                self._target(target, node.value)
            self._expressions(node.value)
        elif isinstance(node, ast.AnnAssign):
            self._target(node.target, node.value or node.annotation, annotation=node.value is None)
            if node.value is not None:
                self._expressions(node.value)
        else:
            self._other(node, certain)

    def _other(self, node: ast.stmt, certain: bool) -> None:
        """A statement whose own bindings are not followed. The statements in it are conditional."""
        if isinstance(node, (ast.For, ast.AsyncFor, ast.AugAssign)):
            self._target(node.target, None)
        elif isinstance(node, (ast.With, ast.AsyncWith)):
            for item in node.items:
                if item.optional_vars is not None:
                    self._target(item.optional_vars, None)
        # What a `with` holds is run as if it stood outside.
        certain = certain and isinstance(node, (ast.With, ast.AsyncWith))
        for child in ast.iter_child_nodes(node):
            self._nested(child, certain)

    def _nested(self, node: ast.AST, certain: bool) -> None:
        if isinstance(node, ast.stmt):
            self.statement(node, certain)
        elif isinstance(node, ast.expr):
            self._expressions(node)
        else:
            name = getattr(node, "name", None) or getattr(node, "rest", None)
            if isinstance(node, (ast.ExceptHandler, ast.MatchAs, ast.MatchStar, ast.MatchMapping)) and name:
                self._bind(name, Opaque(node))
            for child in ast.iter_child_nodes(node):
                self._nested(child, certain)

    def _expressions(self, node: ast.expr) -> None:
        """Names bound within an expression, and the scopes of its lambdas and comprehensions."""
        if isinstance(node, ast.NamedExpr):
            self._target(node.target, node.value)
        if isinstance(node, ast.Lambda):
            scope = self._inner(node)
            for arg in _all_arguments(node.args):
                scope.bind(arg.arg, Opaque(arg))
            _Collector(self.program, scope)._expressions(node.body)
            return
        collector = self
        if isinstance(node, (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)):
            collector = _Collector(self.program, self._inner(node))
            for generator in node.generators:
                collector._target(generator.target, None)
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.expr):
                collector._expressions(child)
            else:
                for expression in ast.iter_child_nodes(child):
                    if isinstance(expression, ast.expr):
                        collector._expressions(expression)

    def _inner(self, node: ast.AST) -> Scope:
        scope = Scope(self.scope.file, node, self.scope, function=self.scope.function)
        self.program.scope_of[node] = scope
        return scope

    def _function(self, node: Def, certain: bool) -> None:
        inner = self._inner(node)
        function = inner.function = Function(node, self.scope, inner, certain)
        self.program.functions.append(function)
        self._bind(node.name, function)
        for expression in (*node.decorator_list, *node.args.defaults, *filter(None, node.args.kw_defaults)):
            self._expressions(expression)
        for arg in _all_arguments(node.args):
            inner.bind(arg.arg, Assignment(arg.annotation, annotation=True) if arg.annotation else Opaque(arg))
        _Collector(self.program, inner).block(node.body, certain=True)

    def _class(self, node: ast.ClassDef) -> None:
        inner = Scope(self.scope.file, node, self.scope)
        self.program.scope_of[node] = inner
        class_ = inner.class_ = Class(node, self.scope, inner)
        self.program.classes.append(class_)
        self._bind(node.name, class_)
        _Collector(self.program, inner).block(node.body, certain=True)
        for method in own_methods(class_):
            _note_attributes(class_, method)

    def _bind(self, name: str, binding: Binding) -> None:
        scope = self.scope
        if name in self.outward:
            scope = scope.module
        scope.bind(name, binding)

    def _target(self, target: ast.expr, value: ast.expr | None, annotation: bool = False) -> None:
        if isinstance(target, ast.Name):
            self._bind(target.id, Opaque(target) if value is None else Assignment(value, annotation))
        elif isinstance(target, (ast.Tuple, ast.List)):
            values = value.elts if isinstance(value, (ast.Tuple, ast.List)) else []
            plain = len(values) == len(target.elts) and not any(isinstance(e, ast.Starred) for e in values)
            for place, element in enumerate(target.elts):
                self._target(element, values[place] if plain else None)
        elif isinstance(target, ast.Starred):
            self._target(target.value, None)


def _all_arguments(arguments: ast.arguments) -> Iterator[ast.arg]:
    yield from (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)
    yield from filter(None, (arguments.vararg, arguments.kwarg))


def own_methods(class_: Class) -> Iterator[Function]:
    """Every `def` in the body of a class, in the order of the text for each name."""
    for bindings in class_.inner.bindings.values():
        yield from (binding for binding in bindings if isinstance(binding, Function))


def _note_attributes(class_: Class, method: Function) -> None:
    """`self.arm = Arm()` and `self.arm: Arm` in a method say what the attribute is."""
    if not method.parameters:
        return
    for node in ast.walk(method.node):
        assigned: Assignment | None = None
        targets: list[ast.expr] = []
        if isinstance(node, ast.Assign):
            targets, assigned = node.targets, Assignment(node.value)
        elif isinstance(node, ast.AnnAssign):
            targets, assigned = [node.target], Assignment(node.value or node.annotation, annotation=node.value is None)
        elif isinstance(node, ast.AugAssign):
            targets = [node.target]
        for target in targets:
            if is_attribute_of(target, method.parameters[0].arg):
                class_.attributes.setdefault(target.attr, []).append((assigned, method.inner))


def is_attribute_of(node: ast.expr, name: str) -> TypeGuard[ast.Attribute]:
    """Whether an expression is ``name.something``."""
    return isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == name
