"""Repairs of a rule that forbids an input: an event that only the environment causes."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Declaration, Ruleset
from sleec_verify.repairs.edit import TextEdit, joined
from sleec_verify.repairs.operators.removal import without_name
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import line_break_of
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def agents(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The declaration of the event says that the robot causes it."""
    for statement in ruleset.statements:
        if isinstance(statement, Declaration) and statement.kind == "event" and statement.agent is None:
            for at, name in enumerate(statement.names):
                if name in finding.obligations:
                    title = sentence("declare that the robot causes {name}", name=quoted(name))
                    yield Candidate("correction", title, _by_system(ruleset, statement, at))


def _by_system(ruleset: Ruleset, declaration: Declaration, at: int) -> tuple[TextEdit, ...]:
    agent = " as system" if ruleset.syntax == "dsl" else " BY system"
    end = declaration.name_spans[-1].end
    if len(declaration.names) == 1:
        return (TextEdit(end, end, agent),)
    line = f"{line_break_of(ruleset.source.text)}EVENT {declaration.names[at]}{agent}"
    return joined((*without_name(ruleset, declaration, at), TextEdit(end, end, line)))
