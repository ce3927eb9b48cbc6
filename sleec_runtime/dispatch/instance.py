"""γ(Γ), the CO-SLEEC instance of a ruleset: its layers L, its methods M, and the method of each rule (MM).

Paper, Section 3.2, with one ε for each rule. With one ε for all, a rule that yields ε would make every other triggered
rule run its base variant as well. The ε of a rule is the base variant of its method, which runs under no layer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from sleec_runtime.dispatch.implementations import (
    implementations,
    obligation_of,
    sought_callables,
    takes_time,
    taking_time,
)
from sleec_runtime.dispatch.layered_methods import own_entries, select
from sleec_runtime.dispatch.layers import Layers
from sleec_runtime.dispatch.methods import Method, mark, marked_methods, refuse_misplaced
from sleec_runtime.dispatch.plain_calls import allow_calls
from sleec_runtime.dispatch.recording import recorded
from sleec_runtime.dispatch.required_code import clause_name, is_silent
from sleec_runtime.dispatch.variants import Variant, in_order
from sleec_runtime.errors import AlreadyBound, NotBound, Unbindable, UnknownLabel, UnknownObligation
from sleec_runtime.model import Clause, Rule, Ruleset
from sleec_runtime.support.messages import listed, represent

F = TypeVar("F")


class Instance:
    """The layers, the methods of rules, and the callables of obligations.

    The runtime holds its lock for changes, but not to look up variants. `takes_time` are the obligations that are not
    fulfilled when their callables return. `fitting` caches which arguments fit which code, for rules with time.
    If it `is_partial`, other processes have the code of some rules, so that these may come into force without code.
    """

    def __init__(self, ruleset: Ruleset) -> None:
        self.layers = Layers()
        self._token = object()
        self._labels: dict[str, None] = {}
        self._silent: frozenset[str] = frozenset()
        self._methods: dict[str, Method] = {}
        self._callables: dict[str, Callable[..., Any]] = {}
        self._robots: tuple[object, ...] = ()
        self.takes_time: frozenset[str] = frozenset()
        self.is_partial = False
        self.fitting: set[tuple[object, ...]] = set()
        self._variants: dict[tuple[str, int], tuple[Clause, Variant | None]] = {}
        self.admit(ruleset)

    def copied(self) -> Instance:
        """An instance with the same layers, marks and bindings. Its bindings change independently."""
        copy = object.__new__(Instance)
        copy.layers = self.layers
        copy._token = self._token
        copy._labels = self._labels
        copy._silent = self._silent
        copy._methods = dict(self._methods)
        copy._callables = dict(self._callables)
        copy._robots = self._robots
        copy.takes_time = self.takes_time
        copy.is_partial = self.is_partial
        copy.fitting = set()
        copy._variants = {}
        return copy

    @contextmanager
    def kept_on_failure(self) -> Iterator[None]:
        """Restores all bindings if the block raises."""
        before = self.copied()
        try:
            yield
        except BaseException:
            vars(self).update(vars(before))
            raise

    def admit(self, ruleset: Ruleset) -> None:
        """Adds the labels and layers of `ruleset`, so that methods can be marked for its rules."""
        self.layers.admit(ruleset)
        self._labels = {**self._labels, **dict.fromkeys(rule.label for rule in ruleset.rules)}
        self._silent |= {rule.label for rule in ruleset.rules if any(map(is_silent, rule.clauses()))}

    def known(self, label: str) -> str:
        """`label`, if it is the label of a rule. Raises UnknownLabel."""
        try:
            if label in self._labels:
                return label
        except TypeError:  # not hashable
            pass
        raise UnknownLabel(label, self._labels)

    def mark(self, label: str) -> Callable[[F], F]:
        """The decorator that marks a method as the one of rule `label`. Raises UnknownLabel."""
        silent = self.known(label) in self._silent
        return lambda method: mark(method, label, self._token, silent)

    def bind(self, targets: Iterable[object], called: Iterable[Rule] = ()) -> tuple[str, ...]:
        """Binds the marked methods of `targets` to their rules: all of them, or none. Returns the labels.

        A target is an object, a class (for its static and class methods), a module, or a function. `called` are the
        rules whose methods must support plain calls. Raises Unbindable if a target has no marked method, and as
        `allow_calls` does; AlreadyBound for a second method of a rule.
        """
        found: dict[str, Method] = {}
        targets = tuple(targets)
        for target in targets:
            methods = marked_methods(target, self._token)
            if not methods:
                raise Unbindable(
                    f"nothing in {represent(target)} is marked as the method of a rule",
                    'mark methods with @sleec.rule("label")',
                )
            for label, method in methods:
                earlier = found.get(label) or self._methods.get(label)
                if earlier is not None:
                    raise AlreadyBound(
                        f"rule `{label}` already has the method `{earlier.name}`, and `{method.name}` is another",
                        f"unbind({label!r}) first, or mark one of them only",
                    )
                found[label] = method
            refuse_misplaced(methods, self.layers)
        allow_calls(called, found, self.layers)
        self._methods.update(found)
        self.takes_time = self.takes_time.union(*map(taking_time, targets))
        self._forget(found)
        return tuple(found)

    def unbind(self, labels: Iterable[str]) -> None:
        """Removes the methods of rules. Raises UnknownLabel."""
        labels = [self.known(label) for label in labels]
        for label in labels:
            self._methods.pop(label, None)
        self._forget(labels)

    def implement(self, target: object, obligations: frozenset[str]) -> None:
        """Sets the callables of obligations, from a mapping, an object or a module.

        Raises UnknownObligation, and Unbindable for a value that is not callable or a target that implements nothing.
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
                    sought_callables(sorted(obligations), [target]) if obligations else "the rules have no obligations",
                )
            self._robots += (target,)
        self._callables.update(found)
        self.takes_time = self.takes_time.difference(found).union(
            name for name, function in found.items() if takes_time(function)
        )
        self._forget(self._labels)

    def variant(self, rule: Rule, number: int, clause: Clause) -> Variant | None:
        """The code of clause `number` of `rule`; None if nothing runs. O(1) after the first call.

        Raises NotBound if the rule has no method and an obligation of the clause has no callable, or if the method has
        no variant for a clause with obligations: the base must not run in its place.
        """
        # The same dictionary throughout: bind() replaces it, and the new one must not get variants of the old methods.
        # The clause is compared, because a dispatch may still use the rules from before a replace().
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
        """Makes plain calls of the methods of `rules` do what a dispatch does. Raises as `plain_calls.allow_calls`."""
        allow_calls(rules, self._methods, self.layers)

    def has_method(self, label: str) -> bool:
        """Whether the rule has a method. If not, its variants are composed of callables."""
        return label in self._methods

    def has_code(self, rule: Rule) -> bool:
        """Whether the rule has a method, or an obligation of it has a callable."""
        names = (literal.name for clause in rule.clauses() for literal in clause.obligations)
        return rule.label in self._methods or any(name in self._callables for name in names)

    def given(self, name: str) -> Callable[..., Any] | None:
        """The callable of an obligation, as given to `implement`."""
        return self._callables.get(name)

    def implementation(self, name: str) -> Callable[..., Any] | None:
        """The callable of an obligation, visible to recordings."""
        function = self._callables.get(name)
        return None if function is None else _seen(name, function)

    def composed(
        self,
        label: str,
        layer: str | None,
        functions: Sequence[Callable[..., Any]],
        plain: Sequence[Callable[..., Any]] = (),
    ) -> Variant:
        """A variant of rule `label` that calls `functions` in order. `plain` are the same functions without
        wrappers."""
        return Variant(label, self.layers.of(layer), own_entries(in_order(functions)), None, None, tuple(plain))

    def implementing(self) -> list[object]:
        """The objects and modules given to `implement`, and the callables of obligations."""
        return [*self._robots, *self._callables.values()]

    def objects(self) -> list[object]:
        """The objects that methods are bound to, each once."""
        return list({id(m.instance): m.instance for m in self._methods.values() if m.instance is not None}.values())

    def _written(self, rule: Rule, number: int, clause: Clause, method: Method) -> Variant | None:
        layer = self.layers.of(rule.layer(number))
        entries = select(method.definitions, layer)
        if entries is not None:
            return Variant(rule.label, layer, entries, method.instance, method.owner)
        if is_silent(clause):
            return None
        decorator = "@cop.base" if layer is None else f'@cop.around(sleec.layers["{layer.name}"])'
        raise NotBound(
            f"`{method.name}`, the method of rule `{rule.label}`, has no variant for {clause_name(rule, number)}",
            [rule.label],
            f"write it under {decorator}, and bind the method when all its variants are there",
        )

    def _composed(self, rule: Rule, number: int, clause: Clause) -> Variant | None:
        """impl(O0); …; impl(Ok): properly structured by construction (paper, Section 3.2)."""
        names = [literal.name for literal in clause.obligations if not literal.negated]
        without = [name for name in names if name not in self._callables]
        if without:
            raise NotBound(
                f"rule `{rule.label}` has no method, and there is no callable for "
                f"{listed(f'`{name}`' for name in without)} ({clause_name(rule, number)})",
                [rule.label],
                f'mark a method with @sleec.rule("{rule.label}") and bind() its object, or implement() the obligations'
                f": {sought_callables(without, self._robots)}",
            )
        if not names:
            return None
        functions = [self._callables[name] for name in names]
        seen = [_seen(name, function) for name, function in zip(names, functions)]
        return self.composed(rule.label, rule.layer(number), seen, functions)

    def _forget(self, labels: Iterable[str]) -> None:
        gone = frozenset(labels)
        self.fitting = set()
        self._variants = {key: known for key, known in tuple(self._variants.items()) if key[0] not in gone}


def _seen(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    return function if obligation_of(function) == name else recorded(name, function)
