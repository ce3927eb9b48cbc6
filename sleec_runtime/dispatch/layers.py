"""The boundary to ContextPy3: layers of clauses, the variants of a method, and running exactly one of them.

All that is known of ContextPy3's insides is in this file. A variant is picked from the method here and its chain of
advice kept, because ContextPy3 1.0 rebuilds it on every call, walks all active layers for it, and lets the layer that
was activated last decide. What a variant sees is what it would see under ``with active_layers(layer)``.
"""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Awaitable, Callable, Generator, Iterator, Mapping, Sequence
from typing import Any

import contextpy3

from sleec_runtime.dispatch.implementations import is_coroutine_function, unrecorded
from sleec_runtime.errors import Unbindable, UnknownLayer
from sleec_runtime.model import Ruleset

_TLS: Any = contextpy3._TLS
_AROUND: Any = contextpy3._around
_AFTER: Any = contextpy3._after
_NO_GUARD: Any = contextpy3._true
LayeredMethod: Any = contextpy3._layeredmethoddescriptor

Entry = tuple["RuleLayer | None", Any, Any]
"""One implementation in a method: its layer (None for the base), the function, and the kind of advice."""


class RuleLayer(contextpy3.Layer):  # type: ignore[misc]
    """ℓ(R)i, the layer of a hedge clause (paper, Section 3.2). One object a name for the life of an instance."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name


class Layers(Mapping[str, RuleLayer]):
    """The layers by name: ``layers["dress_assist.hc1"]``. An unknown name raises UnknownLayer."""

    def __init__(self) -> None:
        self._layers: dict[str, RuleLayer] = {}

    def admit(self, ruleset: Ruleset) -> None:
        """Makes the layers of `ruleset` known. Those whose names are known already stay the objects that they are."""
        names = (rule.layer(number) for rule in ruleset.rules for number, _ in enumerate(rule.clauses()))
        added = {name: RuleLayer(name) for name in names if name is not None and name not in self._layers}
        # Another dictionary, so that a thread that goes through the layers is not disturbed.
        self._layers = {**self._layers, **added}

    def of(self, name: str | None) -> RuleLayer | None:
        """The layer of that name; None stands for ε."""
        return None if name is None else self[name]

    def __getitem__(self, name: str) -> RuleLayer:
        try:
            return self._layers[name]
        except (KeyError, TypeError):
            raise UnknownLayer(name, self._layers) from None

    def __contains__(self, name: object) -> bool:
        return name in self._layers

    def __iter__(self) -> Iterator[str]:
        return iter(self._layers)

    def __len__(self) -> int:
        return len(self._layers)


class Variant:
    """What runs for one clause: an implementation with its advice, bound to its object, and the layer it runs under."""

    __slots__ = ("asynchronous", "called", "chain", "fitting", "instance", "label", "layers", "owner", "proceeds_to")

    def __init__(
        self,
        label: str,
        layer: RuleLayer | None,
        entries: Sequence[Entry],
        instance: object,
        owner: type | None,
        called: tuple[Callable[..., Any], ...] | None = None,
    ) -> None:
        """`called` are what takes the arguments in the end, where that is not the implementation itself."""
        self.label = label
        self.called = _taking_arguments(entries, owner) if called is None else tuple(map(unrecorded, called))
        self.fitting: set[tuple[object, ...]] = set()
        """The shapes of arguments that these are known to take: how many, and the names of those given by name."""
        self.layers = () if layer is None else (layer,)
        self.chain: Callable[[list[Any], tuple[Any, ...], dict[str, Any]], object]
        self.chain = contextpy3._advice.createchain([(function, kind) for _, function, kind in entries])
        self.proceeds_to = _past_the_variant(self.chain)
        self.instance = instance
        self.owner = owner
        self.asynchronous = any(is_coroutine_function(function) for _, function, _ in entries)


def _taking_arguments(entries: Sequence[Entry], owner: type | None) -> tuple[Callable[..., Any], ...]:
    """The implementations up to the variant, as they are when its object is given: what is beyond gets its arguments
    from `proceed`."""
    found: list[Callable[..., Any]] = []
    function: Any
    for _, function, kind in entries:
        plain: Any = unrecorded(function.__func__ if isinstance(function, (staticmethod, classmethod)) else function)
        takes_object = owner is not None and not isinstance(function, staticmethod)
        # ContextPy3 gives this one argument more to advice that comes after.
        result = {"__result__": None} if kind is _AFTER else {}
        found.append(functools.partial(plain, *[None] * takes_object, **result))
        if kind is _AROUND:
            break
    return tuple(found)


def _past_the_variant(chain: Any) -> Any:
    while type(chain) is not _AROUND:
        chain = chain._successor
    return chain._successor


def is_variant(kind: Any) -> bool:
    """Whether an implementation of this kind of advice is a variant of its own, and not run before or after one."""
    return kind is _AROUND


def own_entries(attribute: object) -> list[Entry]:
    """The implementations in one definition of a method, the last defined first.

    A plain function is a base: it is what `contextpy3.base` leaves when no variant came before it. Raises Unbindable
    for a variant with a guard of its own.
    """
    if not isinstance(attribute, LayeredMethod):
        return [(None, attribute, _AROUND)]
    entries: list[Entry] = []
    for layer, function, kind, guard, *_ in attribute.get_methods():
        if function in _SILENCES:
            continue
        if guard is not _NO_GUARD:
            name = contextpy3.get_method_name(function)
            raise Unbindable(
                f"a variant of {name} has a guard, so that something besides the rule would choose it",
                "make the guard a condition of the rule",
            )
        entries.append((layer, function, kind))
    return entries[::-1]


def layered(function: Any) -> Any:
    """The method whose base is `function`, ready for variants: what `contextpy3.around` makes of it."""
    return contextpy3.createlayeredmethod(function, [])


def silence(attribute: Any, layer: RuleLayer, asynchronous: bool) -> None:
    """Has a plain call of a layered method do nothing under `layer`, where ContextPy3 would go on to the base.

    A dispatch does not see it: if the clause comes to oblige something, its variant is missing as before.
    """
    if not any(entry[0] is layer and entry[1] in _SILENCES for entry in attribute.get_methods()):
        attribute.register_method(_silent_coroutine if asynchronous else _silent, _AROUND, layer)


def _silent(*args: object, **kwargs: object) -> None:
    return None


async def _silent_coroutine(*args: object, **kwargs: object) -> None:
    return None


_SILENCES = (_silent, _silent_coroutine)


def inherited_entries(owner: type, name: str) -> list[list[Entry]]:
    """The implementations of method `name` in `owner` and its bases, nearest first. A subclass may so override one
    variant and inherit the others, which a class attribute alone would hide."""
    return [own_entries(vars(base)[name]) for base in owner.__mro__ if name in vars(base)]


def select(definitions: Sequence[Sequence[Entry]], layer: RuleLayer | None) -> list[Entry] | None:
    """The chain of a method under `layer` (None for ε) and no other: its variant, then what `proceed` would reach.

    None if no implementation is bound to that layer.
    """
    base = _nearest(definitions, None)
    if layer is None:
        return base
    variant = _nearest(definitions, layer)
    return None if variant is None else variant + (base or [])


def _nearest(definitions: Sequence[Sequence[Entry]], layer: RuleLayer | None) -> list[Entry] | None:
    chain: list[Entry] = []
    for definition in definitions:
        chain += [entry for entry in definition if entry[0] is layer]
        if any(kind is _AROUND for _, _, kind in chain):
            return chain
    return None


def run_all(
    variants: Sequence[Variant], args: tuple[Any, ...], kwargs: dict[str, Any]
) -> tuple[list[object], list[tuple[str, Exception]]]:
    """Runs the variants one after the other, each under its own layer: the results, and what was raised.

    A variant that raises does not keep the next from running, because what one rule obliges is due whatever becomes
    of another's. Layers that this thread activated and that are of no rule stay active; those of rules do not, so that
    a trigger within a variant starts afresh.
    """
    layers, context = _TLS.active_layers, _TLS.context
    foreign = _foreign(layers) if layers else ()
    results: list[object] = []
    errors: list[tuple[str, Exception]] = []
    try:
        for variant in variants:
            _TLS.active_layers = foreign + variant.layers
            result: object = None
            try:
                result = variant.chain([variant.instance, variant.owner, None], args, kwargs)
            except Exception as error:  # noqa: BLE001 - raised again once all have run
                errors.append((variant.label, error))
            results.append(result)
    finally:
        _TLS.active_layers, _TLS.context = layers, context
    return results, errors


def _foreign(layers: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(layer for layer in layers if not isinstance(layer, RuleLayer))


async def await_under(variant: Variant, args: tuple[Any, ...], kwargs: dict[str, Any]) -> object:
    """Runs one variant and awaits what it returns, its layer active in each of its steps and in no one else's.

    ContextPy3 knows threads only; between two steps of a coroutine, others run in the same thread.
    """
    (result,), errors = run_all((variant,), args, kwargs)
    if errors:
        raise errors[0][1]
    return await _steps(result, variant) if inspect.isawaitable(result) else result


@types.coroutine
def _steps(awaitable: Awaitable[object], variant: Variant) -> Generator[Any, Any, object]:
    steps: Any = awaitable.__await__()
    resume: Callable[[], Any] = lambda: next(steps)  # noqa: E731 - replaced below by what each step brings
    own_context = [variant.instance, variant.owner, variant.proceeds_to]
    while True:
        layers, context = _TLS.active_layers, _TLS.context
        _TLS.active_layers, _TLS.context = _foreign(layers) + variant.layers, own_context
        try:
            awaited = resume()
        except StopIteration as stop:
            return stop.value
        finally:
            own_context = _TLS.context
            _TLS.active_layers, _TLS.context = layers, context
        try:
            sent = yield awaited
        except GeneratorExit:
            steps.close()
            raise
        except BaseException as thrown:  # noqa: BLE001 - handed to the variant, which may catch it
            resume = _thrower(steps, thrown)
        else:
            resume = _sender(steps, sent)


def _sender(steps: Any, value: object) -> Callable[[], Any]:
    return lambda: next(steps) if value is None else steps.send(value)


def _thrower(steps: Any, error: BaseException) -> Callable[[], Any]:
    return lambda: steps.throw(error)
