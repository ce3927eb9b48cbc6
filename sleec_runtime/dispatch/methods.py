"""The methods that are marked for rules: MM(R), the method manager of the paper (Section 3.2)."""

from __future__ import annotations

import inspect
import types
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, TypeVar

from sleec_runtime.dispatch.layered_methods import (
    Entry,
    LayeredMethod,
    inherited_entries,
    is_variant,
    layered,
    own_entries,
)
from sleec_runtime.dispatch.layers import Layers, RuleLayer
from sleec_runtime.errors import Unbindable
from sleec_runtime.support.messages import represent

F = TypeVar("F")

_MARK = "__sleec_rules__"
_METHODS = (types.FunctionType, staticmethod, classmethod, LayeredMethod)


class Method(NamedTuple):
    """MM(R): the implementations of a method, nearest definition first, and the object or class that it is bound to.
    `attribute` is the nearest definition, which a plain call finds."""

    name: str
    definitions: Sequence[Sequence[Entry]]
    instance: object
    owner: type | None
    attribute: object


def mark(method: F, label: str, token: object, silent: bool) -> F:
    """Marks `method` as the one of rule `label`, for the instance with this `token`.

    It returns the same object, a function or ContextPy3's layered method. ContextPy3 finds the earlier variants of a
    method by its name in the class body, and must find its own object there.

    A rule is `silent` if it has a hedge without obligations, which needs no variant. Then a function becomes a layered
    method immediately. So a plain call finds the layer of that hedge, even through a bound method that was read early.
    """
    if not isinstance(method, _METHODS):
        raise Unbindable(
            f"{represent(method)} cannot be the method of rule `{label}`",
            "mark a function or method, above its @cop.base or @cop.around",
        )
    if silent and not isinstance(method, LayeredMethod):
        method = layered(method)
    setattr(method, _MARK, (*getattr(method, _MARK, ()), (token, label)))
    return method


def marked_methods(target: object, token: object) -> list[tuple[str, Method]]:
    """The methods of `target` that are marked for the instance with this `token`, with the labels of their rules."""
    if isinstance(target, (types.FunctionType, LayeredMethod)):
        return [(label, _function(target)) for label in _labels(target, token)]
    if isinstance(target, types.ModuleType):
        # One function may have two names.
        functions = {id(attribute): attribute for attribute in vars(target).values()}.values()
        return [(label, _function(function)) for function in functions for label in _labels(function, token)]
    owner = target if isinstance(target, type) else type(target)
    instance = None if isinstance(target, type) else target
    # An override may be marked again.
    found = {
        (label, name): None
        for base in owner.__mro__
        for name, attribute in vars(base).items()
        for label in _labels(attribute, token)
    }
    return [(label, _of_class(name, instance, owner)) for label, name in found]


def _labels(attribute: object, token: object) -> list[str]:
    """The labels in the marks of one definition of a method, or of one of its variants."""
    if not isinstance(attribute, _METHODS):
        return []
    notes = list(getattr(attribute, _MARK, ()))
    if isinstance(attribute, LayeredMethod):
        notes += [note for entry in attribute.get_methods() for note in getattr(entry[1], _MARK, ())]
    return [label for own, label in dict.fromkeys(notes) if own is token]


def refuse_misplaced(methods: Iterable[tuple[str, Method]], layers: Layers) -> None:
    """Checks the layers of the variants of `methods`, which are given with the labels of their rules.

    Raises Unbindable for two variants on one layer, of which only one would ever run, and for a variant or advice on
    the layer of a rule of another method, which would never run.
    """
    own: dict[int, set[str]] = {}
    by_attribute = {}
    for label, method in methods:
        # By identity: two functions of a module may have one name.
        own.setdefault(id(method.attribute), set()).add(label)
        by_attribute[id(method.attribute)] = method
    for number, method in by_attribute.items():
        for definition in method.definitions:
            with_variant = [layer for layer, _, kind in definition if is_variant(kind)]
            for layer, _, kind in definition:
                if is_variant(kind) and with_variant.count(layer) > 1:
                    on = "the base" if layer is None else f"layer {getattr(layer, 'name', layer)}"
                    raise Unbindable(f"`{method.name}` has two variants on {on}", "leave one of them out")
                # A class may serve two instances: layers of the other one are not checked.
                if not isinstance(layer, RuleLayer) or layer is not layers.get(layer.name):
                    continue
                if layer.name.rpartition(".hc")[0] not in own[number]:
                    raise Unbindable(
                        f"a variant of `{method.name}` is on layer `{layer.name}`, but is the method of "
                        f"{' and '.join(sorted(own[number]))}",
                        "put it on a layer of that rule, or mark the method with the other rule too",
                    )


def _of_class(name: str, instance: object, owner: type) -> Method:
    definitions = inherited_entries(owner, name)
    if instance is None and any(
        isinstance(entry[1], types.FunctionType) for entries in definitions for entry in entries
    ):
        raise Unbindable(f"`{owner.__name__}.{name}` needs an object", f"bind an instance of {owner.__name__}")
    return Method(name, definitions, instance, owner, inspect.getattr_static(owner, name))


def _function(function: Any) -> Method:
    definition = own_entries(function)
    return Method(
        getattr(definition[0][1], "__name__", None) or represent(function), [definition], None, None, function
    )
