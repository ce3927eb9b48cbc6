"""γ(Γ), the CO-SLEEC instance of a ruleset: its layers L, its methods M, and which method is whose (MM).

Paper, Section 3.2, with one ε for each rule: with one for all, a rule that yields ε lets every other triggered rule
run its base variant besides the right one. The ε of a rule is the base variant of its method, run under no layer.
"""

from __future__ import annotations

import inspect
import types
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple, TypeVar

from sleec_runtime.dispatch.implementations import (
    implementations,
    is_coroutine_function,
    obligation_of,
    recorded,
    takes_time,
    taking_time,
)
from sleec_runtime.dispatch.layers import (
    Entry,
    LayeredMethod,
    Layers,
    RuleLayer,
    Variant,
    inherited_entries,
    is_variant,
    layered,
    own_entries,
    select,
    silence,
)
from sleec_runtime.errors import AlreadyBound, NotBound, Unbindable, UnknownLabel, UnknownObligation
from sleec_runtime.model import Clause, Rule, Ruleset
from sleec_runtime.support.messages import listed, represent

F = TypeVar("F")

_MARK = "__sleec_rules__"
_METHODS = (types.FunctionType, staticmethod, classmethod, LayeredMethod)


class Method(NamedTuple):
    """MM(R): a method's implementations, nearest definition first, and the object or class that they are bound to.
    `attribute` is the nearest definition itself, which is what a plain call finds."""

    name: str
    definitions: Sequence[Sequence[Entry]]
    instance: object
    owner: type | None
    attribute: object


class Instance:
    """The layers, the methods bound to rules, and the callables that implement obligations.

    Changes are made under the lock of the runtime; variants are looked up without. `takes_time` are the obligations
    that are not done when their callables return; `fitting` is where rules with times note what takes which arguments.
    """

    def __init__(self, ruleset: Ruleset) -> None:
        self.layers = Layers()
        self._token = object()
        self._labels: dict[str, None] = {}
        self._silent: frozenset[str] = frozenset()
        self._methods: dict[str, Method] = {}
        self._callables: dict[str, Callable[..., Any]] = {}
        self.takes_time: frozenset[str] = frozenset()
        self.fitting: set[tuple[object, ...]] = set()
        self._variants: dict[tuple[str, int], tuple[Clause, Variant | None]] = {}
        self.admit(ruleset)

    def copied(self) -> Instance:
        """An instance with the same layers, marks and bindings, whose bindings may change apart."""
        copy = object.__new__(Instance)
        copy.layers = self.layers
        copy._token = self._token
        copy._labels = self._labels
        copy._silent = self._silent
        copy._methods = dict(self._methods)
        copy._callables = dict(self._callables)
        copy.takes_time = self.takes_time
        copy.fitting = set()
        copy._variants = {}
        return copy

    @contextmanager
    def kept_on_failure(self) -> Iterator[None]:
        """What is bound stays as it is if the block raises."""
        before = self.copied()
        try:
            yield
        except BaseException:
            vars(self).update(vars(before))
            raise

    def admit(self, ruleset: Ruleset) -> None:
        """Makes the rules of `ruleset` and their layers known, so that methods can be written for them."""
        self.layers.admit(ruleset)
        self._labels = {**self._labels, **dict.fromkeys(rule.label for rule in ruleset.rules)}
        self._silent |= {rule.label for rule in ruleset.rules if any(map(_obliges_nothing, rule.clauses()))}

    def known(self, label: str) -> str:
        """`label`, if a rule has it. Raises UnknownLabel."""
        try:
            if label in self._labels:
                return label
        except TypeError:  # not hashable, so no label
            pass
        raise UnknownLabel(label, self._labels)

    def mark(self, label: str) -> Callable[[F], F]:
        """The decorator that makes a method the one of rule `label`. Raises UnknownLabel.

        It returns what it was given, a function or ContextPy3's layered method, with a note on it: ContextPy3 finds a
        method's earlier variants by looking at the name in the class body, and must find what it put there. Only where
        a hedge obliges nothing, and so may have no variant, a function becomes a layered method at once: a plain call,
        even of a bound method that was taken from its object early, must find the layer of that hedge.
        """
        note = (self._token, self.known(label))

        def decorator(method: F) -> F:
            if not isinstance(method, _METHODS):
                raise Unbindable(
                    f"{represent(method)} cannot be the method of rule {label}",
                    "mark a function or method, above its @cop.base or @cop.around",
                )
            if label in self._silent and not isinstance(method, LayeredMethod):
                method = layered(method)
            setattr(method, _MARK, (*getattr(method, _MARK, ()), note))
            return method

        return decorator

    def bind(self, targets: Iterable[object], called: Iterable[Rule] = ()) -> tuple[str, ...]:
        """Makes the marked methods of `targets` those of their rules: all of them, or none. Returns the labels.

        A target is an object, a class (for its static and class methods), a module, or one function. Raises Unbindable
        if nothing in one is marked, or as `allow_calls` does for a rule of `called`; AlreadyBound for a second method
        of a rule.
        """
        found: dict[str, Method] = {}
        targets = tuple(targets)
        for target in targets:
            marked = tuple(self._marked(target))
            if not marked:
                raise Unbindable(
                    f"nothing in {represent(target)} is marked as the method of a rule",
                    'mark methods with @sleec.rule("label")',
                )
            for label, method in marked:
                earlier = found.get(label) or self._methods.get(label)
                if earlier is not None:
                    raise AlreadyBound(
                        f"rule {label} has the method {earlier.name}, and {method.name} would be a second",
                        f"unbind({label!r}) first, or mark one of them only",
                    )
                found[label] = method
            self._refuse_misplaced(marked)
        _allow_calls(called, found, self.layers)
        self._methods.update(found)
        self.takes_time = self.takes_time.union(*map(taking_time, targets))
        self._forget(found)
        return tuple(found)

    def _refuse_misplaced(self, marked: Iterable[tuple[str, Method]]) -> None:
        """Raises Unbindable for two variants on one layer, and for a variant or advice on the layer of a rule that the
        method is not the one of: of the first only one would ever run, the second never."""
        own: dict[int, set[str]] = {}
        methods = {}
        for label, method in marked:
            # By what a call of it finds: two functions of a module may have one name.
            own.setdefault(id(method.attribute), set()).add(label)
            methods[id(method.attribute)] = method
        for number, method in methods.items():
            for definition in method.definitions:
                layers = [layer for layer, _, kind in definition if is_variant(kind)]
                for layer, _, kind in definition:
                    if is_variant(kind) and layers.count(layer) > 1:
                        on = "the base" if layer is None else f"layer {getattr(layer, 'name', layer)}"
                        raise Unbindable(f"{method.name} has two variants on {on}", "leave one of them out")
                    # Layers of another instance are its own business: a class may serve two.
                    if not isinstance(layer, RuleLayer) or layer is not self.layers.get(layer.name):
                        continue
                    if layer.name.rpartition(".hc")[0] not in own[number]:
                        raise Unbindable(
                            f"a variant of {method.name} is on layer {layer.name}, and {method.name} is the method of "
                            f"{' and '.join(sorted(own[number]))}",
                            "put it on a layer of that rule, or mark the method with the other rule too",
                        )

    def unbind(self, labels: Iterable[str]) -> None:
        """Takes their methods from rules. Raises UnknownLabel."""
        labels = [self.known(label) for label in labels]
        for label in labels:
            self._methods.pop(label, None)
        self._forget(labels)

    def implement(self, target: object, obligations: frozenset[str]) -> None:
        """Gives callables to obligations: by a mapping, or the object or module that has them.

        Raises UnknownObligation, and Unbindable for what is not callable or implements nothing.
        """
        if isinstance(target, Mapping):
            for name, function in target.items():
                if name not in obligations:
                    raise UnknownObligation(name, obligations)
                if not callable(function):
                    raise Unbindable(
                        f"{represent(function)} is not callable", f"give {name} a function or a bound method"
                    )
            found = dict(target)
        else:
            found = implementations(target, obligations)
            if not found:
                raise Unbindable(
                    f"{represent(target)} implements no obligation of the ruleset",
                    'mark methods with @sleec_runtime.obligation("…"), or name them in snake case',
                )
        self._callables.update(found)
        self.takes_time = self.takes_time.difference(found).union(
            name for name, function in found.items() if takes_time(function)
        )
        self._forget(self._labels)

    def variant(self, rule: Rule, number: int, clause: Clause) -> Variant | None:
        """What runs where clause `number` of `rule` is active; None where there is nothing to run. O(1) but the first
        time.

        Raises NotBound if the rule has no method and not all obligations of the clause a callable, or if the method
        has no variant for a clause that obliges something: the base must not run in its place.
        """
        # The same dictionary throughout: bind() puts another in its place, and what is found for the methods of before
        # must not go into that. Nor must a dispatch that is still under the rules of before a replace() leave its
        # clause to those of after.
        variants = self._variants
        key = (rule.label, number)
        known = variants.get(key)
        if known is not None and known[0] is clause:
            return known[1]
        method = self._methods.get(rule.label)
        if method is None:
            variant = self._composed(rule, number, clause)
        else:
            variant = self._written(rule, number, clause, method)
        variants[key] = clause, variant
        return variant

    def allow_calls(self, rules: Iterable[Rule]) -> None:
        """Sees to it that a plain call of a method of `rules`, under the layers that are globally active, runs what a
        dispatch would, and nothing where a clause without a variant obliges nothing (ContextPy3 runs the base there).

        Raises Unbindable for a method that cannot be called so, because a definition in a subclass hides its variants
        or because it has no layers at all.
        """
        _allow_calls(rules, self._methods, self.layers)

    def has_method(self, label: str) -> bool:
        """Whether a method is bound to the rule, so that no variant of it is composed of callables."""
        return label in self._methods

    def given(self, name: str) -> Callable[..., Any] | None:
        """The callable that was given to an obligation, as it was given."""
        return self._callables.get(name)

    def implementation(self, name: str) -> Callable[..., Any] | None:
        """The callable that was given to an obligation, seen by recordings."""
        function = self._callables.get(name)
        return None if function is None else _seen(name, function)

    def composed(
        self,
        label: str,
        layer: str | None,
        functions: Sequence[Callable[..., Any]],
        plain: Sequence[Callable[..., Any]] = (),
    ) -> Variant:
        """A variant of rule `label` that calls `functions` in order, and does nothing else. They are `plain` with
        something around them."""
        return Variant(label, self.layers.of(layer), own_entries(_in_order(functions)), None, None, tuple(plain))

    def objects(self) -> list[object]:
        """The objects that methods are bound to, once each."""
        return list({id(m.instance): m.instance for m in self._methods.values() if m.instance is not None}.values())

    def missing(self, rules: Iterable[Rule]) -> dict[str, NotBound]:
        """Why rules cannot run in every context, by their labels. O(clauses)."""
        problems = ((rule.label, self._problem(rule)) for rule in rules)
        return {label: problem for label, problem in problems if problem is not None}

    def _problem(self, rule: Rule) -> NotBound | None:
        try:
            for number, clause in enumerate(rule.clauses()):
                self.variant(rule, number, clause)
                if any(obligation.timing is not None for obligation in clause.obligations):
                    from sleec_runtime.timed.execution_plan import require_code

                    require_code(rule, clause, self)
        except NotBound as problem:
            return problem
        return None

    def _written(self, rule: Rule, number: int, clause: Clause, method: Method) -> Variant | None:
        layer = self.layers.of(rule.layer(number))
        entries = select(method.definitions, layer)
        if entries is not None:
            return Variant(rule.label, layer, entries, method.instance, method.owner)
        if _obliges_nothing(clause):
            return None
        decorator = "@cop.base" if layer is None else f'@cop.around(sleec.layers["{layer.name}"])'
        raise NotBound(
            f"{method.name}, the method of rule {rule.label}, has no variant for {_clause_name(rule, number)}",
            [rule.label],
            f"write it under {decorator}, and bind the method when all its variants are there",
        )

    def _composed(self, rule: Rule, number: int, clause: Clause) -> Variant | None:
        """impl(O0); …; impl(Ok) and nothing else: properly structured by construction."""
        names = [literal.name for literal in clause.obligations if not literal.negated]
        without = [name for name in names if name not in self._callables]
        if without:
            raise NotBound(
                f"rule {rule.label} has no method, and {listed(without)} ({_clause_name(rule, number)}) no callable",
                [rule.label],
                f'mark a method with @sleec.rule("{rule.label}") and bind() its object, or implement() the obligations',
            )
        if not names:
            return None
        functions = [self._callables[name] for name in names]
        seen = [_seen(name, function) for name, function in zip(names, functions)]
        return self.composed(rule.label, rule.layer(number), seen, functions)

    def _marked(self, target: object) -> Iterable[tuple[str, Method]]:
        if isinstance(target, (types.FunctionType, LayeredMethod)):
            return [(label, _function(target)) for label in self._notes(target)]
        if isinstance(target, types.ModuleType):
            # One function may have two names.
            functions = {id(attribute): attribute for attribute in vars(target).values()}.values()
            return [(label, _function(function)) for function in functions for label in self._notes(function)]
        owner = target if isinstance(target, type) else type(target)
        instance = None if isinstance(target, type) else target
        # An override may be marked again.
        found = {
            (label, name): None
            for base in owner.__mro__
            for name, attribute in vars(base).items()
            for label in self._notes(attribute)
        }
        return [(label, _of_class(name, instance, owner)) for label, name in found]

    def _notes(self, attribute: object) -> list[str]:
        """The labels that one definition of a method is marked with, on itself or on one of its variants."""
        if not isinstance(attribute, _METHODS):
            return []
        notes = list(getattr(attribute, _MARK, ()))
        if isinstance(attribute, LayeredMethod):
            notes += [note for entry in attribute.get_methods() for note in getattr(entry[1], _MARK, ())]
        return [label for token, label in dict.fromkeys(notes) if token is self._token]

    def _forget(self, labels: Iterable[str]) -> None:
        gone = frozenset(labels)
        self.fitting = set()
        self._variants = {key: known for key, known in tuple(self._variants.items()) if key[0] not in gone}


def _of_class(name: str, instance: object, owner: type) -> Method:
    definitions = inherited_entries(owner, name)
    if instance is None and any(
        isinstance(entry[1], types.FunctionType) for entries in definitions for entry in entries
    ):
        raise Unbindable(f"{owner.__name__}.{name} needs an object", f"bind an instance of {owner.__name__}")
    return Method(name, definitions, instance, owner, inspect.getattr_static(owner, name))


def _function(function: Any) -> Method:
    definition = own_entries(function)
    return Method(
        getattr(definition[0][1], "__name__", None) or represent(function), [definition], None, None, function
    )


def _allow_calls(rules: Iterable[Rule], methods: Mapping[str, Method], layers: Layers) -> None:
    silent: list[tuple[Method, RuleLayer]] = []
    for rule in rules:
        method = methods.get(rule.label)
        if method is None:
            continue
        for number, clause in enumerate(rule.clauses()):
            layer = layers.of(rule.layer(number))
            if select(method.definitions[:1], layer) is not None:
                continue
            if select(method.definitions, layer) is not None:
                raise Unbindable(
                    f"a plain call of {method.name} finds no variant for {_clause_name(rule, number)} of rule "
                    f"{rule.label}: a definition in a subclass hides it",
                    "write all variants in one class, or use trigger()",
                )
            if layer is None or not _obliges_nothing(clause):
                continue
            if not isinstance(method.attribute, LayeredMethod):
                raise Unbindable(
                    f"a plain call of {method.name} runs it where {_clause_name(rule, number)} decides, which has "
                    "nothing to run",
                    f'write an empty variant under @cop.around(sleec.layers["{layer.name}"]), or use trigger()',
                )
            silent.append((method, layer))
    for method, layer in silent:
        base = select(method.definitions, None) or ()
        silence(method.attribute, layer, any(is_coroutine_function(function) for _, function, _ in base))


def _obliges_nothing(clause: Clause) -> bool:
    return all(literal.negated for literal in clause.obligations)


def _clause_name(rule: Rule, number: int) -> str:
    return rule.layer(number) or "its default"


def _seen(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    return function if obligation_of(function) == name else recorded(name, function)


def _in_order(functions: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    if any(map(is_coroutine_function, functions)):

        async def awaited(*args: Any, **kwargs: Any) -> None:
            for function in functions:
                result = function(*args, **kwargs)
                if inspect.isawaitable(result):
                    await result

        return awaited

    def called(*args: Any, **kwargs: Any) -> Unfinished | None:
        for place, function in enumerate(functions):
            result = function(*args, **kwargs)
            if type(result) is types.CoroutineType or type(result) is Unfinished:
                return Unfinished(result, functions[place + 1 :], args, kwargs)
        return None

    return called


class Unfinished:
    """A clause in which a callable, not known to be a coroutine function, returned a coroutine: to be awaited, and then
    the callables after it are called."""

    def __init__(
        self, coroutine: Any, rest: Sequence[Callable[..., Any]], args: tuple[Any, ...], kwargs: dict[str, Any]
    ) -> None:
        self._coroutine = coroutine
        self._rest = rest
        self._args = args
        self._kwargs = kwargs

    def close(self) -> None:
        self._coroutine.close()

    def __await__(self) -> Generator[Any, Any, None]:
        return self._finish().__await__()

    async def _finish(self) -> None:
        await self._coroutine
        for function in self._rest:
            result = function(*self._args, **self._kwargs)
            if inspect.isawaitable(result):
                await result
