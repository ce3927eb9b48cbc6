"""What a repair changes by brute force, and what its effect line says, without the code that compares rulesets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from random import Random
from typing import NamedTuple

from sleec_runtime.model import Assume, Context, Formula, Not, Or, Ruleset, Value
from sleec_verify.changes.relations import relations_at_one_instant
from tests.support import brute_force
from tests.support.repairs import broken, choices

_NAMED = re.compile(
    r"((?:`[^`]+`(?:, | and )?)+) (?:is|are) (no longer|now) (required|forbidden)(?: immediately| `[^`]+`)?"
)
_WINDOW = re.compile(r" (?:within|eventually|otherwise|else)\b", re.IGNORECASE)


class Changed(NamedTuple):
    """The names that are no longer, or now, required or forbidden; and whether constraints exclude less or more, and
    whether situations are excluded or allowed again."""

    lost: frozenset[tuple[str, str]]
    gained: frozenset[tuple[str, str]]
    excludes_less: bool
    excludes_more: bool
    fewer_situations: bool
    more_situations: bool


def said(effect: str) -> Changed:
    """What an effect line says."""
    names: dict[str, set[tuple[str, str]]] = {"no longer": set(), "now": set()}
    constraints = {"no longer": False, "now": False}
    for part in effect.split("; "):
        if re.match("`(NEVER|EXCLUSIVE) ", part):
            constraints["no longer"] |= part.endswith("no longer forbidden")
            constraints["now"] |= part.endswith("now forbidden")
            continue
        for listed, way, role in _NAMED.findall(part):
            names[way].update((_WINDOW.split(name)[0], role) for name in re.findall("`([^`]+)`", listed))
    return Changed(
        frozenset(names["no longer"]),
        frozenset(names["now"]),
        constraints["no longer"],
        constraints["now"],
        "assumed not to occur" in effect,
        "allowed again" in effect,
    )


def changed(old: Ruleset, new: Ruleset) -> Changed:
    """What differs in some situation, whether the rules contradict each other there or not."""
    lost, gained = set(), set()
    less = more = fewer = further = False
    for context in brute_force.contexts(_with_every_situation(old)):
        allowed, allowed_after = (_is_allowed(ruleset, context, old) for ruleset in (old, new))
        fewer |= allowed and not allowed_after
        further |= allowed_after and not allowed
        if not (allowed and allowed_after):
            continue
        one, other = (_literals(ruleset, context) for ruleset in (old, new))
        lost |= one - other
        gained |= other - one
        for done in choices(old):
            excluded, excluded_after = (broken(ruleset, context, done) for ruleset in (old, new))
            less |= excluded and not excluded_after
            more |= excluded_after and not excluded
    return Changed(frozenset(lost), frozenset(gained), less, more, fewer, further)


def _literals(ruleset: Ruleset, context: Context) -> set[tuple[str, str]]:
    return {(o.name, "forbidden" if o.negated else "required") for o in brute_force.due(ruleset, context)}


def _with_every_situation(ruleset: Ruleset) -> Ruleset:
    """The ruleset with the names of its assumptions, which exclude nothing."""
    statements = (
        replace(one, formula=Or((one.formula, Not(one.formula)))) if isinstance(one, Assume) else one
        for one in ruleset.statements
    )
    return replace(ruleset, statements=tuple(statements))


def _is_allowed(ruleset: Ruleset, context: Context, vocabulary: Ruleset) -> bool:
    return all(
        brute_force.value(one.formula, context, measures=vocabulary.measures)
        for one in ruleset.constraints
        if isinstance(one, Assume)
    )


Names = frozenset[tuple[str, str]]


def sampled(old: Ruleset, new: Ruleset, random: Random, number: int) -> tuple[Names, Names]:
    """The names that are lost and gained in situations of one trigger, in `number` samples for each trigger."""
    lost, gained = set(), set()
    given = [formula for ruleset in (old, new) for formula in _assumed(ruleset)]
    for trigger in sorted(old.triggers):
        for _ in range(number):
            values: dict[str, Value] = {name: random.random() < 0.5 for name in sorted(old.conditions)}
            values |= {name: random.choice(brute_force.values_of(old, name)) for name in sorted(old.measures)}
            context = Context(frozenset((trigger,)), values)
            if all(brute_force.value(formula, context, measures=old.measures) for formula in given):
                one, other = (_literals(ruleset, context) for ruleset in (old, new))
                lost |= one - other
                gained |= other - one
    return frozenset(lost), frozenset(gained)


def _assumed(ruleset: Ruleset) -> Iterator[Formula]:
    """What holds in every situation."""
    yield from (one.formula for one in ruleset.constraints if isinstance(one, Assume))
    if ruleset.is_timed:
        yield from (formula for _, formula in relations_at_one_instant(ruleset))
