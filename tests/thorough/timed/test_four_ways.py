"""Four ways to say whether a trace keeps rules with time agree: the evaluator of traces, metric temporal logic, the
engine of the solver, and the runtime.

The first three judge random traces of random rulesets with every construct, and say which claims occur there. The
runtime does not judge traces: it makes them, with a robot on a virtual clock. If it raises and reports nothing, the
others find no violation. If it reports a missed deadline, they find one. It does not enforce relations, or conditions
that name a response, so the rulesets of these traces have none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from random import Random

import pytest

from sleec_runtime import errors
from sleec_runtime.evaluation.trace import Trace, Untimed
from sleec_runtime.evaluation.trace_violations import claim_holds, violations
from sleec_runtime.language import parse
from sleec_runtime.model import (
    RELATIONS,
    Assume,
    Atom,
    Calculation,
    Claim,
    Comparison,
    Exclusive,
    Never,
    Rule,
    Ruleset,
    formulas_of,
    leaves,
    literals,
    relation_name,
)
from sleec_verify.encoding.solver import Undecided
from sleec_verify.exchange.compilation.temporal_logic import claims_of, requirements
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.model import TraceModel
from sleec_verify.traces.questions import claim_occurs
from tests.support.ruleset_traces import trace_of
from tests.support.temporal_semantics import Semantics
from tests.support.timed_english import timed_english
from tests.support.timed_strategies import timed_ruleset
from tests.thorough.timed.test_times_random import LONG, STEPS, World

BINDING = (Rule, Exclusive, Never, Assume, *RELATIONS)
"""The statements that bind traces."""


def by_evaluator(ruleset: Ruleset, trace: Trace, untimed: Untimed) -> bool:
    return not violations(ruleset, trace, untimed)


def by_temporal_logic(ruleset: Ruleset, trace: Trace, untimed: Untimed) -> bool:
    semantics = Semantics(ruleset, trace.instants)
    return all(
        semantics.holds(requirement.formula, at)
        for requirement in requirements(ruleset, untimed)
        for at in range(len(trace.instants))
    )


def by_solver(index: TraceIndex, trace: Trace) -> bool:
    """Whether the formula of the engine has a model in which everything is as in the trace."""
    model = TraceModel(index)
    return has_model(model, trace, instants_of(model, trace))


def instants_of(model: TraceModel, trace: Trace) -> list[int]:
    return [model.instant(model.formula.true) for _ in trace.instants]


def has_model(model: TraceModel, trace: Trace, nodes: Sequence[int], *required: int) -> bool:
    fixed = list(required)
    for (a, earlier), (b, later) in pairwise(zip(nodes, trace.instants)):
        fixed += model.times.within(a, b, later.time - earlier.time, later.time - earlier.time)
    fixed += [model.instants[node].event(name) for node, i in zip(nodes, trace.instants) for name in sorted(i.events)]
    pinned: list[int] = []
    while model.ask_here(*fixed, *pinned):
        # The engine encodes the rules of an event once the event occurs.
        before, pinned = pinned, []
        for node, instant in zip(nodes, trace.instants):
            encoder = model.instants[node]
            encoder.settle()
            for (kind, *names), variable in list(encoder.variables.items()):
                if kind == "event":
                    pinned.append(variable if names[0] in instant.events else -variable)
                elif kind == "condition":
                    pinned.append(variable if instant.conditions[names[0]] is True else -variable)
            values = {n: v for n, v in instant.conditions.items() if not isinstance(v, bool)}
            pinned += encoder.measures.assumptions(values)
        if pinned == before:
            return True
    return False


def claims_by_solver(index: TraceIndex, trace: Trace, claim: Claim) -> bool:
    """Whether a concern or purpose occurs in a trace, which may break rules and relations."""
    for at in range(len(trace.instants)):
        model = TraceModel(index, {})
        nodes = instants_of(model, trace)
        if has_model(model, trace, nodes, *claim_occurs(model, nodes[at], claim)):
            return True
    return False


def claims_alike(ruleset: Ruleset, trace: Trace, untimed: Untimed) -> int:
    """How many claims occur in a trace. Fails if two ways differ."""
    semantics = Semantics(ruleset, trace.instants)
    alone = replace(ruleset, statements=tuple(s for s in ruleset.statements if not isinstance(s, BINDING)))
    index = TraceIndex(alone, untimed)
    count = 0
    for claim, formulas in claims_of(ruleset, untimed):
        occurs = claim_holds(claim, ruleset, trace, untimed)
        assert occurs == all(any(semantics.holds(f, at) for at in range(len(trace.instants))) for f in formulas)
        assert occurs == claims_by_solver(index, trace, claim), (claim, trace, ruleset.source.text)
        count += occurs
    return count


def judged(ruleset: Ruleset, trace: Trace, untimed: Untimed, index: TraceIndex) -> bool:
    """Whether a trace keeps the rules. Fails if two ways differ."""
    answers = {
        "evaluator": by_evaluator(ruleset, trace, untimed),
        "temporal logic": by_temporal_logic(ruleset, trace, untimed),
        "solver": by_solver(index, trace),
    }
    assert len(set(answers.values())) == 1, (answers, trace, ruleset.source.text)
    return answers["evaluator"]


def random_ruleset(seed: int) -> Ruleset:
    if seed % 4 == 3:
        return parse(timed_english(seed))
    return timed_ruleset(seed, named=seed % 4 == 0, lengths=seed % 4 == 1, calculations=seed % 8 == 2)


def features(ruleset: Ruleset) -> set[str]:
    """The constructs of a ruleset that change the meaning of its rules."""
    found = {f"reading {ruleset.reading}"}
    for statement in ruleset.statements:
        if isinstance(statement, RELATIONS):
            found.add(relation_name(statement))
        elif isinstance(statement, (Exclusive, Never, Assume)):
            found.add(type(statement).__name__)
        elif isinstance(statement, Claim):
            found |= {
                statement.kind,
                statement.form,
                "meanwhile" if statement.meanwhile is not None else statement.kind,
            }
    for rule in ruleset.rules:
        found |= {"guard"} if rule.guard is not None else set()
        found |= {"hedge"} if rule.hedges else set()
        for clause in rule.clauses():
            found |= {"empty response"} if not clause.obligations else set()
            found |= {"several obligations"} if len(clause.obligations) > 1 else set()
            for literal in literals(clause):
                found |= set(_features_of(literal))
        for formula in formulas_of(rule):
            for leaf in leaves(formula):
                found |= {f"named {leaf.kind}"} if isinstance(leaf, Atom) else set()
                if isinstance(leaf, Comparison):
                    found.add("calculation" if isinstance(leaf.left, Calculation) else "comparison")
    return found


def _features_of(literal):
    kind = "prohibition" if literal.negated else "obligation"
    timing = literal.timing
    if timing is None or timing.window is None:
        yield f"{kind} without window"
    elif timing.window.end is None:
        yield f"{kind} eventually"
    else:
        yield f"{kind} within"
        if timing.window.start is not None:
            yield "window that opens later"
        if timing.window.end.measures:
            yield "window of a measure"
    if timing is not None:
        for word, clause in (("otherwise", timing.otherwise), ("else", timing.instead)):
            if clause is not None:
                yield word
                if clause.hedges:
                    yield f"{word} with hedges"


EVERY_FEATURE = {
    *("reading cascade", "reading priority", "guard", "hedge", "empty response", "several obligations"),
    *("named trigger", "named condition", "comparison", "calculation"),
    *(
        f"{kind} {when}"
        for kind in ("obligation", "prohibition")
        for when in ("without window", "eventually", "within")
    ),
    *("window that opens later", "window of a measure"),
    *("otherwise", "else", "otherwise with hedges", "else with hedges"),
    *("witness", "equal", "mutualExclusive", "happenBefore", "causation", "includes", "forbid"),
    *("measure imply", "measure iff", "measure mutualExclusive", "measure opposite", "measure invariant"),
    *("when ... until", "when ... for", "Exclusive", "Never", "Assume"),
    *("concern", "purpose", "exists", "when", "meanwhile"),
}


@pytest.mark.parametrize("start", range(0, 400, 100))
def test_three_ways_judge_random_traces_alike(start):
    kept = broken = undecided = claimed = 0
    for seed in range(start, start + 100):
        random, ruleset = Random(seed), random_ruleset(seed)
        untimed: Untimed = "eventually" if seed % 3 == 0 else "at"
        index = TraceIndex(ruleset, untimed)
        for _ in range(6):
            trace = trace_of(random, ruleset)
            if seed % 4 != 1:
                # Without the relations, a measure that gives a length has no range.
                claimed += claims_alike(ruleset, trace, untimed)
            try:
                outcome = judged(ruleset, trace, untimed, index)
            except Undecided:
                undecided += 1
            else:
                kept += outcome
                broken += not outcome
    assert kept > 60
    assert broken > 60
    assert claimed > 20
    assert undecided < 20


def test_the_random_rulesets_have_every_feature():
    assert set().union(*(features(random_ruleset(seed)) for seed in range(400))) >= EVERY_FEATURE


def run(seed: int) -> tuple[World, str]:
    """A run of a robot, and what the runtime says of it."""
    world = World(seed, lengths=seed % 3 == 1, calculations=seed % 3 == 2)
    for number in range(1, STEPS + 1):
        try:
            world.step(number)
        except errors.ConflictInContext:
            return world, "refused"
    world.clock.advance(LONG)
    if any(not one.prohibited for one in world.sleec.pending()):
        return world, "pending"
    if not world.sleec.failures:
        return world, "kept"
    missed = all(isinstance(failure.error, errors.DeadlineMissed) for failure in world.sleec.failures)
    return world, "missed" if missed else "reported"


@pytest.mark.parametrize("start", range(0, 300, 100))
def test_the_runtime_and_the_other_three_agree(start):
    outcomes = []
    for seed in range(start, start + 100):
        world, outcome = run(seed)
        outcomes.append(outcome)
        if outcome in ("kept", "missed"):
            ruleset = world.ruleset
            assert judged(ruleset, world.trace(), "at", TraceIndex(ruleset)) == (outcome == "kept"), ruleset.source.text
    assert outcomes.count("kept") > 25
    assert outcomes.count("missed") > 5
