"""Mutants of the engine for conflicts over time: none of them can show a false conflict."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from sleec_runtime.evaluation.trace import Instant
from sleec_runtime.language import parse
from sleec_runtime.model import Clause, Obligation
from sleec_verify.checks import run_checks
from sleec_verify.encoding.solver import Undecided
from sleec_verify.results.finding import Refuted, Unknown
from sleec_verify.traces import demands
from sleec_verify.traces.components import components
from sleec_verify.traces.conflicts import ConflictSearch
from sleec_verify.traces.index import TraceIndex
from tests.support.explicit.conflicts import Explicit

Rules = tuple[str, ...]
RULES: tuple[Rules, ...] = (
    ("A then X within 2 seconds otherwise Y within 1 seconds", "B then not X within 3 seconds"),
    ("A then X otherwise Y within 1 seconds", "A then not X within 1 seconds"),
    ("A then X within 1 seconds otherwise Y within 1 seconds", "A then not X within 1 seconds", "A then not Y"),
    ("A then X within 2 seconds else Y within 1 seconds", "B then not X within 2 seconds"),
    ("A then X within 2 seconds", "A then not X within 1 seconds"),
    ("A then X within [1,2] seconds", "B then not X within [2,3] seconds", "A then Y within 1 seconds"),
    ("A then X within [0,1] seconds", "A then not X within [1,2] seconds"),
    ("A then X eventually", "A then not X within 2 seconds"),
    ("A then X eventually", "A then not X within [1,2] seconds"),
    ("A then X within 1 seconds", "A then not X"),
    (
        "A then X within 1 seconds otherwise {Y within 1 seconds unless {b} then Z within 1 seconds}",
        "A then not X within 1 seconds",
        "A then not Y within 3 seconds",
    ),
    (
        "A then X within 1 seconds else {Y within 1 seconds unless {b} then Z within 1 seconds}",
        "A then not X within 1 seconds",
        "A then not Z within 3 seconds",
    ),
    (
        "A then X within 1 seconds else {Y within 1 seconds unless {b} then Z within 1 seconds}",
        "A then not X within 1 seconds",
        "A and {b} then not Y within 3 seconds",
    ),
    ("A then X else Y", "A then not X within 1 seconds"),
    ("A then X within 2 seconds", "B then not X within 1 seconds"),
    ("A then X", "B then not X within [1,2] seconds"),
    ("A then X within [1,1] seconds", "B then not X within [1,2] seconds"),
    ("A then X within 1 seconds", "X then not Z within 1 seconds", "A then Z within 2 seconds"),
)
"""Rules with conflicts that a small change of their meaning removes or adds."""


def text(rules: Rules) -> str:
    events = " ".join(f"event {name}" for name in "ABXYZ")
    stated = "\n".join(f"  R{number} when {rule}" for number, rule in enumerate(rules, 1))
    return f"def_start {events} measure b: boolean def_end\nrule_start\n{stated}\nrule_end\n"


@cache
def automaton(rules: Rules) -> Explicit:
    return Explicit(parse(text(rules)))


# The mutants ----------------------------------------------------------------------------------------------------

Change = Callable[[Obligation], Obligation]
Window = tuple[int, "int | None"]
_demand, _window, _of_clause = demands.Responses._demand, demands.Responses.window, demands.Responses.of_clause


def of_obligations(change: Change) -> dict[str, Any]:
    def changed(self: Any, obligation: Obligation, *rest: Any) -> Any:
        return _demand(self, change(obligation), *rest)

    return {"_demand": changed}


def of_windows(change: Callable[[Obligation, Window], Window]) -> dict[str, Any]:
    return {"window": lambda self, obligation: change(obligation, _window(self, obligation))}


def without(field: str) -> Change:
    def change(obligation: Obligation) -> Obligation:
        timing = obligation.timing
        return obligation if timing is None else replace(obligation, timing=replace(timing, **{field: None}))

    return change


def first_clause_only(self: Any, clause: Clause, *rest: Any) -> Any:
    return _of_clause(self, replace(clause, hedges=()), *rest)


def last_clause_only(self: Any, clause: Clause, *rest: Any) -> Any:
    return _of_clause(self, clause.hedges[-1] if clause.hedges else clause, *rest)


def due_at_the_trigger(self: Any, clause: Clause, chain: Any, kept: bool = True, after: int = 0) -> Any:
    return _of_clause(self, clause, chain, kept, 0)


def longer(window: Window, seconds: int) -> Window:
    return window[0], None if window[1] is None else window[1] + seconds


MUTANTS: dict[str, dict[str, Any]] = {
    "no otherwise": of_obligations(without("otherwise")),
    "no else": of_obligations(without("instead")),
    "no window": of_obligations(without("window")),
    "an exception of an alternative is left out": {"of_clause": first_clause_only},
    "an exception of an alternative decides always": {"of_clause": last_clause_only},
    "an alternative is due at the trigger": {"of_clause": due_at_the_trigger},
    "an obligation ends early": of_windows(lambda o, w: w if o.negated else longer(w, -1)),
    "a prohibition ends late": of_windows(lambda o, w: longer(w, 1) if o.negated else w),
    "an obligation starts late": of_windows(lambda o, w: w if o.negated else (w[0] + 1, w[1])),
    "a prohibition starts at once": of_windows(lambda o, w: (0, w[1]) if o.negated else w),
    "a prohibition does not end": of_windows(lambda o, w: (w[0], None) if o.negated else w),
    "an obligation is due at the start": of_windows(lambda o, w: w if o.negated else (w[0], w[0])),
    "an obligation is due at the end": of_windows(lambda o, w: w if o.negated or w[1] is None else (w[1], w[1])),
    "eventually is at once": of_windows(lambda o, w: (w[0], w[0]) if w[1] is None else w),
}


Situation = tuple[frozenset[str], Sequence[Instant]]
"""The rules of a conflict, and the instants up to now."""


def proposed(rules: Rules) -> list[Situation]:
    """The conflicts that the engine proposes."""
    found: list[Situation] = []
    for component in components(TraceIndex(parse(text(rules)))):
        try:
            for one in ConflictSearch(component).find():
                instants = [Instant(i.time, frozenset(i.events), i.conditions) for i in (*one.history, one.now)]
                found.append((frozenset(one.rules), instants))
        except Undecided:
            continue
    return found


def shown(rules: Rules) -> list[Situation]:
    """The conflicts that a check shows."""
    (result,) = run_checks(parse(text(rules)), ["conflict"])
    found: list[Situation] = []
    for finding in result.verdict.findings if isinstance(result.verdict, (Refuted, Unknown)) else ():
        assert finding.witness is not None
        instants = [Instant(0, frozenset(finding.witness.triggers), finding.witness.conditions)]
        if finding.timeline is not None:
            instants = [Instant(m.time, frozenset(m.events), m.conditions) for m in finding.timeline.moments]
        found.append((frozenset(finding.rules), instants))
    return found


def is_true(rules: Rules, situation: Situation) -> bool:
    """Whether the rules are in conflict in the situation, by the explicit automaton."""
    labels, (*history, now) = situation
    oracle = automaton(rules)
    every = frozenset(range(len(oracle.rules)))
    chosen = frozenset(n for n in every if oracle.rules[n].label in labels)
    by_time = {instant.time: instant for instant in history}
    state = oracle.first
    for time in range(now.time):
        instant = by_time.get(time)
        after = oracle.after_silence(state)
        if instant is not None:
            lawful = oracle.after(state, instant.events, valuation(oracle, instant), every)
            assert lawful is not None
            after = lawful
        state = after
        if any(False in demands for demands in state.pending):
            return False
    values = valuation(oracle, now)
    return not oracle.complies(state, now.events, values, chosen) and all(
        oracle.complies(state, now.events, values, chosen - {one}) for one in chosen
    )


def valuation(oracle: Explicit, instant: Instant) -> int:
    """The number of the values of an instant, where a condition that is not shown is false."""
    return next(
        n
        for n, values in enumerate(oracle.values)
        if all(value == instant.conditions.get(name, False) for name, value in values.items())
    )


@pytest.mark.parametrize("name", MUTANTS)
def test_a_mutant_shows_no_false_conflict(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    for attribute, mutated in MUTANTS[name].items():
        monkeypatch.setattr(demands.Responses, attribute, mutated)
    assert not all(is_true(rules, one) for rules in RULES for one in proposed(rules)), "no false conflict is proposed"
    assert all(is_true(rules, one) for rules in RULES for one in shown(rules))


def test_without_a_mutant_all_conflicts_are_shown() -> None:
    for rules in RULES:
        every = automaton(rules).conflicts()
        found = shown(rules)
        assert all(is_true(rules, one) for one in found)
        assert {labels for labels, _ in found} == {one for one in every if not any(other < one for other in every)}
