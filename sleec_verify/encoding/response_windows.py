"""The responses of a clause with their windows in seconds, and their alternatives."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, floor

from sleec_runtime.model import Clause, Context, Length, Obligation, Rational, Ruleset, in_text_order
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.solver import MiniSat
from sleec_verify.encoding.trace_scope import Untimed


@dataclass(frozen=True)
class WindowedResponse:
    """One response with its window, in seconds from the trigger. Without an `end`, it is due at some time. `unknown` is
    a length that depends on a missing measure; then there are no times.

    `instead` is the response that it replaces: if that was not met in time (`overdue`), or as a choice.
    """

    obligation: Obligation
    start: int | None
    end: int | None
    unknown: str | None = None
    instead: WindowedResponse | None = None
    overdue: bool = False


@dataclass(frozen=True)
class _Since:
    """The start of the window of a response, and the response that it replaces."""

    time: int = 0
    unknown: str | None = None
    instead: WindowedResponse | None = None
    overdue: bool = False


class ResponseWindows:
    """The windows of responses in one situation, which decides the hedges of alternatives."""

    def __init__(self, ruleset: Ruleset, context: Context, untimed: Untimed) -> None:
        self._ruleset = ruleset
        self._context = context
        self._untimed = untimed

    def of(self, clause: Clause) -> Iterator[WindowedResponse]:
        """The responses of a clause that decides, each before its alternatives."""
        for obligation in clause.obligations:
            yield from self._obligation(obligation, _Since())

    def _obligation(self, obligation: Obligation, since: _Since) -> Iterator[WindowedResponse]:
        timing = obligation.timing
        window = None if timing is None else timing.window
        start, end, unknown = since.time, None, since.unknown
        if window is None:
            end = start if self._untimed == "at" else None
        else:
            # Instants are whole seconds.
            for length in (window.start, window.end):
                if length is not None and self._seconds(length) is None:
                    unknown = str(length)
            if unknown is None:
                start += ceil(self._seconds(window.start) or 0) if window.start is not None else 0
                end = None if window.end is None else since.time + floor(self._seconds(window.end) or 0)
        itself = WindowedResponse(
            obligation,
            start if unknown is None else None,
            end if unknown is None else None,
            unknown,
            since.instead,
            since.overdue,
        )
        yield itself
        if timing is None:
            return
        if timing.otherwise is not None:
            over = since.time if window is None or end is None else end
            yield from self._clause(timing.otherwise, _Since(over, unknown, itself, overdue=True))
        if timing.instead is not None:
            yield from self._clause(timing.instead, _Since(since.time, None, itself))

    def _clause(self, clause: Clause, since: _Since) -> Iterator[WindowedResponse]:
        for obligation in self._deciding(clause).obligations:
            yield from self._obligation(obligation, since)

    def _deciding(self, clause: Clause) -> Clause:
        """The clause of a separate chain that decides in the situation."""
        if not clause.hedges:
            return clause
        encoder = Encoder(self._ruleset.measures, frozenset(self._ruleset.measures) - set(self._context.conditions))
        decides = encoder.chain(clause, self._ruleset.reading)
        encoder.close()
        with MiniSat(encoder.clauses) as solver:
            answer = solver.solve(encoder.assumptions(self._context))
            assert answer, "in a total context something decides"
            return next(c for c, literal in zip(in_text_order(clause), decides) if solver.holds(literal))

    def _seconds(self, length: Length) -> Rational | None:
        """A length in seconds. If it depends on measures, the situation gives their values; None if one is missing."""
        values = {}
        for name in length.measures:
            given = self._context.conditions.get(name)
            if given is None or isinstance(given, (bool, str)):
                return None
            values[name] = given
        return length.seconds_where(values)
