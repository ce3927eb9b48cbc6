"""The random rulesets have every construct of both languages, and every pair of constructs."""

from __future__ import annotations

from collections import Counter
from itertools import combinations

import pytest

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Syntax
from tests.support.constructs import constructs
from tests.support.random_rulesets import SMALL, random_ruleset

OPPOSITES = {
    ("cascade reading", "priority reading"): "a ruleset has one reading",
    ("contested", "uncontested"): "each is the absence of the other",
    ("few events", "many events"): "a ruleset has one number of events",
}
"""The pairs that no ruleset has, with the reason."""

NOTHING: frozenset[str] = frozenset()
NUMBERS = {"CONSTANT", "a named number", "a number", "a scale", "two measures", "a constant of truth"}
SHARED = {
    *("priority reading", "contested", "uncontested", "few events", "many events", "AND", "OR", "NOT"),
    *("an obligation", "a prohibition", "BY environment", "BY system", "a response of the environment", "a guard"),
    *("an act in a guard", "an input in a guard"),
    *NUMBERS,
    *(
        f"{part} {place}"
        for place in ("a rule", "a chain in parentheses")
        for part in ("a hedge of", "a hedge without a response of", "an act in a hedge of", "an input in a hedge of")
    ),
}
"""What all have: both languages, with time and without."""

TIMED = {
    *("a response that triggers a rule", "meanwhile", "an act in a claim", "an input in a claim"),
    *(f"a {kind} with {form}" for kind in ("concern", "purpose") for form in ("exists", "when")),
    *("witness", "equal", "mutualExclusive", "happenBefore", "causation", "includes", "forbid"),
    *(f"measure {each}" for each in ("imply", "iff", "mutualExclusive", "opposite", "invariant")),
    *("when ... until", "when ... for"),
    *(
        f"{part} of {literal}"
        for literal in ("an obligation", "a prohibition")
        for part in ("WITHIN", "WITHIN TO", "EVENTUALLY", "a measured window", "OTHERWISE", "ELSE")
    ),
    *(
        f"{part} {place}"
        for place in ("OTHERWISE", "ELSE", "a claim")
        for part in ("a hedge of", "a hedge without a response of", "an act in a hedge of", "an input in a hedge of")
    ),
}
ENGLISH = {
    *("cascade reading", "several obligations", "ALWAYS", "ASSUME", "EXCLUSIVE", "NEVER", "NEVER UNLESS"),
    *(f"the domain of a {each}" for each in ("Rule", "Assume", "Exclusive", "Never")),
}
KINDS = [
    pytest.param("english", True, SHARED | TIMED | ENGLISH, id="English with time"),
    pytest.param("english", False, SHARED | ENGLISH, id="English without time"),
    pytest.param("dsl", True, SHARED | TIMED | {"a calculation"}, id="the DSL with time"),
]


def drawn(number: int, syntax: Syntax, timed: bool) -> list[frozenset[str]]:
    return [constructs(random_ruleset(seed, syntax, timed=timed)) for seed in range(number)]


@pytest.mark.parametrize(("syntax", "timed", "expected"), KINDS)
def test_every_construct_occurs(syntax: Syntax, timed: bool, expected: set[str]) -> None:
    assert NOTHING.union(*drawn(500, syntax, timed)) == expected


@pytest.mark.slow
@pytest.mark.parametrize(("syntax", "timed", "expected"), KINDS)
def test_every_pair_of_constructs_occurs(syntax: Syntax, timed: bool, expected: set[str]) -> None:
    pairs = Counter(pair for found in drawn(6000, syntax, timed) for pair in combinations(sorted(found), 2))
    assert set(combinations(sorted(expected), 2)) - set(pairs) == OPPOSITES.keys() & set(
        combinations(sorted(expected), 2)
    )


@pytest.mark.parametrize(("syntax", "timed", "expected"), KINDS)
def test_a_seed_gives_one_ruleset_that_prints_and_reads_back(syntax: Syntax, timed: bool, expected: set[str]) -> None:
    for seed in range(100):
        ruleset = random_ruleset(seed, syntax, timed=timed)
        assert random_ruleset(seed, syntax, timed=timed) == ruleset
        assert parse(print_ruleset(ruleset)) == ruleset
        assert ruleset.is_timed <= timed


def test_small_ones_are_small() -> None:
    for seed in range(200):
        ruleset = random_ruleset(seed, limits=SMALL)
        assert sum(rule.always is None for rule in ruleset.rules) <= SMALL.rules
        assert 2 <= len(ruleset.declared["event"]) <= SMALL.events
