"""Concerns, purposes and relations back to text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

from sleec_runtime.language.common.formula_printer import guard_text, print_formula
from sleec_runtime.language.common.line_printer import behind
from sleec_runtime.language.english.chain_printer import ChainPrinter, length_text
from sleec_runtime.language.english.relations import EFFECTS, OF_CONDITIONS, OF_EVENTS
from sleec_runtime.model import Claim, Comments, Effect, EventRelation, Lasting, MeasureRelation, Relation

_Value = TypeVar("_Value")


def print_beside_rules(statement: Claim | Relation) -> Iterator[str]:
    """The lines of a statement, without the comments above it."""
    if not isinstance(statement, Claim):
        yield behind(f"RELATION {_relation(statement)}", statement.comments.behind)
        return
    lines = ChainPrinter()
    lines.begin("", Comments(behind=statement.comments.behind))
    lines.write(f"{statement.kind.upper()} {statement.label} ")
    _claim(statement, lines)
    yield from lines.lines()


def _claim(claim: Claim, lines: ChainPrinter) -> None:
    lines.write(f"{claim.form.upper()} {claim.event}{guard_text(claim.condition)}")
    word = "WHILE" if claim.form == "exists" else "THEN"
    for response in claim.responses:
        lines.write(f" {word} ")
        lines.response(response)
        word = "WHILE"
    if claim.meanwhile is not None:
        lines.write(" MEANWHILE (")
        _claim(claim.meanwhile, lines)
        lines.write(")")


def _relation(relation: Relation) -> str:
    if isinstance(relation, EventRelation):
        return f"{relation.left} {_word(OF_EVENTS, relation.relation)} {relation.right}"
    if isinstance(relation, Effect):
        return f"{relation.event} {_word(EFFECTS, relation.relation)} {print_formula(relation.formula)}"
    if isinstance(relation, MeasureRelation):
        said = f"ALWAYS {print_formula(relation.left)}"
        if relation.right is None:
            return said
        return f"{said} {_word(OF_CONDITIONS, relation.relation)} {print_formula(relation.right)}"
    return _lasting(relation)


def _lasting(relation: Lasting) -> str:
    said = f"WHEN {relation.event}{guard_text(relation.condition)} THEN {print_formula(relation.formula)}"
    if relation.duration is not None:
        return f"{said} FOR {length_text(relation.duration)}"
    return f"{said} UNTIL {relation.end}{guard_text(relation.end_condition)}"


def _word(words: Mapping[str, _Value], value: _Value) -> str:
    return next(word for word, meant in words.items() if meant == value)
