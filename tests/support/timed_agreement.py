"""The answers about rules with time against the second method: a direct encoding in z3 that shares nothing with the
product (tests/support/z3_oracle/).

Where the two differ, one of them may only have looked at too few instants: a trace that either shows is replayed by the
evaluator of traces first, and z3 is asked again with more.
"""

from __future__ import annotations

import sys
from itertools import combinations
from typing import Any

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import claim_holds, violations
from sleec_runtime.language import parse
from sleec_runtime.model import claims
from sleec_verify.checks import run_checks
from sleec_verify.encoding.solver import Undecided
from sleec_verify.results.finding import Unknown
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.questions import find_claim, find_trigger, find_violation
from tests.support import z3_oracle as oracle
from tests.support.timed_english import timed_english
from tests.support.timed_strategies import timed_ruleset

SIZES: tuple[dict[str, Any], ...] = (
    {"rules": 3, "events": 3, "booleans": 1, "scale": False, "longest": 2, "relations": 1, "hedges": 1},
    {"rules": 4, "events": 3, "booleans": 1, "scale": False, "longest": 3, "relations": 1, "hedges": 2},
    {"rules": 5, "events": 4, "booleans": 2, "scale": True, "longest": 3, "relations": 2, "hedges": 2},
)
"""The last of them only in the long run: a conflict among five rules with windows takes seconds."""


def answered(question):
    """The answer, or None where it is given up."""
    try:
        return question()
    except Undecided:
        return None


def compare(ruleset, untimed):
    """How many questions were answered; fails where the two methods differ."""
    index = TraceIndex(ruleset, untimed)
    count = 0
    for rule in ruleset.rules:
        answer = answered(lambda: find_violation(index, rule))  # noqa: B023
        if answer is not None:
            count += 1
            if answer.trace is not None:
                found = violations(ruleset, Trace(tuple(Instant(*one) for one in answer.trace)), untimed)
                assert found, "the trace breaks the rule"
                assert {b.statement for b in found} == {rule}
            assert_same(answer.trace is None, lambda n: oracle.redundant(ruleset, rule.label, n, untimed))  # noqa: B023
        answer = answered(lambda: find_trigger(index, rule))  # noqa: B023
        if answer is not None:
            count += 1
            if answer.trace is not None:
                assert violations(ruleset, Trace(tuple(Instant(*one) for one in answer.trace)), untimed) == ()
            theirs = oracle.vacuous(ruleset, rule.label, 4, untimed)
            # The table asks besides whether the guard can hold at all, which is the check dead-rule here.
            assert answer.trace is None or not theirs.found
            assert answer.trace is not None or theirs.moments is None
    for kind in ("concern", "purpose"):
        for claim in claims(ruleset, kind):
            answer = answered(lambda: find_claim(index, claim))  # noqa: B023
            if answer is not None:
                count += 1
                if answer.trace is not None:
                    assert violations(ruleset, Trace(tuple(Instant(*one) for one in answer.trace)), untimed) == ()
                    assert claim_holds(claim, ruleset, Trace(tuple(Instant(*one) for one in answer.trace)), untimed)
                assert_same(answer.trace is not None, lambda n: oracle.concern(ruleset, claim, n, untimed))  # noqa: B023
    return count


def conflicts(ruleset):
    """The smallest sets of rules in conflict, by z3."""
    found: set[frozenset[str]] = set()
    labels = [rule.label for rule in ruleset.rules]
    for chosen in (frozenset(some) for n in range(1, len(labels) + 1) for some in combinations(labels, n)):
        if not any(other < chosen for other in found) and oracle.conflict(ruleset, sorted(chosen)).found:
            found.add(chosen)
    return found


def compare_conflicts(first: int, last: int, lengths: bool = False) -> int:
    """How many conflicts were found; AssertionError names the ruleset about which the two methods differ."""
    total = 0
    for seed in range(first, last):
        ruleset = timed_ruleset(seed, **SIZES[0], lengths=lengths)
        (result,) = run_checks(ruleset, ["conflict"])
        found = {frozenset(finding.rules) for finding in result.findings}
        smallest = {rules for rules in found if not any(other < rules for other in found)}
        if not isinstance(result.verdict, Unknown):
            assert smallest == conflicts(ruleset), f"seed {seed}\n{ruleset.source.text}"
            total += len(smallest)
    return total


def assert_same(ours, theirs):
    """z3 looks at four instants, and at seven where it differs."""
    try:
        if ours != theirs(4).found:
            assert ours == theirs(7).found
    except oracle.Undecided:
        pass


def compare_english(first: int, last: int) -> int:
    """As `compare_all`, about rulesets in structured English."""
    total = 0
    for seed in range(first, last):
        text = timed_english(seed)
        try:
            total += compare(parse(text), ("at", "eventually")[seed % 5 == 0])
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}\n{text}") from error
    return total


def compare_all(first: int, last: int, large: bool = False) -> int:
    """How many questions were answered about the rulesets of these seeds; AssertionError names the one that differs."""
    total = 0
    for seed in range(first, last):
        ruleset = timed_ruleset(seed, **SIZES[seed % 3 if large else int(seed % 30 == 29)])
        try:
            total += compare(ruleset, ("at", "eventually")[seed % 7 == 0])
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}\n{ruleset.source.text}") from error
    return total


def compare_calculations(first: int, last: int) -> int:
    """As `compare_all`, about rulesets that calculate with two numbers."""
    total = 0
    for seed in range(first, last):
        ruleset = timed_ruleset(seed, **SIZES[0], calculations=True)
        try:
            total += compare(ruleset, "at")
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}\n{ruleset.source.text}") from error
    return total


def compare_named(first: int, last: int) -> int:
    """As `compare_all`, about rulesets whose conditions name events."""
    total = 0
    for seed in range(first, last):
        ruleset = timed_ruleset(seed, **SIZES[0], named=True)
        try:
            total += compare(ruleset, "at")
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}\n{ruleset.source.text}") from error
    return total


def compare_lengths(first: int, last: int) -> int:
    """As `compare_all`, about rulesets in which measures give lengths of windows."""
    total = 0
    for seed in range(first, last):
        ruleset = timed_ruleset(seed, **SIZES[seed % 2], lengths=True)
        try:
            total += compare(ruleset, ("at", "eventually")[seed % 7 == 0])
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}\n{ruleset.source.text}") from error
    return total


if __name__ == "__main__":
    sys.stdout.write(str(compare_all(int(sys.argv[1]), int(sys.argv[2]))))
