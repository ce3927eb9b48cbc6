"""Records of deviations as plain values, which a state keeps and a worker returns."""

from __future__ import annotations

from typing import Any, NamedTuple

from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.wording import message, reasons
from sleec_runtime.model import Rational, Ruleset, obligation_text
from sleec_runtime.timed.plain_data import number_from_plain, number_to_plain


class Record(NamedTuple):
    """A deviation or a problem of the log. `kind` is its key in `kinds.KINDS`.

    `time` is in seconds, and `since` is that of the trigger; both are None for a problem without a time. `statement` is
    the number of the broken constraint or relation in the ruleset. `line` is the line of the log that cannot be read.
    """

    kind: str
    message: str
    time: Rational | None = None
    since: Rational | None = None
    rule: str | None = None
    clause: int | None = None
    obligation: str | None = None
    first: Rational | None = None
    last: Rational | None = None
    statement: int | None = None
    name: str = ""
    reasons: tuple[str, ...] = ()
    line: int | None = None

    @property
    def group(self) -> tuple[object, ...]:
        """What it has in common with others: all but the times and the line."""
        return self.kind, self.rule, self.clause, self.obligation, self.statement, self.name

    def plain(self) -> list[Any]:
        """As JSON values."""
        times = {name: _plain(getattr(self, name)) for name in ("time", "since", "first", "last")}
        return list(self._replace(**times))


def record_of(deviation: Deviation, ruleset: Ruleset) -> Record:
    """The record of a deviation in a mission under `ruleset`."""
    statement = None
    if deviation.statement is not None:
        statement = next(n for n, one in enumerate(ruleset.statements) if one is deviation.statement)
    triggered = deviation.triggered
    return Record(
        deviation.kind,
        message(deviation),
        deviation.time,
        None if triggered is None else triggered.time,
        deviation.rule,
        deviation.clause,
        None if deviation.obligation is None else obligation_text(deviation.obligation),
        deviation.first,
        deviation.last,
        statement,
        deviation.name or ", ".join(deviation.missing),
        tuple(reasons(deviation)),
    )


def record_from(plain: Any) -> Record:
    """The inverse of `Record.plain`. Raises TypeError or ValueError for other data."""
    record = Record(*plain)
    times = {name: _time(getattr(record, name)) for name in ("time", "since", "first", "last")}
    return record._replace(**times, reasons=tuple(record.reasons))


def _plain(time: Rational | None) -> Any:
    return None if time is None else number_to_plain(time)


def _time(plain: object) -> Any:
    return None if plain is None else number_from_plain(plain)
