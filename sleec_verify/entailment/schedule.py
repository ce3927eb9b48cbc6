"""The schedule of one situation: the windows in seconds, the alternatives, and the consequences of obligations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from sleec_runtime.model import RELATIONS, SECONDS, Assume, Context, Exclusive, MeasureRef, Never, Obligation, Ruleset
from sleec_verify.encoding.measure_ranges import MeasureRanges
from sleec_verify.encoding.response_windows import ResponseWindows
from sleec_verify.encoding.trace_scope import Untimed, speaks_of_traces
from sleec_verify.entailment.answer import ActiveClause, ConsequenceStep, Entailment, ScheduledResponse


def schedule(
    ruleset: Ruleset, context: Context, answer: Entailment, untimed: Untimed = "at"
) -> tuple[ScheduledResponse, ...]:
    """The schedule of what is due in `context`, followed by its consequences, each event once.

    Empty for rules without time, and if the rules contradict each other. Linear in the number of clauses reached.
    """
    if answer.consistent is False or not speaks_of_traces(ruleset):
        return ()
    writer = _Writer(ruleset, context, untimed)
    entries = [entry for because in answer.because for entry in writer.of(because, None)]
    entries += _of_steps(writer, answer.chain)
    return tuple(dict.fromkeys(entries))


def _of_steps(writer: _Writer, steps: Sequence[ConsequenceStep]) -> Iterator[ScheduledResponse]:
    for step in steps:
        for because, done in step.clauses:
            yield from writer.of(because, step.name)
            yield from _of_steps(writer, done)


class _Writer:
    def __init__(self, ruleset: Ruleset, context: Context, untimed: Untimed) -> None:
        self._ruleset = ruleset
        self._windows = ResponseWindows(ruleset, context, untimed)

    def of(self, because: ActiveClause, after: str | None) -> Iterator[ScheduledResponse]:
        clause = list(self._ruleset.by_label[because.rule].clauses())[because.clause]
        for one in self._windows.of(clause):
            yield ScheduledResponse(
                one.obligation.name,
                one.obligation.negated,
                one.start,
                one.end,
                because.rule,
                because.clause,
                because.layer,
                after,
                None if one.instead is None else str(one.instead.obligation),
                one.overdue,
                one.unknown,
                None if one.unknown is None else self._lengths(one.obligation),
            )

    def _lengths(self, obligation: Obligation) -> tuple[int, int] | None:
        """The shortest and the longest length of a window that ends after so many units as a measure says."""
        window = None if obligation.timing is None else obligation.timing.window
        if window is None or window.end is None or not isinstance(window.end.amount, MeasureRef):
            return None
        least, greatest = self._ranges.bounds(window.end.amount.name)
        unit = SECONDS[window.end.unit]
        return None if least is None or greatest is None else (least * unit, greatest * unit)

    @cached_property
    def _ranges(self) -> MeasureRanges:
        relations = [s for s in self._ruleset.statements if isinstance(s, (*RELATIONS, Exclusive, Never, Assume))]
        return MeasureRanges(relations, self._ruleset.measures)
