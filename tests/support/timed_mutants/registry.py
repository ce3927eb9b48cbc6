"""Mutants of the robot with deadlines, each with one fault, and what a test must say about it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple


class Mutant(NamedTuple):
    """A faulty robot; the kinds of fault, the obligations and the rules that a test may name."""

    make: Callable[[Any], object]
    kinds: frozenset[str]
    names: frozenset[str]
    rules: frozenset[str]


MUTANTS: dict[str, Mutant] = {}


def mutant(kinds: str, names: str, rules: str) -> Callable[[Any], Any]:
    def add(make: Any) -> Any:
        MUTANTS[make.__name__] = Mutant(
            make, frozenset(kinds.split(", ")), frozenset(names.split()), frozenset(rules.split())
        )
        return make

    return add
