"""Plain calls of bound methods under globally active layers, as ContextPy3 dispatches them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sleec_runtime.dispatch.layered_methods import LayeredMethod, select, silence
from sleec_runtime.dispatch.layers import Layers, RuleLayer
from sleec_runtime.dispatch.methods import Method
from sleec_runtime.dispatch.recording import is_coroutine_function
from sleec_runtime.dispatch.required_code import clause_name, is_silent
from sleec_runtime.errors import Unbindable
from sleec_runtime.model import Rule


def allow_calls(rules: Iterable[Rule], methods: Mapping[str, Method], layers: Layers) -> None:
    """Makes plain calls of the `methods` of `rules`, under globally active layers, do what a dispatch does.

    A clause without obligations may have no variant. ContextPy3 would run the base there, so an empty variant is added.
    Raises Unbindable for a method that a plain call cannot dispatch: a definition in a subclass hides its variants, or
    it has no layers.
    """
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
                    f"a plain call of `{method.name}` finds no variant for {clause_name(rule, number)} of rule "
                    f"`{rule.label}`: a definition in a subclass hides it",
                    "write all variants in one class, or use trigger()",
                )
            if layer is None or not is_silent(clause):
                continue
            if not isinstance(method.attribute, LayeredMethod):
                raise Unbindable(
                    f"a plain call of `{method.name}` runs its base if {clause_name(rule, number)} is active, although "
                    "that clause has no code",
                    f'write an empty variant under @cop.around(sleec.layers["{layer.name}"]), or use trigger()',
                )
            silent.append((method, layer))
    for method, layer in silent:
        base = select(method.definitions, None) or ()
        silence(method.attribute, layer, any(is_coroutine_function(function) for _, function, _ in base))
