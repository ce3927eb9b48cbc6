"""From the DSL to structured English."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.errors import Unsayable
from sleec_runtime.model import Declaration, Kind, Ruleset, Span, Statement


def in_english(ruleset: Ruleset) -> Ruleset:
    """`ruleset` as structured English says it; an event is declared as what the rules use it for.

    Raises:
        Unsayable: it holds times, concerns, purposes, relations, or what is read only because others read it.
    """
    if ruleset.syntax == "english":
        return replace(ruleset, reading_stated=True)
    if ruleset.is_timed:
        _refuse_times(ruleset)
    for defect in ruleset.defects:
        _refuse(ruleset, defect.message, defect.span, defect.help)
    statements = tuple(said for s in ruleset.statements for said in _said(s, ruleset))
    return replace(ruleset, statements=statements, syntax="english", dialect=None, reading_stated=True)


def _said(statement: Statement, ruleset: Ruleset) -> Iterator[Statement]:
    if not isinstance(statement, Declaration) or statement.kind != "event":
        yield statement
        return
    if statement.agent is not None:
        said = f"structured English cannot say that an event is the {statement.agent}'s"
        _refuse(ruleset, said, statement.span, "leave `as` and what follows it out")
    (name,) = statement.names
    obliged = name in ruleset.obligations
    kinds: list[Kind] = []
    if any(rule.trigger == name for rule in ruleset.rules) or not obliged:
        kinds.append("trigger")
    if obliged:
        kinds.append("obligation")
    first, *others = kinds
    yield replace(statement, kind=first)
    for kind in others:
        yield Declaration(kind, (name,))


def _refuse_times(ruleset: Ruleset) -> None:
    from sleec_runtime.model_time import Claim, constructs

    for construct in constructs(ruleset):
        _refuse(ruleset, f"structured English has no words yet for {construct.name}", construct.span, None)
    for statement in ruleset.statements:
        if isinstance(statement, Claim):
            said = f"structured English has no words yet for the {statement.kind} {statement.label}"
            _refuse(ruleset, said, statement.span, None)


def _refuse(ruleset: Ruleset, message: str, span: Span, hint: str | None) -> None:
    place = ruleset.source.place(span)
    raise Unsayable(f"{ruleset.source.path}:{place.line}:{place.column}: {message}", hint)
