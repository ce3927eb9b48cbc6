"""Scenarios as TOML, in the form that the pytest plugin collects, and as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify.conformance.cases.writer import header, json_document, json_value, list_of, quoted_text, table_of
from sleec_verify.conformance.scenarios.reader import NEVER

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.conformance.scenarios.scenario import Scenario, Step
    from sleec_verify.conformance.scenarios.selection import Scenarios
    from sleec_verify.results.json_values import Json
    from sleec_verify.results.timeline import Due


def toml(ruleset: Ruleset, criterion: str, found: Scenarios, path: str | None) -> str:
    """The text of a ``*.cases.toml`` file. `path` is that of the ruleset relative to the file's folder, if there is
    one."""
    lines = [*header(ruleset, criterion, found.unreached, path)]
    for scenario in found.scenarios:
        lines += ["", *_scenario(scenario)]
    return "".join(line + "\n" for line in lines)


def _scenario(one: Scenario) -> Iterator[str]:
    yield "[[case]]"
    yield f"name = {quoted_text(one.name)}"
    if one.domain is not None:
        yield f"domain = {quoted_text(one.domain)}"
    yield from _list("steps", (_step(step) for step in one.steps))
    yield f"end = {one.end}"
    completions = (
        f"name = {quoted_text(c.name)}, since = {c.since}, at = {quoted_text(NEVER) if c.at is None else c.at}"
        for c in one.completions
    )
    if one.completions:
        yield from _list("completions", completions)
    yield from _list("obligations", map(_due, one.obligations))
    if one.prohibitions:
        yield from _list("prohibitions", map(_due, one.prohibitions))
    yield "reaches = ["
    yield from (f"  {quoted_text(name)}," for name in one.reaches)
    yield "]"


def _list(key: str, tables: Iterator[str]) -> Iterator[str]:
    lines = [f"  {{ {table} }}," for table in tables]
    yield from [f"{key} = [", *lines, "]"] if lines else [f"{key} = []"]


def _step(step: Step) -> str:
    given = f", given = {table_of(step.given)}" if step.given else ""
    return f"at = {step.at}, when = {list_of(step.when)}{given}"


def _due(due: Due) -> str:
    end = "" if due.end is None else f", to = {due.end}"
    instead = "" if due.instead_of is None else f", instead_of = {quoted_text(due.instead_of)}"
    overdue = ", overdue = true" if due.overdue else ""
    rule = quoted_text(f"{due.rule}.hc{due.clause}" if due.clause else due.rule)
    return f"name = {quoted_text(due.event)}, from = {due.start}{end}, rule = {rule}{instead}{overdue}"


def json_text(ruleset: Ruleset, criterion: str, found: Scenarios, path: str | None) -> str:
    """The same as one JSON object."""
    cases: list[Json] = [
        {
            "name": one.name,
            "domain": one.domain,
            "steps": [
                {
                    "at": step.at,
                    "when": list(step.when),
                    "given": {name: None if v is None else json_value(v) for name, v in step.given.items()},
                }
                for step in one.steps
            ],
            "end": one.end,
            "completions": [{"name": c.name, "since": c.since, "at": c.at} for c in one.completions],
            "obligations": _json_dues(one.obligations),
            "prohibitions": _json_dues(one.prohibitions or ()),
            "reaches": list(one.reaches),
        }
        for one in found.scenarios
    ]
    return json_document(ruleset, criterion, found.reached, found.unreached, path, cases)


def _json_dues(dues: Sequence[Due]) -> Json:
    return [
        {
            "name": due.event,
            "from": due.start,
            "to": due.end,
            "rule": due.rule,
            "clause": due.clause,
            "instead_of": due.instead_of,
            "overdue": due.overdue,
        }
        for due in dues
    ]
