"""The message that a monitor publishes about a deviation."""

from __future__ import annotations

from dataclasses import dataclass

from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.wording import message, reasons
from sleec_runtime.model import LONGEST, Rational, names_of
from sleec_runtime.ros.message import Conditions, Message
from sleec_runtime.ros.transport import Topic


@dataclass(frozen=True, kw_only=True)
class DeviationReport(Message):
    """A deviation that a monitor has found. Numbers are consecutive, so a receiver sees that a message is lost.

    `kind` is a `DeviationKind`, `time` that of the deviation, and `found` that of this report. The obligation was due
    `since` then, from `first` to `last`. `conditions` are those that decided, and `missing` the names that were not
    reported. `text` is the deviation in one sentence, and `reasons` explains it. Times are in seconds since 1970.
    """

    topic = Topic("/deviations", latched=True, depth=64)
    monitor: str
    number: int
    found: float
    time: float
    kind: str
    text: str
    reasons: tuple[str, ...] = ()
    rule: str | None = None
    clause: int | None = None
    obligation: str | None = None
    since: float | None = None
    first: float | None = None
    last: float | None = None
    conditions: Conditions
    missing: tuple[str, ...] = ()
    name: str | None = None


def report_of(deviation: Deviation, monitor: str, number: int, found: Rational) -> DeviationReport:
    """The message about a deviation."""
    triggered = deviation.triggered
    return DeviationReport(
        monitor=monitor,
        number=number,
        found=float(found),
        time=_seconds(deviation.time),
        kind=deviation.kind,
        text=message(deviation),
        reasons=tuple(reasons(deviation)),
        rule=deviation.rule,
        clause=deviation.clause,
        obligation=None if deviation.obligation is None else deviation.obligation.name,
        since=None if triggered is None else _seconds(triggered.time),
        first=None if deviation.first is None else _seconds(deviation.first),
        last=None if deviation.last is None else _seconds(deviation.last),
        conditions=_conditions(deviation),
        missing=deviation.missing,
        name=deviation.name or None,
    )


def _conditions(deviation: Deviation) -> Conditions:
    triggered = deviation.triggered
    if triggered is None or triggered.decision is None:
        return deviation.conditions or {}
    names = {name for step in triggered.decision.steps for name in names_of(step.condition)}
    known = triggered.context.conditions
    return {name: known[name] for name in sorted(names) if name in known}


def _seconds(time: Rational) -> float:
    """A time that receivers accept. A window whose length is a measure may end later than any clock."""
    return float(max(-LONGEST, min(time, LONGEST)))
