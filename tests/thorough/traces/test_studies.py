"""The studies by a second road: z3, which shares no code with the engine, and brute force for rules without time."""

from __future__ import annotations

from itertools import combinations

import pytest

from sleec_runtime.language import load
from sleec_runtime.model import Rule, Ruleset, literals
from sleec_verify.checks import run_checks
from tests.support import brute_force, z3_oracle
from tests.support.studies import OWN
from tests.support.timed_agreement import compare

LARGE = ("dairy", "greenhouse", "luggage", "museum", "packing", "physiotherapy", "pool")
"""Studies that take z3 more than a few seconds."""

STUDIES = [
    pytest.param(
        path.stem,
        domain,
        id=f"{path.stem}-{domain}" if domain else path.stem,
        marks=pytest.mark.long if path.stem.startswith(LARGE) else pytest.mark.slow,
    )
    for path in sorted(OWN.glob("*.sleec"))
    for domain in load(path).domains or (None,)
]
each_study = pytest.mark.parametrize(("name", "domain"), STUDIES)

NAMED_INPUTS = {("museum-guide", frozenset({"alarm_still", "closing"}))}
"""Conflicts that need an input that only a condition names. The oracle does not look for them."""
UNDECIDED = {("parcel-drone-revised", frozenset({"deliver", "keep_out"}))}
"""Pairs that z3 does not decide."""


def study(name: str, domain: str | None) -> Ruleset:
    ruleset = load(OWN / f"{name}.sleec")
    return ruleset.in_domain(domain) if domain else ruleset


def conflicts(ruleset: Ruleset) -> set[frozenset[str]]:
    (result,) = run_checks(ruleset, ["conflict"])
    return {frozenset(finding.rules) for finding in result.findings}


@each_study
def test_z3_gives_the_same_answers_about_traces(name: str, domain: str | None) -> None:
    assert compare(study(name, domain), "at") > 0


@each_study
def test_z3_finds_the_same_conflicts(name: str, domain: str | None) -> None:
    """z3 confirms each smallest set, and no other pair of rules where one forbids an event that the other names."""
    ruleset = study(name, domain)
    found = conflicts(ruleset)
    for rules in found:
        if (name, rules) not in NAMED_INPUTS and not any(other < rules for other in found):
            assert z3_oracle.conflict(ruleset, sorted(rules)).found, rules
    for one, other in combinations(ruleset.rules, 2):
        pair = frozenset({one.label, other.label})
        contested = forbidden(one) & named(other) or forbidden(other) & named(one)
        if contested and (name, pair) not in UNDECIDED and not any(rules <= pair for rules in found):
            assert not z3_oracle.conflict(ruleset, sorted(pair)).found, pair


def forbidden(rule: Rule) -> set[str]:
    return {o.name for clause in rule.clauses() for o in literals(clause) if o.negated}


def named(rule: Rule) -> set[str]:
    return {rule.trigger, *(o.name for clause in rule.clauses() for o in literals(clause))}


@pytest.mark.long
@pytest.mark.parametrize("domain", ["day", "night"])
def test_brute_force_finds_the_same_conflicts(domain: str) -> None:
    ruleset = study("lone-companion", domain)
    (result,) = run_checks(ruleset, ["conflict"])
    found = {frozenset((rule, clause) for rule, clause in finding.clauses) for finding in result.findings}
    assert found == brute_force.causes(ruleset)
