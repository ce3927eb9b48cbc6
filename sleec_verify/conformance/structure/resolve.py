"""Evaluates expressions of the target without running them."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field

from sleec_verify.conformance.structure.program import (
    Assignment,
    Binding,
    Class,
    Function,
    Import,
    Opaque,
    Scope,
    TargetProgram,
)
from sleec_verify.conformance.structure.values import (
    NOTHING_GIVEN,
    STANDARD,
    UNKNOWN,
    Advice,
    Api,
    ClassOf,
    Code,
    Environment,
    ForeignValue,
    Kind,
    Layer,
    Layers,
    MarkedCallable,
    Module,
    Object,
    ObligationMark,
    OwnLayer,
    RuleMark,
    Runtime,
    Table,
    Text,
    UnknownValue,
    Value,
)

_RUNTIME = {"sleec_runtime.load", "sleec_runtime.Sleec", "sleec_runtime.facade.sleec.Sleec"}
_OBLIGATION = {
    f"sleec_runtime.{name}"
    for name in ("obligation", "dispatch.implementations.obligation", "dispatch.recording.recorded")
}
_CONTEXTPY3 = (
    "Layer", "active_layer", "active_layers", "inactive_layer", "inactive_layers", "proceed", "before", "after",
    "around", "base", "global_activate_layer", "global_deactivate_layer",
)  # fmt: skip
ADVICE = {f"contextpy3.{kind}": kind for kind in ("around", "before", "after", "base")}


@dataclass
class Resolver:
    """Evaluates expressions of a program."""

    program: TargetProgram
    _known: dict[tuple[Scope, str], Value] = field(default_factory=dict)
    _under_way: set[object] = field(default_factory=set)
    _orders: dict[Class, tuple[tuple[Class, ...], bool]] = field(default_factory=dict)

    def of(self, node: ast.expr, scope: Scope, given: Environment = NOTHING_GIVEN) -> Value:
        """The value of an expression in a scope; `given` are the arguments of the call under way, if one is."""
        method = getattr(self, f"_{type(node).__name__}", None)
        if method is None:
            return STANDARD if isinstance(node, _LITERALS) else UNKNOWN
        value: Value = method(node, scope, given)
        return value

    # Names ----------------------------------------------------------------------------------------------

    def _Name(self, node: ast.Name, scope: Scope, given: Environment) -> Value:  # noqa: N802
        return self.name(node.id, scope, given)

    def name(self, name: str, scope: Scope, given: Environment = NOTHING_GIVEN) -> Value:
        """The value of a name in a scope."""
        if name in given:
            return given[name]
        inner: Scope | None = scope
        while inner is not None:
            # A class body is seen from within itself only, not from its methods.
            if name in inner.bindings and (inner is scope or inner.class_ is None):
                return self.bound(name, inner)
            starred = self._starred(name, inner)
            if starred is not None:
                return starred
            inner = inner.outer
        return Api(f"builtins.{name}")

    def bound(self, name: str, scope: Scope) -> Value:
        """What a name is bound to in the scope that binds it."""
        key = (scope, name)
        if key not in self._known:
            if key in self._under_way:
                return UNKNOWN
            self._under_way.add(key)
            self._known[key] = self._one_of(scope.bindings[name], scope, name)
            self._under_way.discard(key)
        return self._known[key]

    def _one_of(self, bindings: list[Binding], scope: Scope, name: str) -> Value:
        definitions = tuple(binding for binding in bindings if isinstance(binding, Function))
        if definitions and len(definitions) == len(bindings):
            return Code(definitions)
        values = {self._binding(binding, scope, name) for binding in bindings}
        return values.pop() if len(values) == 1 else UNKNOWN

    def _binding(self, binding: Binding, scope: Scope, name: str) -> Value:
        if isinstance(binding, Assignment):
            return self.assigned(binding, scope)
        if isinstance(binding, Import):
            return self._imported(binding, scope)
        if isinstance(binding, Class):
            return ClassOf(binding)
        if isinstance(binding, Function):
            return Code((binding,))
        return self._parameter(binding, scope, name)

    def assigned(self, binding: Assignment, scope: Scope) -> Value:
        """The value of an assignment, or an object of the annotated class."""
        if not binding.annotation:
            return self.of(binding.value, scope)
        # Annotations of parameters are evaluated outside the function.
        outside = scope.outer if scope.function is not None and scope.outer is not None else scope
        annotation = binding.value
        if isinstance(annotation, ast.Constant) and isinstance(annotation.value, str):
            try:
                annotation = ast.parse(annotation.value, mode="eval").body
            except SyntaxError:
                return UNKNOWN
        what = self.of(annotation, outside)
        return UNKNOWN if what in _ANYTHING else self._made_by(what)

    def _parameter(self, binding: Opaque, scope: Scope, name: str) -> Value:
        """`self` and `cls` are what they are called; of other parameters, nothing is known."""
        function = scope.function
        if function is None or scope is not function.inner or function.owner is None or not function.parameters:
            return UNKNOWN
        if function.parameters[0] is not binding.node or len(scope.bindings[name]) > 1:
            return UNKNOWN
        made = {self.of(decorator, function.scope) for decorator in function.node.decorator_list}
        if Api("builtins.staticmethod") in made:
            return UNKNOWN
        return ClassOf(function.owner) if Api("builtins.classmethod") in made else Object(function.owner)

    def _imported(self, binding: Import, scope: Scope) -> Value:
        module = self.program.module_named(binding.module, binding.level, scope.file)
        if binding.attribute is None:
            return Api(binding.module) if module is None else Module(module)
        if module is not None and (binding.attribute in module.bindings or module.stars):
            return self.name(binding.attribute, module)
        whole = f"{binding.module}.{binding.attribute}" if binding.module else binding.attribute
        inner = self.program.module_named(whole, binding.level, scope.file)
        if inner is not None:
            return Module(inner)
        return UNKNOWN if module is not None else Api("." * binding.level + whole)

    def _starred(self, name: str, scope: Scope) -> Value | None:
        for star in scope.stars:
            if star.module == "contextpy3" and name in _CONTEXTPY3:
                return Api(f"contextpy3.{name}")
            module = self.program.module_named(star.module, star.level, scope.file)
            if module is not None and name in module.bindings:
                return self.bound(name, module)
        return None

    # Strings --------------------------------------------------------------------------------------------

    def _Constant(self, node: ast.Constant, scope: Scope, given: Environment) -> Value:  # noqa: N802
        return Text(str(node.value)) if isinstance(node.value, (str, int)) else STANDARD

    def _JoinedStr(self, node: ast.JoinedStr, scope: Scope, given: Environment) -> Value:  # noqa: N802
        parts = [self.of(part, scope, given) for part in node.values]
        return Text("".join(p.value for p in parts if isinstance(p, Text))) if _all_text(parts) else UNKNOWN

    def _FormattedValue(self, node: ast.FormattedValue, scope: Scope, given: Environment) -> Value:  # noqa: N802
        return UNKNOWN if node.format_spec or node.conversion > 0 else self.of(node.value, scope, given)

    def _BinOp(self, node: ast.BinOp, scope: Scope, given: Environment) -> Value:  # noqa: N802
        sides = [self.of(node.left, scope, given), self.of(node.right, scope, given)]
        if isinstance(node.op, ast.Add) and _all_text(sides):
            return Text("".join(side.value for side in sides if isinstance(side, Text)))
        return UNKNOWN

    # Attributes, subscripts, calls ----------------------------------------------------------------------

    def _Attribute(self, node: ast.Attribute, scope: Scope, given: Environment) -> Value:  # noqa: N802
        return self.attribute(self.of(node.value, scope, given), node.attr)

    def attribute(self, value: Value, name: str) -> Value:
        """``value.name``."""
        if isinstance(value, Module):
            if name in value.scope.bindings or value.scope.stars:
                return self.name(name, value.scope)
            return self._submodule(value.scope, name)
        if isinstance(value, (Object, ClassOf)):
            return self._member(value, name)
        if isinstance(value, Api) and value.name.startswith(("sleec_runtime", "contextpy3", "builtins")):
            return Api(f"{value.name}.{name}")
        if name == "layers" and isinstance(value, (Runtime, Api, UnknownValue, ForeignValue)):
            return Layers()
        return Api(f"{value.name}.{name}") if isinstance(value, Api) else UNKNOWN

    def _submodule(self, scope: Scope, name: str) -> Value:
        parts = (*scope.file.parts, name)
        return next((Module(module) for module in self.program.modules if module.file.parts == parts), UNKNOWN)

    def _member(self, value: Object | ClassOf, name: str) -> Value:
        classes, _ = self.order(value.class_)
        if isinstance(value, Object) and value.after is not None:
            classes = classes[classes.index(value.after) + 1 :] if value.after in classes else ()
        elif isinstance(value, Object):
            attributes = [pair for class_ in classes for pair in class_.attributes.get(name, ())]
            if attributes:
                return self._assigned_to_self((value, name), attributes)
        for class_ in classes:
            if name in class_.inner.bindings:
                found = self.bound(name, class_.inner)
                return Code(found.definitions, value) if isinstance(found, Code) else found
        return UNKNOWN

    def _assigned_to_self(self, key: object, attributes: list[tuple[Assignment | None, Scope]]) -> Value:
        if key in self._under_way:  # self.x = self.x.next
            return UNKNOWN
        self._under_way.add(key)
        values = {UNKNOWN if one is None else self.assigned(one, scope) for one, scope in attributes}
        self._under_way.discard(key)
        return values.pop() if len(values) == 1 else UNKNOWN

    def _Subscript(self, node: ast.Subscript, scope: Scope, given: Environment) -> Value:  # noqa: N802
        return self._item(self.of(node.value, scope, given), self.of(node.slice, scope, given))

    def _item(self, value: Value, key: Value) -> Value:
        return Layer(key.value) if isinstance(value, Layers) and isinstance(key, Text) else UNKNOWN

    def _Dict(self, node: ast.Dict, scope: Scope, given: Environment) -> Value:  # noqa: N802
        return Table(node, scope)

    def _Call(self, node: ast.Call, scope: Scope, given: Environment) -> Value:  # noqa: N802
        called = self.of(node.func, scope, given)
        if isinstance(called, Api) and called.name in ADVICE and called.name != "contextpy3.base":
            return self._advice(ADVICE[called.name], node, scope, given)
        first = self.of(node.args[0], scope, given) if node.args else UNKNOWN
        text = first.value if isinstance(first, Text) else None
        if isinstance(called, Api) and called.name in _OBLIGATION:
            if called.name.endswith("recorded"):
                return MarkedCallable(text)
            return ObligationMark(text, _completes(node))
        if isinstance(called, ObligationMark):
            return MarkedCallable(called.name)
        if called == Api("builtins.super"):
            return self._super(scope, given)
        if called == Api("builtins.getattr") and text is None and len(node.args) > 1:
            name = self.of(node.args[1], scope, given)
            return self.attribute(first, name.value) if isinstance(name, Text) else UNKNOWN
        if called == Api("builtins.dict"):
            return Table(node, scope)
        if isinstance(node.func, ast.Attribute):
            owner = self.of(node.func.value, scope, given)
            if isinstance(owner, Layers) and node.func.attr in ("get", "of", "__getitem__"):
                return self._item(owner, first)
            if node.func.attr == "rule" and (isinstance(owner, Runtime) or (maybe_runtime(owner) and node.args)):
                return RuleMark(text)
        return self._made_by(called)

    def _made_by(self, called: Value) -> Value:
        """What calling something gives."""
        if isinstance(called, ClassOf):
            return Object(called.class_)
        if isinstance(called, Api):
            if called.name in _RUNTIME:
                return Runtime()
            return OwnLayer() if called.name == "contextpy3.Layer" else ForeignValue(called.standard)
        return UNKNOWN

    def _advice(self, kind: Kind, node: ast.Call, scope: Scope, given: Environment) -> Value:
        keywords = {keyword.arg: keyword.value for keyword in node.keywords}
        layer = node.args[0] if node.args else keywords.get("layer_")
        guarded = len(node.args) > 1 or "guard" in keywords
        if layer is None or (isinstance(layer, ast.Constant) and layer.value is None):
            return Advice(kind, UNKNOWN if None in keywords else None, guarded)
        return Advice(kind, self.layer(layer, scope, given), guarded)

    def layer(self, node: ast.expr, scope: Scope, given: Environment = NOTHING_GIVEN) -> Value:
        """The value of an expression for a layer. Every object that is subscripted with a name counts as `layers`."""
        value = self.of(node, scope, given)
        if isinstance(value, UnknownValue) and isinstance(node, ast.Subscript):
            holder, key = self.of(node.value, scope, given), self.of(node.slice, scope, given)
            if isinstance(holder, (UnknownValue, Api)) and isinstance(key, Text):
                return Layer(key.value)
        return value

    def _super(self, scope: Scope, given: Environment) -> Value:
        inner: Scope | None = scope
        while inner is not None and (inner.function is None or inner.function.owner is None):
            inner = inner.outer
        function = None if inner is None else inner.function
        if function is None or function.owner is None or not function.parameters:
            return UNKNOWN
        receiver = self.name(function.parameters[0].arg, function.inner, given)
        return Object(receiver.class_, function.owner) if isinstance(receiver, (Object, ClassOf)) else UNKNOWN

    # Classes --------------------------------------------------------------------------------------------

    def order(self, class_: Class) -> tuple[tuple[Class, ...], bool]:
        """The classes of the target that a class inherits from, nearest first with itself, and whether it may inherit
        from others too."""
        if class_ not in self._orders:
            self._orders[class_] = ((class_,), True)  # for a class that inherits from itself
            found, open_ = [class_], False
            for base in class_.node.bases:
                value = self.of(base.value if isinstance(base, ast.Subscript) else base, class_.scope)
                if isinstance(value, ClassOf):
                    above, more = self.order(value.class_)
                    found = [one for one in found if one not in above] + list(above)
                    open_ = open_ or more
                else:
                    open_ = open_ or value not in _BASES_WITHOUT_METHODS
            self._orders[class_] = (tuple(found), open_)
        return self._orders[class_]


_LITERALS = (ast.List, ast.Tuple, ast.Set, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp, ast.Compare)
_BASES_WITHOUT_METHODS = {Api(name) for name in ("builtins.object", "typing.Protocol", "typing.Generic", "abc.ABC")}


_ANYTHING = (Api("typing.Any"), Api("builtins.object"))


def maybe_runtime(value: Value) -> bool:
    """Whether a value may be a runtime that was made elsewhere."""
    if isinstance(value, Api):
        return not value.name.startswith(("builtins.", "contextpy3"))
    return isinstance(value, (UnknownValue, ForeignValue))


def _completes(mark: ast.Call) -> bool | None:
    """The argument `completes` of ``obligation(name, completes=True)``; None if it is known only at run time."""
    given = [*mark.args[1:2], *(keyword.value for keyword in mark.keywords if keyword.arg in ("completes", None))]
    if not given:
        return True
    return bool(given[0].value) if isinstance(given[0], ast.Constant) else None


def _all_text(values: list[Value]) -> bool:
    return all(isinstance(value, Text) for value in values)
