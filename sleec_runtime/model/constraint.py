"""Constraints: forbidden combinations, and assumptions about situations."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Union

from sleec_runtime.model.comments import NO_COMMENTS, Comments
from sleec_runtime.model.formula import And, Formula
from sleec_runtime.support.spans import NOWHERE, Span


@dataclass(frozen=True, slots=True)
class Exclusive:
    """``EXCLUSIVE a, b, …``: at most one of these obligations is due at a time."""

    names: tuple[str, ...]
    domains: tuple[str, ...] | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    name_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Never:
    """``NEVER formula``: a formula over obligations, triggers and conditions that must not become true.

    ``NEVER formula UNLESS c`` is ``NEVER formula AND NOT c``: the last operands of `formula`, as many as `exceptions`,
    are the negated conditions.
    """

    formula: Formula
    domains: tuple[str, ...] | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)
    exceptions: int = 0

    @property
    def forbidden(self) -> Formula:
        """The formula before the first UNLESS."""
        if not self.exceptions or not isinstance(self.formula, And):
            return self.formula
        rest = self.formula.operands[: -self.exceptions]
        return rest[0] if len(rest) == 1 else And(rest, self.formula.span)


@dataclass(frozen=True, slots=True)
class Assume:
    """``ASSUME formula``: a formula over triggers and conditions that holds in every situation. Contexts that break it
    are ignored."""

    formula: Formula
    domains: tuple[str, ...] | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


Constraint = Union[Exclusive, Never, Assume]
