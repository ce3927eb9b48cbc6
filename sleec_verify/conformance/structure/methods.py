"""The layered methods of the target: which variants a name has, on which layers, and whose rules' methods they are."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field

from sleec_verify.conformance.structure.program import Class, Function, Scope, TargetProgram
from sleec_verify.conformance.structure.resolve import ADVICE, Resolver
from sleec_verify.conformance.structure.values import (
    Advice,
    Api,
    Kind,
    Layer,
    ObligationMark,
    OwnLayer,
    RuleMark,
    Value,
)

HARMLESS = {
    f"{module}.{name}"
    for module, names in {
        "builtins": ("staticmethod", "classmethod"),
        "abc": ("abstractmethod",),
        "typing": ("override", "final", "no_type_check"),
        "typing_extensions": ("override", "final"),
    }.items()
    for name in names
}
"""Decorators that do not replace the function."""


@dataclass(eq=False)
class Variant:
    """One `def` of a layered method. `layer` is None for the base, and `at` what says so in the text.

    `bare`: an advice that was not called (``@cop.around``). `foreign`: decorators that may put something else in the
    function's place.
    """

    function: Function
    kind: Kind
    layer: Value | None
    at: ast.AST
    guarded: bool = False
    bare: bool = False
    marks: list[tuple[RuleMark, ast.expr]] = field(default_factory=list)
    foreign: list[ast.expr] = field(default_factory=list)
    decorated: bool = True

    @property
    def is_base(self) -> bool:
        return self.kind == "base"


@dataclass(eq=False)
class Group:
    """All definitions of one name in one scope: the variants that ContextPy3 keeps, and those that a later `def`
    replaces."""

    scope: Scope
    name: str
    variants: list[Variant]
    lost: list[tuple[Variant, Variant]]

    @property
    def marks(self) -> Iterator[tuple[RuleMark, ast.expr]]:
        for variant in self.written:
            yield from variant.marks

    @property
    def written(self) -> list[Variant]:
        """The variants that are kept and those that are lost."""
        return [*self.variants, *(old for old, _ in self.lost)]

    @property
    def concerns_rules(self) -> bool:
        """Whether this is, or may be, the method of a rule."""
        of_rules = (v.layer is not None and not isinstance(v.layer, OwnLayer) for v in self.written)
        return any(self.marks) or any(of_rules)


@dataclass(eq=False)
class Method:
    """A layered method as an object of `class_` has it, or a module if `class_` is None. Its groups are in order,
    nearest first. If `open`, it may inherit more from classes outside the target."""

    name: str
    class_: Class | None
    groups: tuple[Group, ...]
    open: bool = False

    @property
    def marks(self) -> list[tuple[RuleMark, ast.expr]]:
        return [mark for group in self.groups for mark in group.marks]

    @property
    def labels(self) -> list[str]:
        """The labels that it is marked with."""
        return list(dict.fromkeys(mark.label for mark, _ in self.marks if mark.label is not None))

    @property
    def variants(self) -> list[Variant]:
        return [variant for group in self.groups for variant in group.variants]

    @property
    def layer_names(self) -> list[str]:
        return [
            variant.layer.name for group in self.groups for variant in group.written if isinstance(variant.layer, Layer)
        ]


def read_variant(function: Function, resolver: Resolver) -> Variant:
    """What the decorators of one `def` make of it."""
    variant = Variant(function, "base", None, function.node, decorated=False)
    for decorator in function.node.decorator_list:
        value = resolver.of(decorator, function.scope)
        if isinstance(value, Api) and value.name in ADVICE:
            kind = ADVICE[value.name]
            bare = kind != "base"
            variant.kind, variant.at, variant.bare, variant.decorated = kind, decorator, bare, True
        elif isinstance(value, Advice):
            variant.kind, variant.layer, variant.guarded = value.kind, value.layer, value.guarded
            variant.at, variant.decorated = decorator, True
        elif isinstance(value, RuleMark):
            variant.marks.append((value, decorator))
        elif not (isinstance(value, ObligationMark) or (isinstance(value, Api) and value.name in HARMLESS)):
            variant.foreign.append(decorator)
    return variant


def groups(program: TargetProgram, resolver: Resolver) -> Iterator[Group]:
    """Every name of every scope that is defined by `def`, as ContextPy3 puts its definitions together."""
    scopes = {function.scope for function in program.functions}
    for scope in sorted(scopes, key=lambda s: (s.file.source.path, getattr(s.node, "lineno", 0))):
        for name, bindings in scope.bindings.items():
            functions = [binding for binding in bindings if isinstance(binding, Function)]
            if functions:
                yield _group(scope, name, [read_variant(function, resolver) for function in functions])


def _group(scope: Scope, name: str, defined: list[Variant]) -> Group:
    kept: list[Variant] = []
    lost: list[tuple[Variant, Variant]] = []
    layered = False
    for variant in defined:
        if variant.kind != "base":
            kept.append(variant)
            layered = True
        elif variant.decorated and layered:
            kept.insert(0, variant)
        else:
            # Python binds the name anew: what it stood for is gone.
            lost += [(old, variant) for old in kept]
            kept, layered = [variant], False
    return Group(scope, name, kept, lost)


def calls_super(function: Function, name: str) -> bool:
    """Whether a method calls the inherited one of that name."""
    return any(
        isinstance(node, ast.Attribute)
        and node.attr == name
        and isinstance(node.value, ast.Call)
        and isinstance(node.value.func, ast.Name)
        and node.value.func.id == "super"
        for node in ast.walk(function.node)
    )


def methods(program: TargetProgram, resolver: Resolver, found: list[Group], made: set[Class]) -> Iterator[Method]:
    """The methods of rules, one a class that has them: of the classes that no other inherits from, or of which
    objects are `made`."""
    by_scope: dict[Scope, dict[str, Group]] = {}
    for group in found:
        by_scope.setdefault(group.scope, {})[group.name] = group
    inherited = {above for class_ in program.classes for above in resolver.order(class_)[0][1:]}
    for class_ in program.classes:
        if class_ in inherited and class_ not in made:
            continue
        order, open_ = resolver.order(class_)
        tables = [by_scope.get(above.inner, {}) for above in order]
        for name in dict.fromkeys(name for table in tables for name in table):
            chain = tuple(table[name] for table in tables if name in table)
            if any(group.concerns_rules for group in chain):
                yield Method(name, class_, chain, open_)
    for group in found:
        if group.scope.class_ is None and group.concerns_rules:
            yield Method(group.name, None, (group,))
