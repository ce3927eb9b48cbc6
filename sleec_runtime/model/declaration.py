"""Declarations of names, measures and constants."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from sleec_runtime.model.comments import NO_COMMENTS, Comments
from sleec_runtime.model.number import Rational
from sleec_runtime.support.spans import NOWHERE, Span

DeclaredKind = Literal["trigger", "condition", "obligation", "event"]
Agent = Literal["system", "environment"]
MeasureKind = Literal["number", "integer", "scale"]


@dataclass(frozen=True, slots=True)
class Declaration:
    """``TRIGGER a, b``, ``CONDITION c``, ``OBLIGATION d`` or ``EVENT e BY system``.

    An event may be both a trigger and an obligation. `agent` is the agent that causes it, if the text names one.
    """

    kind: DeclaredKind
    names: tuple[str, ...]
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    name_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)
    agent: Agent | None = None


@dataclass(frozen=True, slots=True)
class Measure:
    """``MEASURE name: number``, or an ordered scale ``low < high``. `values` is the scale, lowest first.

    A number is any rational number. `declared` is False if the declaration is inferred from the use of the measure.
    """

    name: str
    kind: MeasureKind
    values: tuple[str, ...] = ()
    declared: bool = True
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Constant:
    """``CONSTANT name = value``. `alias` is the constant that defines it, if the text gives no number."""

    name: str
    value: Rational
    alias: str | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)
