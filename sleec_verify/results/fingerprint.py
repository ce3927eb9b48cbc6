"""The fingerprint of a finding: what a suppression or a baseline allows, and nothing else.

It is a hash of the finding's code, rules, clauses and obligations, and of the statements that the finding depends on.
Lines, comments and layout may change. If a statement changes, it is another finding, to be accepted again.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from hashlib import sha256
from typing import Union

from sleec_runtime.model import Constant, Declaration, Measure, Rule, Ruleset, Statement
from sleec_verify.results.finding import Finding

DIGITS = 16
"""Hexadecimal digits of a fingerprint. With 64 bits, nobody finds another finding with the same one by trying."""

Canonical = Union[str, tuple["Canonical", ...]]
"""A value as nested texts."""


def fingerprint(ruleset: Ruleset, finding: Finding) -> str:
    """The fingerprint of a finding. Linear in the text."""
    named = (finding.code, *finding.rules, "", *map(str, finding.clauses), "", *finding.obligations)
    content = (named, ruleset.reading, tuple(sorted(map(canonical, _relevant(ruleset, finding)), key=repr)))
    return sha256(repr(content).encode("utf-8", "surrogatepass")).hexdigest()[:DIGITS]


def canonical(value: object) -> Canonical:
    """What makes a value of the model equal to another one."""
    if is_dataclass(value):
        parts = (canonical(getattr(value, field.name)) for field in fields(value) if field.compare)
        return (type(value).__name__, *parts)
    if isinstance(value, (tuple, list)):
        return (type(value).__name__, *map(canonical, value))
    if isinstance(value, (set, frozenset)):
        return ("set", *sorted(map(canonical, value), key=repr))
    return f"{type(value).__name__} {value}"


def _relevant(ruleset: Ruleset, finding: Finding) -> list[Statement]:
    """The statements that a finding names, and all others that restrict the situations of their names, directly or
    through further names: assumptions, constraints, relations, definitions. Rules in between do not count."""
    places = [finding.span, *(span for span, _ in finding.related)] if finding.source is None else []
    found: list[Statement] = []
    rest: list[Statement] = []
    for statement in ruleset.statements:
        own = isinstance(statement, Rule) and statement.label in finding.rules
        at_place = any(span.start < statement.span.end and statement.span.start < span.end for span in places)
        if own or at_place:
            found.append(statement)
        elif not isinstance(statement, Rule):
            rest.append(statement)
    rest += ruleset.inferred
    names = _names(ruleset)
    reached = {name for statement in found for name in _texts(canonical(statement)) if name in names}
    while True:
        joined = [one for one in rest if not reached.isdisjoint(_texts(canonical(one)))]
        if not joined:
            return found
        found += joined
        rest = [one for one in rest if one not in joined]
        # A definition restricts its name only. Other statements relate their names.
        related = (one for one in joined if not isinstance(one, (Declaration, Constant, Measure)))
        reached |= {name for one in related for name in _texts(canonical(one)) if name in names}


def _names(ruleset: Ruleset) -> frozenset[str]:
    vocabulary = (*ruleset.triggers, *ruleset.conditions, *ruleset.obligations, *ruleset.measures, *ruleset.constants)
    return frozenset(f"str {name}" for name in vocabulary)


def _texts(value: Canonical) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    else:
        for part in value:
            yield from _texts(part)
