"""The words of a conflict."""

from __future__ import annotations

from collections.abc import Sequence

from sleec_verify.results.phrases import listed, quoted


def help_for(rules: Sequence[str]) -> str:
    """How to fix a conflict of some rules."""
    if not rules:
        return "correct the constraints, or exclude the situation with ASSUME"
    if len(rules) == 1:
        return "correct the response, or exclude the situation with ASSUME"
    if len(rules) == 2:
        return "choose which rule wins, and add an UNLESS to the other; or exclude the situation with ASSUME"
    return "choose a rule that gives way, and add an UNLESS to it; or exclude the situation with ASSUME"


def subject(names: Sequence[str]) -> str:
    """The clauses of a conflict, with a verb."""
    if not names:
        return "the constraints contradict each other"
    if len(names) == 1:
        return f"{names[0]} cannot be followed"
    return f"{listed(names)} contradict each other"


def sides_in_words(positive: Sequence[str], negative: Sequence[str]) -> str:
    """``A` is required and `B` is forbidden``."""
    sides = []
    for names, word in ((positive, "required"), (negative, "forbidden")):
        if names:
            sides.append(f"{listed(map(quoted, names))} {'is' if len(names) == 1 else 'are'} {word}")
    return " and ".join(sides)


def exclusion(due: str, relations: Sequence[str]) -> str:
    """Relations and constraints that exclude what is required."""
    excludes = f"{listed(relations)} {'excludes' if len(relations) == 1 else 'exclude'}"
    return f"{due}, but {excludes} this" if due else f"{excludes} every response"
