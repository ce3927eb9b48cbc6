"""What is due until when, in one situation: windows as clock times, what is due in place of what was not done, and what
becomes due once something is done."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil, floor
from typing import TYPE_CHECKING

from sleec_runtime.model import Clause, Context, Obligation, Ruleset, in_text_order
from sleec_runtime.model_time import Length
from sleec_verify.cnf import Encoder
from sleec_verify.solver import MiniSat
from sleec_verify.timed.scope import Untimed, speaks_of_traces

if TYPE_CHECKING:
    from sleec_verify.chains import Step
    from sleec_verify.entailment import Because, Entailment


@dataclass(frozen=True)
class Entry:
    """One response with its window, in seconds from the situation, or from when `after` is done. No `end`: at some
    time. `unknown` is a length that a measure says which is not given; then there are no times.

    `instead_of` is the event that it is due in place of: once that was not done in time (`overdue`), or at any time.
    """

    event: str
    negated: bool
    start: int | None
    end: int | None
    rule: str
    clause: int
    layer: str | None
    after: str | None = None
    instead_of: str | None = None
    overdue: bool = False
    unknown: str | None = None


def schedule(ruleset: Ruleset, context: Context, answer: Entailment, untimed: Untimed = "at") -> tuple[Entry, ...]:
    """The schedule of what is due in `context`, and after it of what that leads to, each event of a chain once.

    Empty for rules that say nothing of time, and where they contradict one another. Linear in the clauses reached.
    """
    if not (answer.consistent and speaks_of_traces(ruleset)):
        return ()
    writer = _Writer(ruleset, context, untimed)
    entries = [entry for because in answer.because for entry in writer.of(because, None)]
    entries += _of_steps(writer, answer.chain)
    return tuple(dict.fromkeys(entries))


def _of_steps(writer: _Writer, steps: Sequence[Step]) -> Iterator[Entry]:
    for step in steps:
        for because, done in step.clauses:
            yield from writer.of(because, step.name)
            yield from _of_steps(writer, done)


class _Writer:
    def __init__(self, ruleset: Ruleset, context: Context, untimed: Untimed) -> None:
        self._ruleset = ruleset
        self._context = context
        self._untimed = untimed

    def of(self, because: Because, after: str | None) -> Iterator[Entry]:
        clause = list(self._ruleset.by_label[because.rule].clauses())[because.clause]
        for obligation in clause.obligations:
            yield from self._obligation(obligation, _Place(because, after))

    def _obligation(self, obligation: Obligation, place: _Place) -> Iterator[Entry]:
        timing = obligation.timing
        window = None if timing is None else timing.window
        start, end, unknown = place.since, None, place.unknown
        if window is None:
            end = start if self._untimed == "at" else None
        else:
            # Instants are whole seconds.
            for length in (window.start, window.end):
                if length is not None and self._seconds(length) is None:
                    unknown = str(length)
            if unknown is None:
                start += ceil(self._seconds(window.start) or 0) if window.start is not None else 0
                end = None if window.end is None else place.since + floor(self._seconds(window.end) or 0)
        yield place.entry(obligation, start, end, unknown)
        if timing is None:
            return
        if timing.otherwise is not None:
            over = place.since if window is None or end is None else end
            yield from self._clause(timing.otherwise, place.instead(obligation, over, True, unknown))
        if timing.instead is not None:
            yield from self._clause(timing.instead, place.instead(obligation, place.since, False, None))

    def _clause(self, clause: Clause, place: _Place) -> Iterator[Entry]:
        for obligation in self._deciding(clause).obligations:
            yield from self._obligation(obligation, place)

    def _deciding(self, clause: Clause) -> Clause:
        """The clause of a chain of its own that decides in the situation."""
        encoder = Encoder(self._ruleset.measures, frozenset(self._ruleset.measures) - set(self._context.conditions))
        decides = encoder.chain(clause, self._ruleset.reading)
        encoder.close()
        with MiniSat(encoder.clauses) as solver:
            answer = solver.solve(encoder.assumptions(self._context))
            assert answer, "in a total context something decides"
            return next(c for c, literal in zip(in_text_order(clause), decides) if solver.holds(literal))

    def _seconds(self, length: Length) -> float | None:
        """A length in seconds; where measures say it, by the situation, and None if one of them is not given there."""
        values = {}
        for name in length.measures:
            given = self._context.conditions.get(name)
            if given is None or isinstance(given, (bool, str)):
                return None
            values[name] = given
        return float(length.seconds_where(values))


@dataclass(frozen=True)
class _Place:
    """Which clause a response is of, and since when it counts."""

    because: Because
    after: str | None
    since: int = 0
    instead_of: str | None = None
    overdue: bool = False
    unknown: str | None = None

    def instead(self, obligation: Obligation, since: int, overdue: bool, unknown: str | None) -> _Place:
        return _Place(self.because, self.after, since, obligation.name, overdue, unknown)

    def entry(self, obligation: Obligation, start: int, end: int | None, unknown: str | None) -> Entry:
        known = unknown is None
        return Entry(
            obligation.name,
            obligation.negated,
            start if known else None,
            end if known else None,
            self.because.rule,
            self.because.clause,
            self.because.layer,
            self.after,
            self.instead_of,
            self.overdue,
            unknown,
        )
