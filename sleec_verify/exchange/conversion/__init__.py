"""A ruleset in another language or reading, obliging the same in every situation (docs/dsl.md).

What the other language cannot say is refused, never dropped.
"""

from __future__ import annotations

from collections.abc import Sequence
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
    """A text that obliges the same, the ruleset that it spells out, and what to know about it."""

    text: str
    ruleset: Ruleset
    notes: Sequence[str] = ()


def of_domain(ruleset: Ruleset, domain: str) -> Ruleset:
    """What counts in `domain`, as a ruleset without domains. Rules keep their labels, also those that are numbers.

    Raises:
        Unsayable: no rule counts there, and a text needs one.
    """
    statements: list[Statement] = []
    rules = 0
    for statement in ruleset.in_domain(domain).statements:
        if isinstance(statement, Rule):
            rules += 1
            labelled = statement.labelled or statement.label != f"rule_{rules}"
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
    """`part` with declarations of the names that it would take for something else than the whole ruleset did, which has
    more rules to tell by."""
    # A text that declares its conditions takes no other name in a condition, and one that declares a trigger all.
    undeclared = part.triggers - part.declared["trigger"]
    if not undeclared <= {rule.trigger for rule in part.rules}:
        part = replace(part, statements=(Declaration("trigger", tuple(sorted(undeclared))), *part.statements))
    again = parse(print_ruleset(part))
    kinds: tuple[tuple[DeclaredKind, frozenset[str], frozenset[str]], ...] = (
        ("trigger", part.triggers, again.triggers),
        ("condition", part.conditions, again.conditions),
        ("obligation", part.obligations, again.obligations),
    )
    new = (Declaration(kind, tuple(sorted(names))) for kind, names, found in kinds if names - found)
    return replace(part, statements=(*new, *part.statements))


def convert(ruleset: Ruleset, to: Target, reading: Reading | None = None) -> Conversion:
    """`ruleset` in the language `to`, its hedges rewritten for `reading` if that is another than its own.

    Without `reading`, structured English keeps the ruleset's reading and states it; the DSL has only `priority`.

    Raises:
        Unsayable: something in it cannot be said there.
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
