"""Conversion of a ruleset to another language or reading, without changing what any situation obliges (docs/dsl.md).

Constructs that the other language does not have are rejected, never dropped.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from sleec_runtime.errors import LanguageError, Unsayable
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    Assume,
    Declaration,
    DeclaredKind,
    Dialect,
    Exclusive,
    Never,
    Reading,
    Rule,
    Ruleset,
    Statement,
)
from sleec_verify.encoding.name_uses import names_used
from sleec_verify.exchange.conversion.readings import with_reading

Target = Literal["english", "dsl", "legos"]
TARGETS: tuple[Target, ...] = ("english", "dsl", "legos")
_DIALECTS: dict[Target, Dialect] = {"dsl": "sleec-tk", "legos": "legos"}


@dataclass(frozen=True)
class Conversion:
    """The converted text, its ruleset, and notes about the differences."""

    text: str
    ruleset: Ruleset
    notes: Sequence[str] = ()


def of_domain(ruleset: Ruleset, domain: str) -> Ruleset:
    """The rules and constraints that apply in `domain`, as a ruleset without domains. Rules keep their labels, also
    numbers.

    Raises:
        Unsayable: no rule applies there, and a text needs one.
    """
    statements: list[Statement] = []
    rules = 0
    for statement in ruleset.in_domain(domain).statements:
        if isinstance(statement, Rule):
            rules += statement.always is None
            labelled = statement.labelled or (statement.always is None and statement.label != f"rule_{rules}")
            statements.append(replace(statement, domains=None, labelled=labelled))
        elif isinstance(statement, (Exclusive, Never, Assume)):
            statements.append(replace(statement, domains=None))
        else:
            statements.append(statement)
    if not rules:
        raise Unsayable(f"no rule applies in the domain `{domain}`", "choose another domain")
    part = replace(ruleset, statements=tuple(statements))
    compared = names_used(part)["condition"]
    return _declared(replace(part, inferred=tuple(measure for measure in part.inferred if measure.name in compared)))


def _declared(part: Ruleset) -> Ruleset:
    """`part` with declarations of the names whose kind would differ without the other rules of the whole ruleset."""
    # If a text declares names of a kind, it must declare all names of that kind.
    undeclared = part.triggers - part.declared["trigger"]
    if not undeclared <= {rule.trigger for rule in part.rules if rule.always is None}:
        part = replace(part, statements=(Declaration("trigger", tuple(sorted(undeclared))), *part.statements))
    again = parse(print_ruleset(replace(part, statements=tuple(_without_obligations(part.statements)))))
    kinds: tuple[tuple[DeclaredKind, frozenset[str], frozenset[str]], ...] = (
        ("trigger", part.triggers, again.triggers),
        ("condition", part.conditions, again.conditions),
        ("obligation", part.obligations, again.obligations),
    )
    events = part.declared["event"]
    new = (
        Declaration(kind, tuple(sorted(names)))
        for kind, names, found in kinds
        if names - found - part.declared[kind] - events
    )
    return replace(part, statements=(*new, *part.statements))


def _without_obligations(statements: Iterable[Statement]) -> Iterator[Statement]:
    """The statements without declarations of obligations, which would reject a condition that is read as one."""
    for statement in statements:
        if isinstance(statement, Declaration) and statement.kind == "event":
            yield replace(statement, kind="trigger", agent=None)
        elif not isinstance(statement, Declaration) or statement.kind != "obligation":
            yield statement


def convert(ruleset: Ruleset, to: Target, reading: Reading | None = None) -> Conversion:
    """`ruleset` in the language `to`, with its hedges rewritten for `reading` if that differs from its own.

    Without `reading`, structured English keeps the ruleset's reading and states it; the DSL has only `priority`.

    Raises:
        Unsayable: the language does not have a construct of the ruleset.
    """
    notes: list[str] = []
    if to == "english":
        from sleec_verify.exchange.conversion.to_english import to_english

        converted, notes = to_english(with_reading(ruleset, reading or ruleset.reading))
    else:
        if reading == "cascade":
            raise Unsayable("the DSL has only the reading priority", "omit --reading")
        from sleec_verify.exchange.conversion.to_dsl import to_dsl

        converted, notes = to_dsl(with_reading(ruleset, "priority"), _DIALECTS[to])
    text = print_ruleset(converted)
    try:
        again = parse(text)
    except LanguageError as error:
        first = error.problems[0]
        raise Unsayable(f"the other language cannot express this: {first.message}", first.hint) from None
    if replace(again, dialect=converted.dialect) != converted:
        raise AssertionError("the converted text would have another meaning; this is a bug in sleec-verify")
    return Conversion(text, again, notes)
