"""A ruleset in the DSL as text, in one canonical form: the text parses to the same ruleset.

There is one definition, rule, exception, claim or relation per line, and an empty line between two statements where the
author left one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from sleec_runtime.errors import Unsayable
from sleec_runtime.language.common.comment_lines import comment_lines, split_heading, trimmed, with_gaps
from sleec_runtime.language.common.formula_printer import print_number
from sleec_runtime.language.dsl.statement_printer import INDENT, DslPrinter
from sleec_runtime.model import (
    Claim,
    Constant,
    Declaration,
    Effect,
    EventRelation,
    Lasting,
    Measure,
    MeasureRelation,
    Rule,
    Ruleset,
    Statement,
)

_REPEATED = re.compile(r"#\d+$")


def print_dsl(ruleset: Ruleset) -> str:
    """`ruleset` as a text in the DSL, with its comments, ending in a line break (or empty).

    Raises:
        Unsayable: the DSL cannot express something in it.
    """
    return "".join(f"{line}\n" for line in _lines(ruleset))


def _lines(ruleset: Ruleset) -> Iterator[str]:
    printer = DslPrinter(ruleset.dialect or "legos")
    block: str | None = None
    for statement in ruleset.statements:
        own = _block(statement)
        above: Sequence[str] = with_gaps(statement.comments.above)
        if own != block:
            heading, above = split_heading(statement.comments.above, True)
            if block is not None:
                yield f"{block}_end"
                yield ""
            yield from comment_lines(heading)
            yield f"{own}_start"
            block = own
        printer.begin(INDENT, above, statement.comments.behind)
        _write(statement, printer)
        yield from printer.take_lines()
    if block is not None:
        yield f"{block}_end"
    closing = trimmed(ruleset.closing_comments)
    if closing:
        if block is not None:
            yield ""
        yield from comment_lines(closing)


def _write(statement: Statement, printer: DslPrinter) -> None:
    if isinstance(statement, Rule):
        printer.rule(_label(statement.label), statement)
    elif isinstance(statement, Claim):
        printer.write(f"{_label(statement.label)} ")
        printer.claim(statement)
    elif isinstance(statement, (EventRelation, MeasureRelation, Effect, Lasting)):
        printer.write(printer.relation(statement))
    elif isinstance(statement, (Declaration, Measure, Constant)):
        printer.write(_definition(statement, "-> " if printer.is_legos else ""))


def _definition(statement: Declaration | Measure | Constant, before_alias: str) -> str:
    if isinstance(statement, Constant):
        alias = statement.alias and before_alias + statement.alias
        return f"constant {statement.name} = {alias or print_number(statement.value)}"
    if isinstance(statement, Measure):
        scale = f"scale({', '.join(statement.values)})" if statement.kind == "scale" else "numeric"
        return f"measure {statement.name}: {scale}"
    (name,) = statement.names
    if statement.kind == "condition":
        return f"measure {name}: boolean"
    return f"event {name} as {statement.agent}" if statement.agent else f"event {name}"


def _label(label: str) -> str:
    """A label as it is written: the parser adds a number to the second of two equal labels."""
    return _REPEATED.sub("", label)


def _block(statement: Statement) -> str:
    if isinstance(statement, Rule):
        return "rule"
    if isinstance(statement, Claim):
        return statement.kind
    if isinstance(statement, (EventRelation, MeasureRelation, Effect, Lasting)):
        return "relation"
    if isinstance(statement, Constant):
        return "def"
    if isinstance(statement, Measure) or (isinstance(statement, Declaration) and len(statement.names) == 1):
        return "def"
    raise Unsayable(f"the DSL has no {type(statement).__name__.upper()} statement")
