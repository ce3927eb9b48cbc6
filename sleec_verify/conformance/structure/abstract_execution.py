"""What a variant executes: the obligations whose implementations it calls, in order, and how sure that is."""

from __future__ import annotations

import ast
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager

from sleec_verify.conformance.structure.control import Flow, is_generator
from sleec_verify.conformance.structure.execution import Call, Doubt, Execution
from sleec_verify.conformance.structure.implementation_lookup import ImplementationLookup
from sleec_verify.conformance.structure.methods import HARMLESS
from sleec_verify.conformance.structure.names import Names
from sleec_verify.conformance.structure.program import DEFS, Class, Function, Scope
from sleec_verify.conformance.structure.resolve import Resolver, maybe_runtime
from sleec_verify.conformance.structure.target import PythonFile
from sleec_verify.conformance.structure.values import (
    Api,
    ClassOf,
    Code,
    Environment,
    ForeignValue,
    MarkedCallable,
    Object,
    ObligationMark,
    RuleMark,
    Runtime,
    Text,
    UnknownValue,
    Value,
)

_MOST_CALLS = 2_000
_CHANGES = {"update", "replace"}
"""The methods of a runtime, or of its sensors, that change the context or the rules."""
_TRIGGERS = {"trigger", "trigger_all"}
_TRIGGERS_ASYNC = {"trigger_async", "trigger_all_async"}
"""The methods of a runtime that trigger rules: the names come first."""
REPLACERS = {f"builtins.{name}" for name in ("exec", "eval", "compile", "__import__", "globals", "locals", "vars")}


class AbstractExecutor:
    """Follows variants. `followed` maps each function that was entered to the obligations executed in it;
    `implementations` are functions that were called as an obligation's."""

    def __init__(self, resolver: Resolver, names: Names, rule_methods: Collection[Function]) -> None:
        self.resolver = resolver
        self.names = names
        self.rule_methods = rule_methods
        self.followed: dict[Function, set[str]] = {}
        self.implementations: dict[Function, str] = {}
        self.by_name: set[str] = set()

    def trace(
        self,
        function: Function,
        class_: Class | None,
        inherited: Callable[[Function], Function | None] = lambda _: None,
    ) -> Execution:
        """What `function` executes as a method of an object of `class_`. `inherited` gives, for the method that
        `super()` leads to, the variant of the same layer."""
        run = _Run(self, Execution(), inherited)
        receiver = Object(class_) if class_ is not None else None
        own = self.names.mark(function)
        if own is not None:
            run.execute(own, function.node, function.file, None)
        run.enter(function, run.arguments(function, receiver, None, None, {}), None)
        calls = run.trace.calls
        if own is not None:
            # Executed within itself, an obligation is executed once.
            run.trace.calls = calls[:1] + [call for call in calls[1:] if call.obligation != own]
        return run.trace


class _Run:
    """One variant under way."""

    def __init__(
        self, tracer: AbstractExecutor, trace: Execution, inherited: Callable[[Function], Function | None]
    ) -> None:
        self.tracer = tracer
        self.resolver = tracer.resolver
        self.names = tracer.names
        self.trace = trace
        self.inherited = inherited
        self.stack: list[Function] = []
        self.entered = 0

    # Functions ------------------------------------------------------------------------------------------

    def enter(self, function: Function, given: Environment, why: str | None) -> None:
        """Follows the body of a function."""
        if function in self.stack:
            return self.doubt(function.node, function.file, f"{function.name} calls itself")
        self.entered += 1
        if self.entered > _MOST_CALLS:
            if self.entered == _MOST_CALLS + 1:
                self.doubt(function.node, function.file, "there are too many calls to analyse from here")
            return None
        if is_generator(function.node):
            why = why or "in a generator, which may not run to its end"
        before = len(self.trace.calls)
        self.stack.append(function)
        self.tracer.followed.setdefault(function, set())
        body = _Body(self, function, given)
        body.statements(function.node.body, why)
        body.finish()
        self.stack.pop()
        executed = {call.obligation for call in self.trace.calls[before:]}
        for outer in (function, *self.stack):
            if outer in self.tracer.followed:  # the stack also holds functions that are looked at without being called
                self.tracer.followed[outer] |= executed
        return None

    def arguments(
        self, function: Function, receiver: Value | None, call: ast.Call | None, scope: Scope | None, given: Environment
    ) -> dict[str, Value]:
        """What the parameters are worth, as far as the call says."""
        parameters = [arg.arg for arg in function.parameters]
        found: dict[str, Value] = {}
        made = {self.resolver.of(node, function.scope) for node in function.node.decorator_list}
        if receiver is not None and function.owner is not None and Api("builtins.staticmethod") not in made:
            if parameters:
                found[parameters[0]] = receiver
            parameters = parameters[1:]
        if call is not None and scope is not None:
            plain = not any(isinstance(arg, ast.Starred) for arg in call.args)
            for name, arg in zip(parameters, call.args if plain else ()):
                found[name] = self.resolver.of(arg, scope, given)
            for keyword in call.keywords:
                if keyword.arg is not None:
                    found[keyword.arg] = self.resolver.of(keyword.value, scope, given)
        bindings = function.inner.bindings
        return {name: value for name, value in found.items() if len(bindings.get(name, ())) == 1}

    # What is found --------------------------------------------------------------------------------------

    def execute(self, obligation: str, node: ast.AST, file: PythonFile, why: str | None) -> None:
        if obligation in self.names.obligations:
            self.trace.calls.append(Call(obligation, node, file, why))

    def doubt(self, node: ast.AST, file: PythonFile, why: str) -> None:
        self.trace.doubts.append(Doubt(node, file, why))


class _Body(Flow):
    """One function's body, in one call of it."""

    def __init__(self, run: _Run, function: Function, given: Environment) -> None:
        self.run = run
        self.function = function
        self.given = given
        self.scopes: list[Scope] = [function.inner]
        self.lookup = ImplementationLookup(run.resolver, run.names, run.stack[0], given)
        self.file = function.file
        self.pending: list[tuple[Function, list[Call]]] = []

    def value(self, node: ast.expr) -> Value:
        return self.run.resolver.of(node, self.scopes[-1], self.given)

    def suppresses(self, node: ast.expr) -> bool:
        return isinstance(node, ast.Call) and self.value(node.func) == Api("contextlib.suppress")

    @contextmanager
    def within(self, node: ast.AST) -> Iterator[None]:
        self.scopes.append(self.run.resolver.program.scope_of[node])
        yield
        self.scopes.pop()

    def outside(self, node: ast.expr) -> str | None:
        value = self.value(node)
        return value.name if isinstance(value, Api) else None

    def nested(self, node: ast.stmt) -> None:
        """A nested function. Its obligations are executed at its calls."""
        if not isinstance(node, DEFS):
            return
        inner = self.run.resolver.program.scope_of[node].function
        assert inner is not None, "the scope of a function knows it"
        self.run.stack.append(inner)
        before = self.run.trace
        self.run.trace = Execution()
        _Body(self.run, inner, self.given).statements(node.body, "in a function that is defined but not called here")
        found, self.run.trace = self.run.trace, before
        self.run.stack.pop()
        if found.calls:
            self.pending.append((inner, found.calls))

    def reference(self, node: ast.expr) -> None:
        """An implementation that is spoken of without being called."""
        value = self.value(node)
        name = self._obligation(node, value)
        if name is not None:
            self.run.doubt(node, self.file, f"the implementation of `{name}` is passed on here, not called")

    def call(self, node: ast.Call, why: str | None, awaited: bool) -> None:
        value = self.value(node.func)
        self._triggered(node, why, awaited)
        own = self._own_attribute(node.func)
        if own is not None:
            self._by_name(node, own, why)
        elif isinstance(value, MarkedCallable):
            if value.name is None:
                self.run.doubt(node, self.file, "the name of the obligation is known only at run time")
            else:
                self.run.execute(value.name, node, self.file, why)
        elif isinstance(value, Code):
            self._code(node, value, why, awaited)
        elif isinstance(value, Api):
            self._api(node, value, why)
        elif isinstance(value, (UnknownValue, ForeignValue)):
            self._unresolved(node, value, why)

    def _triggered(self, node: ast.Call, why: str | None, awaited: bool) -> None:
        """Notes a trigger that the variant itself sets off, and what may have the rule decide otherwise by then."""
        if not isinstance(node.func, ast.Attribute):
            return
        method, trace = node.func.attr, self.run.trace
        if method in _CHANGES:
            trace.changed = True
        elif node.args and (method in _TRIGGERS or (method in _TRIGGERS_ASYNC and awaited)):
            owner = self.value(node.func.value)
            runtime = isinstance(owner, Runtime) or maybe_runtime(owner)
            if not runtime or why is not None or trace.changed:
                return
            first = node.args[0]
            for part in first.elts if isinstance(first, (ast.List, ast.Tuple, ast.Set)) else (first,):
                name = self.value(part)
                if isinstance(name, Text):
                    trace.triggers.append((name.value, node, self.file))

    def _own_attribute(self, node: ast.expr) -> str | None:
        """The obligation that an attribute implements which the robot's methods assign: whatever it is, by its name."""
        if not isinstance(node, ast.Attribute):
            return None
        receiver = self.value(node.value)
        if not isinstance(receiver, Object) or not self.lookup.is_robots(receiver):
            return None
        assigned = any(node.attr in above.attributes for above in self.run.resolver.order(receiver.class_)[0])
        return self.run.names.called(node.attr) if assigned else None

    def follows(self, node: ast.Call) -> bool:
        """Whether the analysis follows the call and so visits its arguments there."""
        value = self.value(node.func)
        return isinstance(value, Code) and self._obligation(node.func, value) is None

    def _obligation(self, node: ast.expr, value: Value) -> str | None:
        if isinstance(value, Code) and len(value.definitions) == 1:
            return self.lookup.obligation_of(value.definitions[0], value.receiver)
        if isinstance(value, UnknownValue) and isinstance(node, ast.Attribute):
            receiver = self.value(node.value)
            if isinstance(receiver, (Object, ClassOf)):
                return self.run.names.called(node.attr)
        return None

    def _code(self, node: ast.Call, value: Code, why: str | None, awaited: bool) -> None:
        function = value.definitions[-1]
        if function in self.run.tracer.rule_methods:
            variant = self.run.inherited(function) if self._is_super(node) else None
            if variant is not None:
                self._enter(variant, value, node, why)
            return
        if len(value.definitions) > 1 or not function.certain:
            for one in value.definitions:
                self.run.tracer.followed.setdefault(one, set())
            self.run.doubt(node, self.file, f"which definition of {function.name} this calls is known only at run time")
            return
        if isinstance(function.node, ast.AsyncFunctionDef) and not awaited:
            why = why or "not awaited here, so it may never run"
        name = self.lookup.obligation_of(function, value.receiver)
        if name is not None:
            self.run.tracer.implementations[function] = name
            self.run.execute(name, node, self.file, why)
            return
        before = len(self.run.trace.calls)
        self._enter(function, value, node, why)
        if len(self.run.trace.calls) > before and self._replaced(function):
            self.run.doubt(node, self.file, f"a decorator of {function.name} may replace it")

    def _enter(self, function: Function, value: Code, node: ast.Call, why: str | None) -> None:
        given = self.run.arguments(function, value.receiver, node, self.scopes[-1], self.given)
        closure = self.given if function.scope in self.scopes else {}
        self.run.enter(function, {**closure, **given}, why)

    def _replaced(self, function: Function) -> bool:
        values = [self.run.resolver.of(node, function.scope) for node in function.node.decorator_list]
        return any(
            not isinstance(value, (RuleMark, ObligationMark))
            and not (isinstance(value, Api) and value.name in HARMLESS)
            for value in values
        )

    def _is_super(self, node: ast.Call) -> bool:
        receiver = self.value(node.func.value) if isinstance(node.func, ast.Attribute) else None
        return isinstance(receiver, Object) and receiver.after is not None

    def _api(self, node: ast.Call, value: Api, why: str | None) -> None:
        if value.name == "contextpy3.proceed":
            self.run.trace.proceeds.append((node, self.file))
            return
        if value.name in REPLACERS:
            self.run.doubt(
                node, self.file, f"the effect of {value.name.removeprefix('builtins.')} is known only at run time"
            )
            return
        name = self.run.names.called_outside(value, node.func)
        if name is not None:
            self._by_name(node, name, why)

    def _unresolved(self, node: ast.Call, value: Value, why: str | None) -> None:
        func = node.func
        if isinstance(func, ast.Attribute):
            name = self.run.names.called(func.attr)
            receiver = self.value(func.value)
            if name is not None:
                own = isinstance(receiver, (Object, ClassOf)) and self.lookup.is_robots(receiver)
                if own or not self.lookup.robot_implements(name):
                    self._by_name(node, name, why)
                elif isinstance(receiver, UnknownValue):
                    self.run.doubt(node, self.file, f"whether this implements `{name}` is known only at run time")
            elif isinstance(receiver, (Object, ClassOf)):
                self.run.trace.unfollowed.append(f"{ast.unparse(func)}()")
        elif isinstance(value, UnknownValue):
            self.run.doubt(node, self.file, f"what {ast.unparse(func)} calls is known only at run time")

    def _by_name(self, node: ast.Call, name: str, why: str | None) -> None:
        self.run.tracer.by_name.add(name)
        self.run.execute(name, node, self.file, why)

    def finish(self) -> None:
        """What was defined here and never called may be called from anywhere."""
        for inner, calls in self.pending:
            if inner not in self.run.tracer.followed:
                self.run.trace.calls += calls
