"""The random rulesets with times: they can be shown, and among them is all that they are there for."""

from __future__ import annotations

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    RELATIONS,
    Calculation,
    Claim,
    Effect,
    EventRelation,
    Lasting,
    MeasureRelation,
    formulas_of,
    literals,
    names_of,
)
from tests.support.timed_strategies import timed_ruleset

MANY = [timed_ruleset(seed) for seed in range(300)]


def test_a_seed_gives_one_ruleset_that_prints_and_reads_back():
    for seed, ruleset in enumerate(MANY[:100]):
        assert timed_ruleset(seed) == ruleset
        assert parse(print_ruleset(ruleset)) == parse(ruleset.source.text) == ruleset


def test_they_are_as_small_as_is_asked():
    for seed in range(100):
        ruleset = timed_ruleset(seed, rules=2, events=2, booleans=1, scale=False, longest=1, relations=1, hedges=1)
        assert 1 <= len(ruleset.rules) <= 2
        assert ruleset.declared["event"] == {"A", "B"}
        assert ruleset.declared["condition"] == {"m"}
        assert not ruleset.measures
        assert sum(isinstance(s, RELATIONS) for s in ruleset.statements) <= 1
        assert all(len(rule.hedges) <= 1 for rule in ruleset.rules)
        ends = [
            o.timing.window.end for o in obligations(ruleset) if o.timing is not None and o.timing.window is not None
        ]
        assert all(end is None or end.seconds in (0, 1) for end in ends)


def obligations(ruleset):
    return [o for rule in ruleset.rules for clause in rule.clauses() for o in literals(clause)]


def test_every_construct_is_among_them():
    due = [o for ruleset in MANY for o in obligations(ruleset)]
    timings = [o.timing for o in due if o.timing is not None]
    windows = [timing.window for timing in timings if timing.window is not None]
    assert any(o.negated for o in due)
    assert any(o.timing is None for o in due)
    assert any(timing.otherwise is not None and timing.otherwise.hedges for timing in timings)
    assert any(timing.instead is not None for timing in timings)
    assert any(window.end is None for window in windows)
    assert any(window.start is not None and window.start.seconds for window in windows)
    statements = [s for ruleset in MANY for s in ruleset.statements]
    assert {s.relation for s in statements if isinstance(s, (EventRelation, MeasureRelation, Effect))} == {
        *("witness", "equal", "mutualExclusive", "happenBefore"),
        *("imply", "iff", "opposite", "invariant", "causation", "includes", "forbid"),
    }
    assert {s.end is None for s in statements if isinstance(s, Lasting)} == {False, True}
    forms = {(s.kind, s.form) for s in statements if isinstance(s, Claim)}
    assert forms == {(kind, form) for kind in ("concern", "purpose") for form in ("exists", "when")}
    assert any(s.meanwhile is not None for s in statements if isinstance(s, Claim))
    assert any(ruleset.measures for ruleset in MANY)
    # Chains: what one rule obliges triggers another.
    assert any({o.name for o in obligations(ruleset)} & {rule.trigger for rule in ruleset.rules} for ruleset in MANY)


def test_measures_give_lengths_in_every_place() -> None:
    measured = [timed_ruleset(seed, lengths=True) for seed in range(100)]
    timings = [o.timing for ruleset in measured for o in obligations(ruleset) if o.timing is not None]
    windows = [timing.window for timing in timings if timing.window is not None]
    assert any(window.start is not None and window.start.measures and window.end.measures for window in windows)
    assert any(isinstance(window.end.amount, Calculation) for window in windows if window.end is not None)
    assert any(timing.otherwise is not None and timing.window.end.measures for timing in timings if timing.window)
    durations = [s.duration for ruleset in measured for s in ruleset.statements if isinstance(s, Lasting)]
    assert any(duration is not None and duration.measures for duration in durations)
    conditions = [f for ruleset in measured for rule in ruleset.rules for f in formulas_of(rule)]
    assert any({"w", "v"} & set(names_of(formula)) for formula in conditions)
    assert all(parse(print_ruleset(ruleset)) == ruleset for ruleset in measured)
