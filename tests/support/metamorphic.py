"""Changes of a ruleset that change no answer, and what of an answer they leave as it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from typing import Any, NamedTuple

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    SECONDS,
    Assume,
    Atom,
    Declaration,
    Exclusive,
    Length,
    Measure,
    MeasureRelation,
    Never,
    Not,
    Number,
    Or,
    Rule,
    Ruleset,
    Span,
)
from sleec_verify.checks import run_checks
from sleec_verify.exchange.conversion import convert
from sleec_verify.results.finding import Finding, Unknown

CHECKS = (
    *("conflict", "vacuous-conflict", "dead-rule", "dead-hedge", "redundant-rule", "redundant-hedge"),
    *("concern", "purpose"),
)


class Answer(NamedTuple):
    """Whether a check is decided, and what its findings name: code, rules, clauses, and obligations."""

    undecided: bool
    findings: frozenset[tuple[Any, ...]]


def answers(ruleset: Ruleset) -> dict[str, Answer]:
    """The instances of an ALWAYS count as one rule: their labels depend on names and order."""
    return {
        result.name: Answer(
            isinstance(result.verdict, Unknown), frozenset(_named(finding, ruleset) for finding in result.findings)
        )
        for result in run_checks(ruleset)
        if result.name in CHECKS
    }


def _named(finding: Finding, ruleset: Ruleset) -> tuple[Any, ...]:
    """Which rules explain a finding other than a conflict can depend on their order, if several sets do."""
    labels = {rule.label: rule.always or rule.label for rule in ruleset.rules}
    rules = [labels.get(rule, rule) for rule in finding.rules]
    if finding.check != "conflict":
        return finding.code, tuple(rules[:1])
    clauses = sorted((labels[clause.rule], clause.clause) for clause in finding.clauses)
    return finding.code, tuple(sorted(rules)), tuple(clauses)


def differences(ruleset: Ruleset, other: Ruleset) -> dict[str, tuple[Answer | None, Answer | None]]:
    """For each check whose answers differ, both."""
    one, two = answers(ruleset), answers(other)
    return {name: (one.get(name), two.get(name)) for name in CHECKS if one.get(name) != two.get(name)}


# Changes ------------------------------------------------------------------------------------------------------


def rewritten(value: Any, change: Callable[[Any], Any]) -> Any:
    """A value of the model with `change` applied to each part of it, from the inside."""
    if isinstance(value, tuple):
        return tuple(rewritten(part, change) for part in value)
    if is_dataclass(value) and not isinstance(value, (type, Span)):
        parts = {f.name: rewritten(getattr(value, f.name), change) for f in fields(value) if f.compare}
        return change(replace(value, **parts))
    return change(value) if isinstance(value, str) else value


def in_seconds(ruleset: Ruleset) -> Ruleset:
    """All lengths that numbers give, in seconds."""

    def change(value: Any) -> Any:
        if isinstance(value, Length) and isinstance(value.amount, Number):
            return Length(Number(value.amount.value * SECONDS[value.unit]), "seconds")
        return value

    return again(replace(ruleset, statements=rewritten(ruleset.statements, change)))


def reversed_rules(ruleset: Ruleset) -> Ruleset:
    """The rules from the last to the first; each other statement keeps its place."""
    rules = iter(reversed([s for s in ruleset.statements if isinstance(s, Rule) and s.always is None]))
    statements = (next(rules) if isinstance(s, Rule) and s.always is None else s for s in ruleset.statements)
    return again(replace(ruleset, statements=tuple(statements)))


def renamed(ruleset: Ruleset) -> Ruleset:
    """Other names for events, conditions and measures, in the opposite order: A becomes ZA, B becomes YB."""
    names = {name for s in ruleset.statements if isinstance(s, Declaration) for name in s.names}
    names |= {s.name for s in ruleset.statements if isinstance(s, Measure)}
    fresh = {name: f"{chr(ord('Z') - number)}{name}" for number, name in enumerate(sorted(names))}
    return again(replace(ruleset, statements=rewritten(ruleset.statements, lambda value: fresh.get(value, value))))


def with_tautology(ruleset: Ruleset) -> Ruleset:
    """With the assumption that a condition is true or false."""
    condition = Atom("condition", min(ruleset.conditions))
    formula = Or((condition, Not(condition)))
    more = Assume(formula) if ruleset.syntax == "english" else MeasureRelation("invariant", formula)
    return again(replace(ruleset, statements=(*ruleset.statements, more)))


def in_one_domain(ruleset: Ruleset) -> Ruleset:
    """All rules and constraints in one domain. The DSL has no domains."""
    if ruleset.syntax == "dsl":
        return ruleset
    kinds = (Rule, Assume, Never, Exclusive)
    statements = tuple(replace(s, domains=("ward",)) if isinstance(s, kinds) else s for s in ruleset.statements)
    return again(replace(ruleset, statements=statements))


def there_and_back(ruleset: Ruleset) -> Ruleset:
    """Converted to the other language and back."""
    there = parse(convert(ruleset, "english" if ruleset.syntax == "dsl" else "legos").text)
    return parse(convert(there, "legos" if ruleset.syntax == "dsl" else "english").text)


def again(ruleset: Ruleset) -> Ruleset:
    """Printed and parsed, as `fmt` does."""
    return parse(print_ruleset(replace(ruleset, source=type(ruleset.source)("<memory>", ""))))


CHANGES: dict[str, Callable[[Ruleset], Ruleset]] = {
    "fmt": again,
    "other names": renamed,
    "rules reordered": reversed_rules,
    "a tautological assumption": with_tautology,
    "seconds": in_seconds,
    "one domain": in_one_domain,
}
