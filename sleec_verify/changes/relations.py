"""The relations of one side: those about every single instant, and those about several instants."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

from sleec_runtime.model import Effect, EventRelation, Formula, Lasting, MeasureRelation, Relation, Ruleset
from sleec_verify.encoding.relations import formula_at_one_instant


def relations_at_one_instant(ruleset: Ruleset) -> Iterator[tuple[str, Formula]]:
    """Each relation that excludes single instants, in words, with its formula."""
    for statement in ruleset.statements:
        if isinstance(statement, (EventRelation, MeasureRelation, Effect)) and not _happens_before(statement):
            yield _in_words(statement), formula_at_one_instant(statement)


def relations_over_time(ruleset: Ruleset) -> list[Relation]:
    """The relations about several instants."""
    return [s for s in ruleset.statements if isinstance(s, Lasting) or _happens_before(s)]


def _happens_before(statement: object) -> TypeGuard[EventRelation]:
    return isinstance(statement, EventRelation) and statement.relation == "happenBefore"


def _in_words(relation: Relation) -> str:
    from sleec_runtime.language.english.statement_printer import print_relation

    return print_relation(relation)
