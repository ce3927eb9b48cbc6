"""Sentences of FRETish have the meaning of the rules: FRET's formalization of them agrees with the evaluator of traces.

The evaluator has no values between instants, and FRET has a value for each second. There, no event occurs, and the
other values are those of the instant before.
"""

from __future__ import annotations

from collections import defaultdict
from random import Random

import pytest

from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.language import parse
from sleec_verify.exchange.compilation.fretish import FretWriter
from tests.support.fretish import satisfied
from tests.support.ruleset_traces import trace_of
from tests.support.timed_english import timed_english
from tests.support.timed_strategies import timed_ruleset

AFTER = 8
"""More seconds than any chain of windows of the random rulesets takes."""


def signals(ruleset, trace, names):
    """The values of every second from the first instant on, until all windows are over."""
    instants = {instant.time: instant for instant in trace.instants}
    ranks = {m.name: m.values for m in ruleset.measures.values() if m.kind == "scale"}
    points, held = [], {}
    for time in range(trace.instants[0].time, trace.instants[-1].time + AFTER):
        instant = instants.get(time)
        if instant is not None:
            held = {n: ranks[n].index(v) if n in ranks else v for n, v in instant.conditions.items()}
        events = frozenset() if instant is None else instant.events
        point = {name: name in events for name in ruleset.triggers | ruleset.obligations}
        points.append({names.get(name, name): value for name, value in {**point, **held}.items()})
    return points


def random_ruleset(seed):
    if seed % 4 == 3:
        return parse(timed_english(seed))
    return timed_ruleset(seed, named=seed % 4 == 0, calculations=seed % 4 == 1, lengths=seed % 8 == 2)


@pytest.mark.parametrize("start", range(0, 400, 100))
def test_the_sentences_say_what_the_evaluator_says(start):
    kept = broken = 0
    timings, reasons = set(), set()
    for seed in range(start, start + 100):
        random, ruleset = Random(seed), random_ruleset(seed)
        untimed: Untimed = "eventually" if seed % 3 == 0 else "at"
        writer = FretWriter(ruleset, untimed)
        by_statement = defaultdict(list)
        for requirement in writer.requirements():
            assert bool(requirement.sentences) != bool(requirement.reason)
            by_statement[id(requirement.statement)].append(requirement)
            reasons.add(requirement.reason)
            timings |= {s.split(" shall ")[1].split()[0] for s in requirement.sentences}
            timings |= {word for word in ("occurs", "persists") for s in requirement.sentences if f"{word}(" in s}
        for _ in range(8):
            trace = trace_of(random, ruleset)
            points = signals(ruleset, trace, dict(writer.renamed()))
            found = {id(violation.statement) for violation in violations(ruleset, trace, untimed)}
            for statement, written in by_statement.items():
                if all(requirement.sentences for requirement in written):
                    holds = all(satisfied(s, points) for requirement in written for s in requirement.sentences)
                    assert holds == (statement not in found), (written, trace, ruleset.source.text)
                    kept += holds
                    broken += not holds
    assert kept > 500
    assert broken > 200
    assert timings == {"immediately", "within", "for", "eventually", "always", "until", "occurs", "persists"}
    assert reasons == {
        None,
        *(
            f"not in FRETish: {reason}"
            for reason in (
                "a window opens after the trigger",
                "a measure gives the length of its window",
                "an alternative has no deadline",
                "it requires an earlier event",
                "it requires an event at each instant at which a condition is true",
                "its window has no length",
            )
        ),
    }
