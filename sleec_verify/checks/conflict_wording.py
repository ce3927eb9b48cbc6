"""The words of a conflict."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sleec_verify.checks.relevant_rules import relation_in_words
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.query.inconsistent_sets import InconsistentSet
    from sleec_verify.results.finding import Finding


def help_for(rules: Sequence[str]) -> str:
    """How to fix a conflict of some rules."""
    if not rules:
        return sentence("correct the constraints, or exclude the situation with ASSUME")
    if len(rules) == 1:
        return sentence("correct the response, or exclude the situation with ASSUME")
    if len(rules) == 2:
        return sentence("choose which rule wins, and add an UNLESS to the other; or exclude the situation with ASSUME")
    return sentence("choose a rule that gives way, and add an UNLESS to it; or exclude the situation with ASSUME")


def subject(names: Sequence[str]) -> str:
    """The clauses of a conflict, with a verb."""
    if not names:
        return sentence("the constraints contradict each other")
    if len(names) == 1:
        return sentence("{name} cannot be followed", name=names[0])
    return sentence("{names} contradict each other", names=listed(names))


def sides_in_words(positive: Sequence[str], negative: Sequence[str]) -> str:
    """``A` is required and `B` is forbidden``."""
    sides = []
    if positive:
        names = listed(map(quoted, positive))
        sides.append(plural(len(positive), "{names} is required", "{names} are required", names=names))
    if negative:
        names = listed(map(quoted, negative))
        sides.append(plural(len(negative), "{names} is forbidden", "{names} are forbidden", names=names))
    return listed(sides) if sides else ""


def both_sides(names: Sequence[str]) -> str:
    """``A` is both required and forbidden``."""
    return plural(
        len(names),
        "{names} is both required and forbidden",
        "{names} are both required and forbidden",
        names=listed(map(quoted, names)),
    )


def exclusion(due: str, relations: Sequence[str]) -> str:
    """Relations and constraints that exclude what is required."""
    number, said = len(relations), listed(relations)
    if not due:
        return plural(
            number, "{relations} excludes every response", "{relations} exclude every response", relations=said
        )
    return plural(
        number,
        "{due}, but {relations} excludes this",
        "{due}, but {relations} exclude this",
        due=due,
        relations=said,
    )


def reason(ruleset: Ruleset, clash: InconsistentSet) -> str:
    """Why literals cannot be due together."""
    positive = sorted(one.name for one in clash.literals if not one.negated)
    negative = sorted(one.name for one in clash.literals if one.negated)
    if not clash.origins:
        return both_sides(positive[:1])
    return exclusion(sides_in_words(positive, negative), [relation_in_words(ruleset, one) for one in clash.origins])


def rejection(finding: Finding) -> str:
    """Why a check is undecided if the evaluator does not agree with a finding."""
    return sentence(
        "the replay rejected a witness; this is a bug in sleec-verify: {finding}",
        finding=finding.message,
    )
