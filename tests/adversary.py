"""Random rulesets with all constructs, checked and compared with the oracle of explicit states.

``python -m tests.adversary english timed 0 5000`` compares the seeds from 0 to 4999, and prints what differs, each
ruleset as small as it still differs. The language is `english` or `dsl`, and `untimed` leaves out time. A fifth
argument is the number of seconds after which it stops.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from time import perf_counter
from typing import Any

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    And,
    Assume,
    Clause,
    Exclusive,
    Never,
    Not,
    Obligation,
    Or,
    Rule,
    Ruleset,
    Syntax,
    Timing,
)
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Unknown
from tests.support.constructs import constructs
from tests.support.explicit.conflicts import Explicit, TooLarge
from tests.support.random_rulesets import SMALL, Limits, random_ruleset

STATES, LETTERS = 150, 1_000
"""The most states, and the most instants (events with values), of rulesets that the oracle decides."""

CONSTRAINTS = (Assume, Exclusive, Never)

Sets = set[frozenset[str]]


def difference(ruleset: Ruleset) -> str:
    """How the check for conflicts differs from the oracle; empty if they agree, or if one of them does not decide.

    The instances of an ALWAYS count as one rule.
    """
    try:
        results = {result.name: result for result in run_checks(ruleset)}
    except Exception as error:  # noqa: BLE001 - any error is a defect.
        return f"{type(error).__name__}: {error}"
    whys = [r.verdict.why for r in results.values() if isinstance(r.verdict, Unknown)]
    bugs = [why for why in whys if "bug" in why]
    if bugs:
        return bugs[0]
    if "a response of the environment" in constructs(ruleset):
        # The definition leaves open which conflicts these rules have; they get a finding of their own.
        return ""
    undecided = isinstance(results["conflict"].verdict, Unknown)
    try:
        oracle = Explicit(ruleset, STATES)
        if len(oracle.subsets) * len(oracle.values) > LETTERS:
            return ""
        every = once(oracle.conflicts(), ruleset)
    except TooLarge:
        return ""
    found = once({frozenset(finding.rules) for finding in results["conflict"].findings}, ruleset)
    smallest = {rules for rules in every if not any(other < rules for other in every)}
    if not found <= every or not (undecided or smallest <= found):
        return f"expected {told(smallest)}, got {told(found)}"
    return ""


def without_domains(ruleset: Ruleset) -> Ruleset:
    """The same statements, all of them in every domain."""
    statements = (replace(s, domains=None) if isinstance(s, (Rule, *CONSTRAINTS)) else s for s in ruleset.statements)
    return replace(ruleset, statements=tuple(statements))


def once(conflicts: Sets, ruleset: Ruleset) -> Sets:
    """The conflicts with the instances of an ALWAYS as one rule."""
    return {frozenset(ruleset.by_label[label].always or label for label in rules) for rules in conflicts}


def told(conflicts: Sets) -> str:
    return ", ".join(sorted("{" + ", ".join(sorted(rules)) + "}" for rules in conflicts)) or "no conflict"


# Smaller rulesets ---------------------------------------------------------------------------------------------


def minimised(ruleset: Ruleset, fails: Callable[[Ruleset], bool]) -> Ruleset:
    """A ruleset that still fails, and of which no part can be left out."""
    for smaller in parts_left_out(ruleset):
        try:
            again = parse(print_ruleset(smaller))
        except LanguageError:
            continue
        if again.rules and fails(again):
            return minimised(again, fails)
    return ruleset


def parts_left_out(ruleset: Ruleset) -> Iterator[Ruleset]:
    names = {rule.always for rule in ruleset.rules if rule.always is not None}
    for name in names:
        yield replace(
            ruleset, statements=tuple(s for s in ruleset.statements if not isinstance(s, Rule) or s.always != name)
        )
    for number, statement in enumerate(ruleset.statements):
        rest = ruleset.statements[:number], ruleset.statements[number + 1 :]
        if not isinstance(statement, Rule) or statement.always is None:
            yield replace(ruleset, statements=(*rest[0], *rest[1]))
        if isinstance(statement, Rule) and statement.always is None:
            for smaller in smaller_values(statement):
                yield replace(ruleset, statements=(*rest[0], smaller, *rest[1]))


def smaller_values(value: Any) -> Iterator[Any]:
    """The same with one part less: a hedge, a condition, an alternative, a window or an operand."""
    if isinstance(value, (And, Or)):
        yield from value.operands
    elif isinstance(value, Not):
        yield value.operand
    elif isinstance(value, Timing):
        yield from (
            replace(value, **{name: None}) for name in ("window", "otherwise", "instead") if getattr(value, name)
        )
    elif isinstance(value, Obligation) and value.timing == Timing():
        yield replace(value, timing=None)
    optional = {Rule: ("guard",), Obligation: ("timing",)}.get(type(value), ())
    yield from (replace(value, **{name: None}) for name in optional if getattr(value, name) is not None)
    yield from _smaller_inside(value)


def _smaller_inside(value: Any) -> Iterator[Any]:
    if type(value) not in (Rule, Clause, Obligation, Timing):
        return
    for name in ("guard", "condition", "default", "timing", "otherwise", "instead"):
        inner = getattr(value, name, None)
        if inner is not None:
            yield from (replace(value, **{name: smaller}) for smaller in smaller_values(inner))
    for name in ("hedges", "obligations"):
        inside = getattr(value, name, ())
        for number, one in enumerate(inside):
            if name == "hedges" or len(inside) > 1:
                yield replace(value, **{name: (*inside[:number], *inside[number + 1 :])})
            yield from (
                replace(value, **{name: (*inside[:number], smaller, *inside[number + 1 :])})
                for smaller in smaller_values(one)
            )


def same_kind(said: str) -> Callable[[Ruleset], bool]:
    """Whether a ruleset differs as `said`: in its conflicts, or by an error."""

    def same(ruleset: Ruleset) -> bool:
        other = difference(ruleset)
        return bool(other) and ("expected" in other) == ("expected" in said)

    return same


# The campaign -------------------------------------------------------------------------------------------------


def campaign(syntax: Syntax, timed: bool, seeds: range, seconds: float, limits: Limits = SMALL) -> Counter[str]:
    """Prints the differences and returns how many rulesets were compared."""
    counted: Counter[str] = Counter()
    end = perf_counter() + seconds
    for seed in seeds:
        if perf_counter() > end:
            break
        ruleset = random_ruleset(seed, syntax, limits, timed)
        if ruleset.domains:
            ruleset = without_domains(ruleset.in_domain(ruleset.domains[0]))
            if all(rule.always for rule in ruleset.rules):
                continue
        counted["rulesets"] += 1
        said = difference(ruleset)
        if said:
            kind = re.sub(r"`[^`]*`", "`…`", said) if "expected" not in said else "another set of conflicts"
            counted[kind] += 1
            if counted[kind] <= 3:
                small = minimised(ruleset, same_kind(said))
                sys.stdout.write(f"seed {seed}: {difference(small)}\n{print_ruleset(small)}\n")
                sys.stdout.flush()
    return counted


if __name__ == "__main__":
    language, time, first, last, *rest = sys.argv[1:]
    chosen: Syntax = "dsl" if language == "dsl" else "english"
    counted = campaign(chosen, time == "timed", range(int(first), int(last)), float(rest[0]) if rest else 1e9)
    sys.stdout.write(f"{dict(counted)}\n")
