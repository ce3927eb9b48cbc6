"""Results as JSON values, for everything that writes them: reports, certificates and cases."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Union

from sleec_verify.results.ci_commands import without_commands
from sleec_verify.results.finding import Proved, Refuted, Unknown
from sleec_verify.wording.phrases import error_summary

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Source, Span, Value
    from sleec_verify.results.finding import Finding, Witness
    from sleec_verify.results.strategy import Strategy
    from sleec_verify.results.timeline import Timeline

Json = Union[None, bool, int, float, str, "list[Json]", "dict[str, Json]"]


def dump(value: Json) -> str:
    """`value` as text with a line break at its end. The text is printable ASCII, so that every stream can write it and
    no terminal or service interprets it."""
    text = json.dumps(value, indent=2).replace("\x7f", "\\u007f")
    return without_commands(text, "\\u{:04x}") + "\n"


VERDICTS: dict[type, str] = {Proved: "proved", Refuted: "refuted", Unknown: "unknown"}
"""The names of verdicts in output for programs."""


def finding_json(finding: Finding, source: Source) -> dict[str, Json]:
    """A finding, with places as lines and columns."""
    return {
        "code": finding.code,
        "check": finding.check,
        "severity": finding.severity,
        "message": finding.message,
        "rules": list(finding.rules),
        "clauses": [{"rule": clause.rule, "clause": clause.clause} for clause in finding.clauses],
        "obligations": list(finding.obligations),
        "span": span_json(finding.span, source),
        "witness": None if finding.witness is None else witness_json(finding.witness),
        **({} if finding.timeline is None else {"timeline": _timeline(finding.timeline)}),
        **({} if finding.strategy is None else {"strategy": _strategy(finding.strategy)}),
        "domains": list(finding.domains),
        "related": [{"span": span_json(span, source), "message": word} for span, word in finding.related],
        "note": finding.note,
        "help": finding.help,
        **({} if finding.source is None else {"path": finding.source.path}),
    }


def error_json(error: SleecError) -> Json:
    """An error of the input: message, hint, and each problem with its place."""
    from sleec_runtime.errors import LanguageError

    if not isinstance(error, LanguageError):
        return {"message": error.message, "hint": error.hint, "problems": []}
    problems: list[Json] = [
        {"message": problem.message, "hint": problem.hint, "span": span_json(problem.span, error.source)}
        for problem in error.problems
    ]
    return {"message": error_summary(error), "hint": None, "problems": problems}


def span_json(span: Span, source: Source) -> dict[str, Json]:
    """Lines and columns, all from 1; the end column is one past the last character."""
    return dict(source.place(span)._asdict())


def witness_json(witness: Witness) -> Json:
    """A situation: its triggers, its conditions, and, if there are any, the triggers that must be absent."""
    absent: dict[str, Json] = {"absent": list(witness.absent)} if witness.absent else {}
    return {"triggers": list(witness.triggers), "conditions": values_json(witness.conditions), **absent}


def _timeline(timeline: Timeline) -> Json:
    """A timeline. Times are seconds from the first moment. `now` is the position of the last moment that is fixed, or
    null."""
    moments: list[Json] = [
        {
            "time": moment.time,
            "events": list(moment.events),
            "conditions": values_json(moment.conditions),
            "due": [
                {
                    "rule": due.rule,
                    "clause": due.clause,
                    # For compatibility: `related` of the finding contains relations and constraints.
                    "law": None,
                    "response": due.words,
                    "event": due.event,
                    "negated": due.negated,
                    "from": due.start,
                    "until": due.end,
                    "instead_of": due.instead_of,
                    "overdue": due.overdue,
                }
                for due in moment.due
            ],
        }
        for moment in timeline.moments
    ]
    return {"moments": moments, "now": timeline.now}


def _strategy(strategy: Strategy) -> Json:
    """An act of the environment, with a branch for each response of the robot (null: any response). No branches: every
    response violates a rule. Times are seconds from the first act."""
    act = strategy.act
    branches: list[Json] = [
        {
            "robot": None if branch.done is None else list(branch.done),
            "planned": [{"time": plan.time, "events": list(plan.events)} for plan in branch.planned],
            "then": _strategy(branch.then),
        }
        for branch in strategy.branches
    ]
    return {
        "time": act.time,
        "events": list(act.events),
        "conditions": values_json(act.conditions),
        "branches": branches,
        "more": strategy.more,
    }


def values_json(values: Mapping[str, Value]) -> dict[str, Json]:
    """Values of conditions and measures. A number without an exact JSON form is a string such as ``1/3``."""
    return {name: _value(value) for name, value in values.items()}


def _value(value: Value) -> Json:
    if isinstance(value, (bool, int, str)):
        return value
    from fractions import Fraction

    try:
        near = float(value)
    except OverflowError:
        return str(value)
    return near if Fraction(repr(near)) == value else str(value)
