"""What expressions of the target may be worth, as far as the text says: layers, marks, robots, names of modules."""

from __future__ import annotations

import ast
import builtins
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Union

from sleec_verify.conformance.structure.program import Class, Function, Scope

Kind = str
"""Of advice: around, before, after or base."""


@dataclass(frozen=True)
class Text:
    """A string (or what prints as one in an f-string)."""

    value: str


@dataclass(frozen=True)
class Api:
    """A thing of a module that is not the target's, by its dotted name: ``contextpy3.around``."""

    name: str

    @property
    def standard(self) -> bool:
        """Whether it is of the standard library. A name that is bound nowhere may be from an import with a star."""
        package, _, last = self.name.rpartition(".")
        package = package.partition(".")[0]
        return hasattr(builtins, last) if package == "builtins" else package in sys.stdlib_module_names


@dataclass(frozen=True)
class ForeignValue:
    """A value returned by code outside the target, or a literal: it is not code of the robot. `standard`: it is a
    literal, or the standard library returned it."""

    standard: bool = False


@dataclass(frozen=True)
class UnknownValue:
    """Not known before the program runs."""


@dataclass(frozen=True)
class Runtime:
    """A `sleec_runtime.Sleec`."""


@dataclass(frozen=True)
class Layers:
    """Its `layers`."""


@dataclass(frozen=True)
class Layer:
    """One of them, by its name."""

    name: str


@dataclass(frozen=True)
class OwnLayer:
    """A layer of ContextPy3 that the developer made: it belongs to no rule."""


@dataclass(frozen=True)
class RuleMark:
    """``sleec.rule(label)``; None for a label that is not known before the program runs."""

    label: str | None


@dataclass(frozen=True)
class ObligationMark:
    """``sleec_runtime.obligation(name, completes)``; None for what is not known before the program runs."""

    name: str | None
    completes: bool | None = True


@dataclass(frozen=True)
class Advice:
    """``contextpy3.around(layer, guard)`` and its kin; `base` has neither."""

    kind: Kind
    layer: Value | None = None
    guarded: bool = False


@dataclass(frozen=True)
class Module:
    scope: Scope


@dataclass(frozen=True)
class ClassOf:
    class_: Class


@dataclass(frozen=True)
class Object:
    """An instance of a class of the target. `after`: what `super()` within that class gives."""

    class_: Class
    after: Class | None = None


@dataclass(frozen=True)
class Code:
    """A function or method of the target, with the object or class through which it is accessed, if any. `definitions`
    are all definitions of the name. There are several for the variants of a layered method, and for conditional
    definitions."""

    definitions: tuple[Function, ...]
    receiver: Value | None = None


@dataclass(frozen=True)
class Table:
    """A dictionary that the text writes out; `scope` is where."""

    node: ast.Dict | ast.Call
    scope: Scope


@dataclass(frozen=True)
class MarkedCallable:
    """A callable given an obligation's name in an expression: ``obligation("OpenCurtains")(f)``."""

    name: str | None


Value = Union[
    Text, Api, ForeignValue, UnknownValue, Runtime, Layers, Layer, OwnLayer, RuleMark, ObligationMark, Advice, Module,
    ClassOf, Object, Code, Table, MarkedCallable,
]  # fmt: skip
UNKNOWN = UnknownValue()
STANDARD = ForeignValue(standard=True)

Environment = Mapping[str, Value]
NOTHING_GIVEN: Environment = {}
"""The values of the parameters of a call under way."""
