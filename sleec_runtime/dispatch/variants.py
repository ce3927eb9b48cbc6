"""Variants: the code of one clause, and how exactly one variant runs under its layer.

A variant is selected when the method is bound, and its chain of advice is kept. ContextPy3 1.0 rebuilds this chain on
every call, walks all active layers for it, and lets the last activated layer decide. A variant sees the same layers as
under ``with active_layers(layer)``.
"""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Awaitable, Callable, Generator, Sequence
from typing import Any

import contextpy3

from sleec_runtime.dispatch.layered_methods import Entry, is_variant
from sleec_runtime.dispatch.layers import RuleLayer
from sleec_runtime.dispatch.recording import is_coroutine_function, unrecorded

_TLS: Any = contextpy3._TLS
_AFTER: Any = contextpy3._after


class Variant:
    """The code of one clause: an implementation with its advice, bound to its object, and its layer."""

    __slots__ = (
        "asynchronous",
        "called",
        "chain",
        "direct",
        "fitting",
        "instance",
        "label",
        "layers",
        "owner",
        "proceeds_to",
    )

    def __init__(
        self,
        label: str,
        layer: RuleLayer | None,
        entries: Sequence[Entry],
        instance: object,
        owner: type | None,
        called: tuple[Callable[..., Any], ...] | None = None,
    ) -> None:
        """`called` are the functions that get the arguments, if that is not the implementation itself."""
        self.label = label
        self.called = _taking_arguments(entries, owner) if called is None else tuple(map(unrecorded, called))
        self.fitting: set[tuple[object, ...]] = set()
        """The shapes of arguments that fit: the number of positional arguments, and the names of the others."""
        self.layers = () if layer is None else (layer,)
        self.chain: Callable[[list[Any], tuple[Any, ...], dict[str, Any]], object]
        self.chain = contextpy3._advice.createchain([(function, kind) for _, function, kind in entries])
        self.proceeds_to = _past_the_variant(self.chain)
        self.instance = instance
        self.owner = owner
        self.direct = _without_advice(entries, instance, owner)
        """The implementation, bound to its object, if no advice comes before it."""
        self.asynchronous = any(is_coroutine_function(function) for _, function, _ in entries)


def _taking_arguments(entries: Sequence[Entry], owner: type | None) -> tuple[Callable[..., Any], ...]:
    """The implementations up to the variant, applied to their object. `proceed` gives arguments to the others."""
    found: list[Callable[..., Any]] = []
    function: Any
    for _, function, kind in entries:
        plain: Any = unrecorded(function.__func__ if isinstance(function, (staticmethod, classmethod)) else function)
        takes_object = owner is not None and not isinstance(function, staticmethod)
        # ContextPy3 passes this additional argument to after-advice.
        result = {"__result__": None} if kind is _AFTER else {}
        found.append(functools.partial(plain, *[None] * takes_object, **result))
        if is_variant(kind):
            break
    return tuple(found)


def _without_advice(entries: Sequence[Entry], instance: object, owner: type | None) -> Callable[..., object] | None:
    _, function, kind = entries[0]
    if not is_variant(kind):
        return None
    bound: Callable[..., object] = function if instance is None and owner is None else function.__get__(instance, owner)
    return bound


def _past_the_variant(chain: Any) -> Any:
    while not is_variant(type(chain)):
        chain = chain._successor
    return chain._successor


def run_under(variant: Variant, args: tuple[Any, ...], kwargs: dict[str, Any]) -> object:
    """Runs one variant under its own layer, and returns its result. Raises its error.

    Layers of this thread that belong to no rule stay active. Layers of rules do not, so that a trigger within a variant
    starts without them.
    """
    layers, context = _TLS.active_layers, _TLS.context
    _TLS.active_layers = _foreign(layers) + variant.layers if layers else variant.layers
    try:
        if variant.direct is None:
            return variant.chain([variant.instance, variant.owner, None], args, kwargs)
        # What ContextPy3's chain does for a variant without advice before it.
        _TLS.context = [variant.instance, variant.owner, variant.proceeds_to]
        return variant.direct(*args, **kwargs)
    finally:
        _TLS.active_layers, _TLS.context = layers, context


def _foreign(layers: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(layer for layer in layers if not isinstance(layer, RuleLayer))


async def await_under(variant: Variant, args: tuple[Any, ...], kwargs: dict[str, Any]) -> object:
    """Runs one variant and awaits its result, with its layer active only while its own steps run.

    ContextPy3 activates layers for a thread, and other coroutines run in the thread between two steps.
    """
    result = run_under(variant, args, kwargs)
    return await _steps(result, variant) if inspect.isawaitable(result) else result


@types.coroutine
def _steps(awaitable: Awaitable[object], variant: Variant) -> Generator[Any, Any, object]:
    steps: Any = awaitable.__await__()
    resume: Callable[[], Any] = lambda: next(steps)  # noqa: E731 - replaced below for each step
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


class Unfinished:
    """The rest of a clause whose callable returned a coroutine although it is not a coroutine function.

    To await it awaits the coroutine, and then calls the remaining callables.
    """

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


def in_order(functions: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    """A function that calls `functions` in order, and returns an `Unfinished` if one of them returns a coroutine. For
    one function, it is that function."""
    if len(functions) == 1:
        return functions[0]
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
