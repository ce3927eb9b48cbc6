"""The implementations in a layered method of ContextPy3: its base, its variants, and their advice."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import contextpy3

from sleec_runtime.dispatch.layers import RuleLayer
from sleec_runtime.errors import Unbindable

_AROUND: Any = contextpy3._around
_NO_GUARD: Any = contextpy3._true
LayeredMethod: Any = contextpy3._layeredmethoddescriptor

Entry = tuple["RuleLayer | None", Any, Any]
"""An implementation in a method: its layer (None for the base), the function, and the kind of advice."""


def is_variant(kind: Any) -> bool:
    """Whether advice of this kind is a variant, and does not run before or after one."""
    return kind is _AROUND


def own_entries(attribute: object) -> list[Entry]:
    """The implementations in one definition of a method, the last defined first.

    A plain function is a base: `contextpy3.base` leaves one if no variant precedes it. Raises Unbindable for a variant
    with its own guard.
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
                f"a variant of `{name}` has a guard, but only the rule may choose variants",
                "make the guard a condition of the rule",
            )
        entries.append((layer, function, kind))
    return entries[::-1]


def layered(function: Any) -> Any:
    """The layered method with the base `function`, as `contextpy3.around` makes it."""
    return contextpy3.createlayeredmethod(function, [])


def silence(attribute: Any, layer: RuleLayer, asynchronous: bool) -> None:
    """Makes a plain call of a layered method do nothing under `layer`, where ContextPy3 would run the base.

    A dispatch ignores this: if the clause has obligations in a later ruleset, its variant is still missing.
    """
    if not any(entry[0] is layer and entry[1] in _SILENCES for entry in attribute.get_methods()):
        attribute.register_method(_silent_coroutine if asynchronous else _silent, _AROUND, layer)


def _silent(*args: object, **kwargs: object) -> None:
    return None


async def _silent_coroutine(*args: object, **kwargs: object) -> None:
    return None


_SILENCES = (_silent, _silent_coroutine)


def inherited_entries(owner: type, name: str) -> list[list[Entry]]:
    """The implementations of method `name` in `owner` and its bases, nearest first.

    So a subclass can override one variant and inherit the others, which a class attribute alone would hide.
    """
    return [own_entries(vars(base)[name]) for base in owner.__mro__ if name in vars(base)]


def select(definitions: Sequence[Sequence[Entry]], layer: RuleLayer | None) -> list[Entry] | None:
    """The chain of a method under `layer` (None for ε) alone: the variant, then what `proceed` reaches.

    None if no implementation is bound to the layer.
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
