"""Implementations of obligations: which callable does what a rule obliges.

An obligation is implemented by the callable that is marked ``@obligation("OpenCurtains")``, or by the method that has
its name in snake case, ``open_curtains``.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from sleec_runtime.dispatch.recording import recorded
from sleec_runtime.errors import Unbindable
from sleec_runtime.support.messages import listed, represent
from sleec_runtime.support.suggestions import nearest

F = TypeVar("F", bound=Callable[..., Any])

_MARK = "__sleec_obligation__"
_TAKES_TIME = "__sleec_takes_time__"
_WORD_BORDER = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|[\s-]+")
_APOSTROPHE = re.compile("['\u2019]")


def snake_case(name: str) -> str:
    """The name of the method that implements obligation `name`: ``AskLegalPresence`` is ``ask_legal_presence``, and
    ``take the patient's coat`` is ``take_the_patients_coat``."""
    return _WORD_BORDER.sub("_", _APOSTROPHE.sub("", name)).lower()


def obligation(name: str, completes: bool = True) -> Callable[[F], F]:
    """Marks a function or method as the implementation of obligation `name`: impl(O) of the paper, Section 3.2.

    Recordings see each call of it. Set `completes` to False if the callable only starts something: the obligation is
    then fulfilled by ``sleec.completed(name)``. This matters for rules with time.
    """

    def mark(function: F) -> F:
        if isinstance(function, (staticmethod, classmethod)):
            return type(function)(mark(function.__func__))
        wrapper = recorded(name, function)
        setattr(wrapper, _MARK, name)
        setattr(wrapper, _TAKES_TIME, not completes)
        return wrapper  # type: ignore[return-value]

    return mark


def obligation_of(function: object) -> str | None:
    """The obligation that a callable is marked with; None if it has no mark."""
    name = getattr(function, _MARK, None)
    return name if isinstance(name, str) else None


def takes_time(function: object) -> bool:
    """Whether a callable is marked with ``completes=False``."""
    return getattr(function, _TAKES_TIME, False) is True


def taking_time(robot: object) -> Iterator[str]:
    """The obligations that callables of `robot` (an object, a class or a module) start and do not complete.
    O(attributes)."""
    owner = robot if isinstance(robot, type) else type(robot)
    attributes: dict[str, object] = {}
    for holder in (*reversed(owner.__mro__), robot):
        attributes.update(getattr(holder, "__dict__", {}))
    for attribute in attributes.values():
        function = _underlying(attribute)
        name = obligation_of(function)
        if name is not None and takes_time(function):
            yield name


def implementations(robot: object, obligations: Iterable[str]) -> dict[str, Callable[..., Any]]:
    """The callables of `robot` (an object or a module) that implement `obligations`. A mark has priority over a name.

    O(attributes of robot + obligations).
    """
    wanted = dict.fromkeys(obligations)
    by_mark: dict[str, Callable[..., Any]] = {}
    for attribute in dir(robot):
        # Read statically, because a property may have side effects.
        name = obligation_of(_underlying(inspect.getattr_static(robot, attribute, None)))
        if name in wanted and name is not None:
            by_mark[name] = getattr(robot, attribute)
    found: dict[str, Callable[..., Any]] = {}
    for name in wanted:
        implementation = by_mark.get(name) or getattr(robot, snake_case(name), None)
        if callable(implementation):
            found[name] = implementation
    return found


def sought_callables(obligations: Sequence[str], robots: Iterable[object]) -> str:
    """For a hint: the callables that would implement `obligations`, and similar ones that `robots` have.
    O(attributes)."""
    sought = [snake_case(name) for name in obligations]
    known = sorted({attribute for robot in robots for attribute in dir(robot) if _is_callable(robot, attribute)})
    similar = {f"`{near}`" for name in sought if (near := nearest(name, known)) is not None}
    methods = "method" if len(sought) == 1 else "methods"
    return (
        f"give an object with the {methods} {listed(f'`{name}`' for name in sought)}, "
        f'or mark a method with @sleec_runtime.obligation("{obligations[0]}")'
        + (f"; did you mean {listed(sorted(similar))}?" if similar else "")
    )


def _is_callable(robot: object, attribute: str) -> bool:
    return not attribute.startswith("_") and callable(_underlying(inspect.getattr_static(robot, attribute, None)))


def _underlying(attribute: object) -> object:
    return attribute.__func__ if isinstance(attribute, (staticmethod, classmethod)) else attribute


@contextmanager
def watched(robot: object, obligations: Iterable[str]) -> Iterator[None]:
    """Within the block, recordings also see the unmarked implementations of `robot`: instance attributes wrap its
    methods."""
    placed: list[str] = []
    # The attributes of the object itself, to be restored.
    own = dict(getattr(robot, "__dict__", {}))
    for name, function in implementations(robot, obligations).items():
        if obligation_of(function) is None:
            if not hasattr(robot, "__dict__"):
                raise Unbindable(
                    f"{represent(robot)} accepts no attributes, so its methods cannot be watched",
                    f'mark {function.__name__} with @sleec_runtime.obligation("{name}")',
                )
            # An attribute of the object hides the method of its class.
            setattr(robot, snake_case(name), recorded(name, function))
            placed.append(snake_case(name))
    try:
        yield
    finally:
        for attribute in placed:
            if attribute in own:
                setattr(robot, attribute, own[attribute])
            else:
                delattr(robot, attribute)
