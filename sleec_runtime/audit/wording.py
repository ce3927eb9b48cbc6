"""Deviations in words: what happened when, and the conditions that decided."""

from __future__ import annotations

from sleec_runtime.audit.deviation import Deviation, Triggered
from sleec_runtime.evaluation.explanation import step_in_words
from sleec_runtime.evaluation.trace_violations import Requirement
from sleec_runtime.language.common.formula_printer import print_formula, print_number
from sleec_runtime.language.english.statement_printer import print_relation
from sleec_runtime.model import Assume, Exclusive, Never, Rational, Rule, obligation_text
from sleec_runtime.support.messages import listed

_EPOCH_TIMES = 10**8
"""Times from here on, March 1973, are times of the Unix clock."""


def message(deviation: Deviation) -> str:
    """A deviation in one sentence, with its time."""
    at = f"at {time_text(deviation.time)}"
    kind = deviation.kind
    if kind == "unrequired":
        never = "no rule required it"
        why = never if deviation.last is None else f"no rule has required it since {time_text(deviation.last)}"
        return f"{at}, `{deviation.name}` was executed, and {why}"
    if kind in ("unknown-name", "wrong-value", "out-of-order"):
        what = f"the value of `{deviation.name}` does not fit: " if kind == "wrong-value" else ""
        return f"{at}, {what}{deviation.detail}"
    if deviation.statement is not None:
        return _of_statement(deviation, deviation.statement, at)
    triggered = deviation.triggered
    assert triggered is not None
    if kind == "undetermined":
        return f"{at}, {_clause(triggered)} cannot be decided: {_unreported(deviation)}"
    literal = deviation.obligation
    assert literal is not None
    since = f"since {time_text(triggered.time)}" if triggered.time != deviation.time else "at this time"
    if kind == "prohibited":
        return f"{at}, `{literal.name}` was executed, and {_clause(triggered)} prohibits it {since}"
    if kind == "open":
        return f"{at}, the log ends before `{literal.name}` is executed, which {_clause(triggered)} requires {since}"
    return f"{at}, `{literal.name}` has not been executed, and {_clause(triggered)} requires it {since}"


def reasons(deviation: Deviation) -> list[str]:
    """The conditions that decided, and the obligation as the rule states it, in a line each."""
    lines = []
    triggered = deviation.triggered
    if triggered is not None and triggered.decision is not None:
        if deviation.obligation is not None and deviation.obligation.timing is not None:
            lines.append(f"{triggered.rule} requires {obligation_text(deviation.obligation)}")
        lines += [step_in_words(step, triggered.context) for step in triggered.decision.steps]
    if deviation.conditions:
        values = (f"{name} = {_value(value)}" for name, value in sorted(deviation.conditions.items()))
        lines.append(listed(values))
    return lines


def time_text(time: Rational) -> str:
    """A time in seconds; for one of the Unix clock, the date and time in UTC."""
    if time < _EPOCH_TIMES:
        return f"{print_number(time)} s"
    from datetime import datetime, timedelta, timezone

    try:
        moment = datetime(1970, 1, 1, tzinfo=timezone.utc) + timedelta(microseconds=round(time * 10**6))
    except OverflowError:
        return f"{print_number(time)} s"
    return moment.isoformat().replace("+00:00", "Z")


def _clause(triggered: Triggered) -> str:
    if triggered.decision is None:
        return f"rule `{triggered.rule}`"
    return f"rule `{triggered.decision.layer or triggered.rule}`"


def _of_statement(deviation: Deviation, statement: Requirement, at: str) -> str:
    text = f"`{_text(statement)}`"
    if deviation.kind == "undetermined":
        return f"{at}, {text} cannot be decided: {_unreported(deviation)}"
    if deviation.kind == "open":
        return f"{at}, the log ends within the tolerance, and {text} does not hold yet"
    if deviation.kind == "assumption":
        return f"{at}, the assumption {text} does not hold"
    since = (
        f", which applies since {time_text(deviation.first)}" if deviation.first not in (None, deviation.time) else ""
    )
    return f"{at}, {text} does not hold{since}"


def _text(statement: Requirement) -> str:
    if isinstance(statement, Exclusive):
        return f"EXCLUSIVE {', '.join(statement.names)}"
    if isinstance(statement, (Never, Assume)):
        return f"{'NEVER' if isinstance(statement, Never) else 'ASSUME'} {print_formula(statement.formula)}"
    assert not isinstance(statement, Rule)
    return print_relation(statement)


def _unreported(deviation: Deviation) -> str:
    if deviation.missing == ("domain",):
        return "the domain is not known"
    names = [f"`{name}`" for name in deviation.missing]
    verb = "was" if len(names) == 1 else "were"
    return f"{listed(names)} {verb} not reported" if names else "a window has a negative length"


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else print_number(value)  # type: ignore[arg-type]
