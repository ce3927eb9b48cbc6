"""The constructs of a ruleset that need time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.errors import UnsupportedTimes
from sleec_runtime.model.relation import RELATIONS, relation_name
from sleec_runtime.model.response import Timing
from sleec_runtime.model.rule import Rule
from sleec_runtime.model.ruleset import Ruleset
from sleec_runtime.support.messages import listed
from sleec_runtime.support.spans import Span


class Construct(NamedTuple):
    """A construct that needs time: its name, and its place in the text."""

    name: str
    span: Span


def constructs(ruleset: Ruleset) -> Iterator[Construct]:
    """The timings and relations of a ruleset, in text order.

    Concerns and purposes are not included: they are questions about the rules and change no meaning.
    """
    for statement in ruleset.statements:
        if isinstance(statement, Rule):
            for clause in statement.clauses():
                for obligation in clause.obligations:
                    if obligation.timing is not None:
                        yield from _timing_constructs(obligation.timing)
        elif isinstance(statement, RELATIONS):
            yield Construct(f"the relation {relation_name(statement)}", statement.span)


def _timing_constructs(timing: Timing) -> Iterator[Construct]:
    if timing.window is not None:
        yield Construct("eventually" if timing.window.end is None else "within", timing.window.span)
    if timing.otherwise is not None:
        yield Construct("otherwise", timing.otherwise.span)
    if timing.instead is not None:
        yield Construct("else", timing.instead.span)


def require_untimed(ruleset: Ruleset, who: str) -> None:
    """Raises UnsupportedTimes if `ruleset` has times or relations. `who` names what does not support them."""
    found = list(constructs(ruleset))
    if found:
        lines = [ruleset.source.place(construct.span).line for construct in found]
        said = listed([f"{construct.name} in line {line}" for construct, line in zip(found, lines)])
        raise UnsupportedTimes(f"{who} does not support times and relations yet: {said}", lines)
