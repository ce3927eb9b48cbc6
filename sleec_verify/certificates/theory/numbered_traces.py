"""Rules with time, traces and claims as questions of the oracle (`proofs/oracle/traces.ml`): names as numbers.

A comparison is a condition of the theory, and a length that measures give is a measure in seconds. Their values at an
instant are computed here, independently of the evaluator of the runtime.
"""

from __future__ import annotations

import operator
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import prod

from sleec_runtime.errors import SleecError
from sleec_runtime.model import (
    RELATIONS,
    SECONDS,
    And,
    Assume,
    Atom,
    Calculation,
    Claim,
    Clause,
    Comparison,
    Effect,
    EventRelation,
    Exclusive,
    Formula,
    Length,
    Measure,
    MeasureRef,
    MeasureRelation,
    Never,
    Not,
    Number,
    Obligation,
    Or,
    Rational,
    Rule,
    Ruleset,
    ScaleValue,
    Term,
    Truth,
    Value,
    Window,
)
from sleec_verify.replay.trace_evaluator import Instant, Requirement, Trace, Untimed

OPERATORS = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    "!=": operator.ne,
    ">=": operator.ge,
    ">": operator.gt,
}
BETWEEN_EVENTS = {"witness": "witness", "equal": "equal", "mutualExclusive": "exclusive", "happenBefore": "before"}
BETWEEN_MEASURES = {"imply": "imply", "iff": "iff", "mutualExclusive": "not-both", "opposite": "not-both"}


class NotCovered(SleecError):
    """The theory does not cover a part of the question."""


class NumberedTraces:
    """The questions about the traces of one ruleset. `laws` are the statements that a trace may break."""

    def __init__(self, ruleset: Ruleset, untimed: Untimed) -> None:
        self.laws: Sequence[Requirement] = [
            s for s in ruleset.statements if isinstance(s, (Rule, Exclusive, Never, Assume, *RELATIONS))
        ]
        self._measures = ruleset.measures
        self._events: dict[str, int] = {}
        self._conditions: dict[str | Comparison, int] = {}
        self._lengths: dict[Length, int] = {}
        words = [word for law in self.laws for word in self._law(law)]
        self.line = " ".join(("laws", ruleset.reading, untimed, str(len(self.laws)), *words))

    # Questions ------------------------------------------------------------------------------------------------

    def trace(self, trace: Trace) -> str:
        """What the trace breaks, and what it breaks so far. Make the claims before: they have names of their own."""
        return " ".join(("trace", *_listed([list(self._instant(instant)) for instant in trace.instants])))

    def claims(self, claim: Claim) -> str:
        """Whether the last trace brings a claim about, and its `meanwhile`."""
        several = [claim]
        while several[-1].meanwhile is not None:
            several.append(several[-1].meanwhile)
        return " ".join(("claims", *_listed([list(self._claim(one)) for one in several])))

    def broken(self, answer: str, trace: Trace) -> list[tuple[Requirement, int]]:
        """The violations that an answer names by their places."""
        places = [tuple(map(int, word.split("."))) for word in answer.split()[1:]]
        return [(self.laws[law], trace.instants[instant].time) for instant, law in places]

    # Names ----------------------------------------------------------------------------------------------------

    def _event(self, name: str) -> str:
        return str(self._events.setdefault(name, len(self._events) + 1))

    def _instant(self, instant: Instant) -> Iterator[str]:
        values = instant.conditions
        events = [self._events[name] for name in sorted(instant.events) if name in self._events]
        true = [number for leaf, number in self._conditions.items() if _is_true(leaf, values, self._measures)]
        yield str(instant.time)
        yield from _listed([[str(number)] for number in events])
        yield from _listed([[str(number)] for number in true])
        yield from _listed([[str(number), str(_seconds(length, values))] for length, number in self._lengths.items()])

    # Formulas -------------------------------------------------------------------------------------------------

    def _formula(self, formula: Formula | None) -> Iterator[str]:
        if formula is None:
            yield "1"
        elif isinstance(formula, Truth):
            yield str(int(formula.value))
        elif isinstance(formula, Not):
            yield from ("!", *self._formula(formula.operand))
        elif isinstance(formula, (And, Or)):
            for operand in formula.operands[:-1]:
                yield from ("&" if isinstance(formula, And) else "|", *self._formula(operand))
            yield from self._formula(formula.operands[-1])
        elif isinstance(formula, Atom) and formula.kind != "condition":
            yield from ("t" if formula.kind == "trigger" else "o", self._event(formula.name))
        else:
            leaf = formula.name if isinstance(formula, Atom) else formula
            yield from ("c", str(self._conditions.setdefault(leaf, len(self._conditions) + 1)))

    # Rules ----------------------------------------------------------------------------------------------------

    def _law(self, law: Requirement) -> Iterator[str]:
        if isinstance(law, Rule):
            yield from ("rule", self._event(law.trigger), *self._formula(law.guard))
            yield from self._chain(law.default, law.hedges)
        elif isinstance(law, (Exclusive, Never, Assume)):
            yield "stated"
            if isinstance(law, Exclusive):
                yield from ("E", *_listed([[self._event(name)] for name in law.names]))
            else:
                yield from ("N" if isinstance(law, Never) else "A", *self._formula(law.formula))
        elif isinstance(law, EventRelation):
            yield from (BETWEEN_EVENTS[law.relation], self._event(law.left), self._event(law.right))
        elif isinstance(law, MeasureRelation):
            if law.right is None:
                yield from ("invariant", *self._formula(law.left))
            else:
                yield from (BETWEEN_MEASURES[law.relation], *self._formula(law.left), *self._formula(law.right))
        elif isinstance(law, Effect):
            yield from (law.relation, self._event(law.event), *self._formula(law.formula))
        else:
            yield "for" if law.duration is not None else "until"
            yield from (self._event(law.event), *self._formula(law.condition), *self._formula(law.formula))
            if law.duration is not None:
                yield from self._bound(law.duration)
            else:
                assert law.end is not None, "a relation that lasts has an end"
                yield from (self._event(law.end), *self._formula(law.end_condition))

    def _chain(self, default: Clause, hedges: Sequence[Clause] = ()) -> Iterator[str]:
        """A default with a chain of its own is a first hedge under `true`, if there are others."""
        if default.hedges and hedges:
            inner = [(None, default), *((hedge.condition, hedge) for hedge in hedges)]
            yield "0"
        else:
            inner = [(hedge.condition, hedge) for hedge in (*default.hedges, *hedges)]
            yield from _listed([list(self._response(obligation)) for obligation in default.obligations])
        yield from _listed([[*self._formula(condition), *self._chain(clause)] for condition, clause in inner])

    def _response(self, obligation: Obligation) -> Iterator[str]:
        yield f"{'-' if obligation.negated else ''}{self._event(obligation.name)}"
        timing = obligation.timing
        yield from self._window(None if timing is None else timing.window)
        alternatives = []
        if timing is not None and timing.otherwise is not None:
            alternatives.append(["otherwise", *self._chain(timing.otherwise)])
        if timing is not None and timing.instead is not None:
            alternatives.append(["else", *self._chain(timing.instead)])
        yield from _listed(alternatives)

    def _window(self, window: Window | None) -> Iterator[str]:
        if window is None:
            yield "-"
            return
        yield "e" if window.end is None else "w"
        yield from ("s", "0") if window.start is None else self._bound(window.start)
        if window.end is not None:
            yield from self._bound(window.end)

    def _bound(self, length: Length) -> Iterator[str]:
        if isinstance(length.amount, Number):
            yield from ("s", _whole(length.amount.value * SECONDS[length.unit]))
        else:
            yield from ("m", str(self._lengths.setdefault(length, len(self._lengths) + 1)))

    def _claim(self, claim: Claim) -> Iterator[str]:
        yield from (self._event(claim.event), *self._formula(claim.condition))
        yield from _listed([list(self._chain(response)) for response in claim.responses])


def _listed(items: Iterable[Sequence[str]]) -> list[str]:
    every = list(items)
    return [str(len(every)), *(word for item in every for word in item)]


def _whole(seconds: Rational) -> str:
    if seconds != int(seconds):
        raise NotCovered("the times of the theory are whole seconds")
    return str(int(seconds))


# What is true at an instant -----------------------------------------------------------------------------------


def _is_true(leaf: str | Comparison, values: Mapping[str, Value], measures: Mapping[str, Measure]) -> bool:
    if isinstance(leaf, str):
        return values.get(leaf) is True
    left, right = (_worth(side, values, measures) for side in (leaf.left, leaf.right))
    return left is not None and right is not None and bool(OPERATORS[leaf.operator](left, right))


def _worth(side: Term, values: Mapping[str, Value], measures: Mapping[str, Measure]) -> Rational | None:
    """A number or a rank; None where a measure has no value."""
    if isinstance(side, Number):
        return side.value
    if isinstance(side, ScaleValue):
        return side.rank
    if isinstance(side, Calculation):
        return _calculated(side, values)
    value = values.get(side.name)
    return measures[side.name].values.index(value) if isinstance(value, str) else value


def _calculated(side: Calculation, values: Mapping[str, Value]) -> Rational | None:
    if any(name not in values for name in side.measures):
        return None
    return sum(factor * prod(_number(values[name]) for name in names) for factor, names in side.terms)


def _seconds(length: Length, values: Mapping[str, Value]) -> str:
    amount = length.amount
    assert not isinstance(amount, Number)
    if isinstance(amount, MeasureRef):
        value = _number(values[amount.name]) if amount.name in values else None
    else:
        value = _calculated(amount, values)
    if value is None:
        raise NotCovered(f"the trace gives no value to the duration {length}")
    return _whole(value * SECONDS[length.unit])


def _number(value: Value) -> Rational:
    assert not isinstance(value, (str, bool))
    return value
