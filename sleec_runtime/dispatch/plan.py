"""The plan of a dispatch: what it will run in one context."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from sleec_runtime.dispatch.variants import Variant
from sleec_runtime.errors import NeedsAwait, WrongArguments
from sleec_runtime.evaluation.due import Due
from sleec_runtime.support.messages import represent, text_of

Args = tuple[Any, ...]
Kwargs = dict[str, Any]
"""The arguments of a trigger."""


class ActiveClause(NamedTuple):
    """The label of a rule, and the number of its active clause: 0 is the default, i has the layer ``label.hci``."""

    rule: str
    clause: int


class Plan:
    """The decisions and variants of a dispatch, checked before anything runs. Immutable.

    `mark` is that of the snapshot for which its conflicts were checked.
    """

    __slots__ = (
        "asynchronous",
        "clauses",
        "decisions",
        "fitting",
        "mark",
        "obligations",
        "prohibitions",
        "ready_for",
        "triggers",
        "variants",
    )

    def __init__(self, triggers: tuple[str, ...], due: Due, variants: tuple[Variant, ...], mark: object) -> None:
        self.triggers = triggers
        self.decisions = due.decisions
        self.variants = variants
        self.mark = mark
        self.obligations = due.obligations
        self.prohibitions = due.prohibitions
        self.clauses = tuple(ActiveClause(d.rule.label, d.clause) for d in due.decisions)
        self.asynchronous = any(variant.asynchronous for variant in variants)
        self.fitting: set[tuple[object, ...]] = set()
        """The shapes of arguments that fit all variants: see `Variant.fitting`."""
        self.ready_for: set[int] = set()
        """The numbers of positional arguments, without others, with which the plan has been run."""

    def refuse_misfits(self, args: Args, kwargs: Kwargs) -> None:
        """Raises WrongArguments if the arguments do not fit the code of a rule. O(1) after the first of a shape."""
        shape = (len(args), *kwargs)
        if shape in self.fitting:
            return
        for variant in self.variants:
            # Plans end with their context; variants stay.
            if shape not in variant.fitting:
                for function in variant.called:
                    refuse_misfit(variant.label, function, args, kwargs)
                variant.fitting.add(shape)
        self.fitting.add(shape)

    def refuse_coroutines(self) -> None:
        """Raises NeedsAwait if a variant is a coroutine function."""
        if self.asynchronous:
            raise NeedsAwait(
                f"a variant of {' and '.join(self.triggers)} is a coroutine function", "await trigger_async(…) instead"
            )


def refuse_misfit(label: str, function: Callable[..., Any], args: tuple[Any, ...], kwargs: Mapping[str, Any]) -> None:
    """Raises WrongArguments if the arguments do not fit `function`, which is code of rule `label`."""
    import inspect

    try:
        # The signature of the wrapper, which may take other arguments than the function that it wraps.
        signature = inspect.signature(function, follow_wrapped=False)
    except (TypeError, ValueError):
        # A builtin without a signature: the call itself will raise.
        return
    try:
        signature.bind(*args, **kwargs)
    except TypeError as error:
        plain = getattr(function, "func", function)
        name = getattr(plain, "__name__", None) or represent(plain)
        raise WrongArguments(
            f"`{name}`, the code of rule `{label}`, cannot be called with these arguments: {error}",
            f"give the trigger the arguments of {name}{text_of(signature)}; nothing was executed",
        ) from None
