"""Errors for constructs that the DSL does not have, with their places in the text."""

from __future__ import annotations

from typing import NoReturn

from sleec_runtime.errors import Unsayable
from sleec_runtime.model import Constant, Declaration, Measure, Ruleset, Span, Statement


def refuse(ruleset: Ruleset, message: str, span: Span | None = None, hint: str | None = None) -> NoReturn:
    if span:
        place = ruleset.source.place(span)
        message = f"{ruleset.source.path}:{place.line}:{place.column}: {message}"
    raise Unsayable(message, hint)


def defined_names(statement: Statement) -> tuple[str, ...]:
    """The names that a statement defines, without the values of a scale."""
    if isinstance(statement, Declaration):
        return statement.names
    return (statement.name,) if isinstance(statement, (Measure, Constant)) else ()
