"""What is due until when, in one situation: windows as clock times, what is due in place of what was not done, and what
becomes due once something is done."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sleec_runtime.model import Context, Ruleset
from sleec_verify.encoding.response_windows import Windows
from sleec_verify.encoding.trace_scope import Untimed, speaks_of_traces

if TYPE_CHECKING:
    from sleec_verify.entailment.consequence_tree import Step
    from sleec_verify.entailment.entailment import Because, Entailment


@dataclass(frozen=True)
class Entry:
    """One response with its window, in seconds from the situation, or from when `after` is done. No `end`: at some
    time. `unknown` is a length that a measure says which is not given; then there are no times.

    `instead_of` is what it is due in place of, an event or ``NOT`` and an event: once that was not kept in time
    (`overdue`), or at any time.
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
        self._windows = Windows(ruleset, context, untimed)

    def of(self, because: Because, after: str | None) -> Iterator[Entry]:
        clause = list(self._ruleset.by_label[because.rule].clauses())[because.clause]
        for one in self._windows.of(clause):
            yield Entry(
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
            )
