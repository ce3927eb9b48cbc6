"""The state of an audit as plain data, from which another process continues it."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any, get_args

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import Triggered
from sleec_runtime.audit.duty import Duty, DutyMaker
from sleec_runtime.audit.history import Span
from sleec_runtime.audit.moment import UNKNOWN_DOMAIN, Moment
from sleec_runtime.audit.quantiles import Quantiles
from sleec_runtime.audit.response_times import Response, Times
from sleec_runtime.errors import SnapshotRefused, WrongType
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.hedge_chain import Decision, walk
from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.model import LONGEST, Context, Lasting, Ruleset, Value, fit
from sleec_runtime.timed.plain_data import number_from_plain, number_to_plain

FORMAT = 2
"""The version of the format. Other versions are rejected."""


def save(auditor: Auditor) -> dict[str, Any]:
    """The state of an unfinished audit, as plain data for JSON. O(open duties and relations)."""
    contexts = _Contexts()
    duties = [_duty(duty, contexts) for duty in auditor.duties]
    statements = {id(statement): number for number, statement in enumerate(auditor.ruleset.statements)}
    coverage = auditor.coverage
    return {
        "format": FORMAT,
        "ruleset": _digest(auditor.ruleset),
        "tolerance": number_to_plain(auditor.tolerance),
        "untimed": auditor.untimed,
        "chains": auditor.chains,
        "moment": _moment(auditor.moment, contexts),
        "simultaneous": sorted(auditor.simultaneous),
        "duties": duties,
        "group": [_moment(moment, contexts) for moment in auditor.constraints.group],
        "late": auditor.history.is_late,
        "first": {name: number_to_plain(time) for name, time in auditor.history.first.items()},
        "spans": [
            [statements[id(s.relation)], number_to_plain(s.begin), _optional(s.over), s.is_unknown]
            for s in auditor.history.spans
        ],
        "permissions": {name: _optional(end) for name, end in auditor.permissions.until.items()},
        "triggered": dict(coverage.triggered),
        "clauses": [[*clause, number] for clause, number in coverage.clauses.items()],
        "undetermined": dict(coverage.undetermined),
        "responses": [
            [*response, _quantiles(times.seconds), _quantiles(times.shares), times.missed]
            for response, times in auditor.response_times.by_response.items()
        ],
        "unknown": sorted(map(list, auditor.vocabulary.reported)),
        "unobserved": sorted(auditor.unobserved),
        "contexts": contexts.plain,
    }


def restore(ruleset: Ruleset, state: Any) -> Auditor:
    """The audit that was saved, of the same rules.

    Raises SnapshotRefused for a state of other rules, of another version, or a malformed one.
    """
    try:
        if state["format"] != FORMAT:
            raise SnapshotRefused("the state is of another version of sleec-runtime", "audit the log from its start")
        if state["ruleset"] != _digest(ruleset):
            raise SnapshotRefused("the state is that of an audit of other rules", "audit the log from its start")
        return _restored(ruleset, state)
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, AssertionError, WrongType):
        raise SnapshotRefused("the state of the audit is malformed", "audit the log from its start") from None


def _restored(ruleset: Ruleset, state: Any) -> Auditor:
    untimed = state["untimed"]
    assert untimed in get_args(Untimed)
    auditor = Auditor(ruleset, tolerance=_time(state["tolerance"]), untimed=untimed, chains=bool(state["chains"]))
    contexts = [_values(ruleset, one) for one in state["contexts"]]
    auditor.moment = _moment_from(ruleset, state["moment"], contexts)
    auditor.simultaneous = _names(state["simultaneous"])
    for one in state["duties"]:
        auditor.duties.resume(_duty_from(auditor, one, contexts))
    auditor.constraints.group = [_moment_from(ruleset, one, contexts) for one in state["group"]]
    auditor.history.is_late = bool(state["late"])
    auditor.history.first = {name: _time(time) for name, time in state["first"].items()}
    for number, begin, over, is_unknown in state["spans"]:
        relation = ruleset.statements[number]
        assert isinstance(relation, Lasting)
        auditor.history.spans.append(Span(relation, _time(begin), _optional_time(over), bool(is_unknown)))
    auditor.permissions.until = {name: _optional_time(end) for name, end in state["permissions"].items()}
    auditor.coverage.triggered.update({_name(rule): _count(number) for rule, number in state["triggered"].items()})
    clauses = {(_name(rule), _count(clause)): _count(number) for rule, clause, number in state["clauses"]}
    auditor.coverage.clauses.update(clauses)
    undetermined = {_name(rule): _count(number) for rule, number in state["undetermined"].items()}
    auditor.coverage.undetermined.update(undetermined)
    for rule, clause, name, seconds, shares, missed in state["responses"]:
        response = Response(_name(rule), _count(clause), _name(name))
        times = auditor.response_times.by_response.setdefault(response, Times())
        times.seconds, times.shares, times.missed = _quantiles_from(seconds), _quantiles_from(shares), _count(missed)
    auditor.unobserved = _names(state["unobserved"])
    auditor.vocabulary.reported = {(_name(kind), _name(name)) for kind, name in state["unknown"]}
    return auditor


def _digest(ruleset: Ruleset) -> str:
    rules = f"{ruleset.reading}\n{ruleset.source.text}"
    return hashlib.sha256(rules.encode("utf-8", "surrogatepass")).hexdigest()


class _Contexts:
    """The conditions of moments and duties, each once."""

    def __init__(self) -> None:
        self.plain: list[dict[str, Any]] = []
        self._numbers: dict[int, int] = {}

    def number(self, conditions: Mapping[str, Value]) -> int:
        if id(conditions) not in self._numbers:
            self._numbers[id(conditions)] = len(self.plain)
            values = conditions.items()
            self.plain.append({n: v if isinstance(v, (bool, str)) else number_to_plain(v) for n, v in values})
        return self._numbers[id(conditions)]


def _values(ruleset: Ruleset, plain: Mapping[str, Any]) -> dict[str, Value]:
    values = {}
    for name, value in plain.items():
        measure = ruleset.measures.get(name)
        assert measure is not None or name in ruleset.conditions
        is_number = measure is not None and measure.kind != "scale"
        values[name] = fit(name, _time(value) if is_number else value, measure)
    return values


def _duty(duty: Duty, contexts: _Contexts) -> dict[str, Any]:
    triggered = duty.triggered
    return {
        "rule": triggered.rule,
        "time": number_to_plain(triggered.time),
        "events": sorted(triggered.context.triggers),
        "context": contexts.number(triggered.context.conditions),
        "number": duty.number,
        "dues": [[due.met, _optional(due.at)] for due in duty.task.dues()],
    }


def _duty_from(auditor: Auditor, plain: Any, contexts: list[dict[str, Value]]) -> Duty:
    """The duty that the same decision makes again."""
    ruleset = auditor.ruleset
    context = Context(frozenset(_names(plain["events"])), contexts[plain["context"]])
    situation = Situation(context, ruleset.measures, None)
    decision = walk(ruleset.by_label[plain["rule"]], situation, ruleset.reading)
    assert isinstance(decision, Decision)
    triggered = Triggered(_instant(plain["time"]), plain["rule"], context, decision)
    duties = tuple(DutyMaker(ruleset.reading, auditor.untimed).duties(triggered, situation))
    duty: Duty = duties[plain["number"]]
    for due, (met, at) in zip(duty.task.dues(), plain["dues"], strict=True):
        due.met, due.at = met, _instant(at) if met else _optional_time(at)
    return duty


def _moment(moment: Moment, contexts: _Contexts) -> dict[str, Any]:
    return {
        "time": number_to_plain(moment.time),
        "domain": moment.domain,
        "context": contexts.number(moment.conditions),
        "changed": sorted(moment.changed),
        "occurred": sorted(moment.occurred),
        "executed": sorted(moment.executed),
        "triggered": moment.is_triggered,
        "executions": moment.executions,
        "entered": moment.has_entered,
    }


def _moment_from(ruleset: Ruleset, plain: Any, contexts: list[dict[str, Value]]) -> Moment:
    domain = plain["domain"]
    assert domain in (None, UNKNOWN_DOMAIN, *ruleset.domains) or not ruleset.domains
    return Moment(
        _instant(plain["time"]),
        None if domain is None else _name(domain),
        contexts[plain["context"]],
        _names(plain["changed"]),
        _names(plain["occurred"]),
        _names(plain["executed"]),
        bool(plain["triggered"]),
        [_name(name) for name in plain["executions"]],
        bool(plain["entered"]),
    )


def _quantiles(numbers: Quantiles) -> list[Any]:
    return [numbers.least, numbers.greatest, [[bucket, count] for bucket, count in numbers.buckets.items()]]


def _quantiles_from(plain: Any) -> Quantiles:
    numbers = Quantiles()
    least, greatest, buckets = plain
    numbers.least, numbers.greatest = _float(least), _float(greatest)
    for bucket, count in buckets:
        if bucket is not None and type(bucket) is not int:
            raise ValueError(bucket)
        numbers.buckets[bucket] = _count(count)
    return numbers


def _name(plain: object) -> str:
    if not isinstance(plain, str):
        raise TypeError(plain)
    return plain


def _names(plain: Any) -> set[str]:
    return {_name(name) for name in plain}


def _count(plain: object) -> int:
    if type(plain) is not int or plain < 0:
        raise ValueError(plain)
    return plain


def _float(plain: object) -> float | None:
    if plain is not None and type(plain) is not float:
        raise TypeError(plain)
    return plain


def _optional(number: Any) -> Any:
    return None if number is None else number_to_plain(number)


def _time(plain: object) -> Any:
    number = number_from_plain(plain)
    if number is None:
        raise ValueError(plain)
    return number


def _instant(plain: object) -> Any:
    """The time of an observation; that of a deadline can be later."""
    time = _time(plain)
    if time > LONGEST:
        raise ValueError(plain)
    return time


def _optional_time(plain: object) -> Any:
    return None if plain is None else _time(plain)
