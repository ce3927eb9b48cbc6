"""Scenarios from TOML: the cases with `steps` in a file of cases.

[[case]]
name = "the nurse does not come"
steps = [
  { at = 0, when = ["UserFell"] },
]
end = "7 minutes"
completions = [
  { name = "CallNurse", since = 0, at = "never" },
]
obligations = [
  { name = "CallNurse", from = 0, to = "5 minutes", rule = "fall" },
  { name = "CallAmbulance", from = "5 minutes", to = "7 minutes", rule = "fall", instead_of = "CallNurse" },
]
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sleec_runtime.model import constructs
from sleec_runtime.support.suggestions import nearest
from sleec_verify.conformance.cases.case import Case, CasesError
from sleec_verify.conformance.cases.fields import check_keys, domain_of, goals_of, obligation_of, situation_of
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step
from sleec_verify.conformance.scenarios.times import time_of
from sleec_verify.entailment.situation_text import SituationError
from sleec_verify.results.timeline import Due
from sleec_verify.wording.phrases import shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset

_KEYS = {"name", "steps", "end", "completions", "obligations", "prohibitions", "domain", "reaches"}
_STEP_KEYS = {"at", "when", "given"}
_COMPLETION_KEYS = {"name", "since", "at"}
_DUE_KEYS = {"name", "from", "to", "rule", "instead_of", "overdue"}
NEVER = "never"
"""The time of a completion that never comes."""


def scenario_of_table(path: Path, where: str, name: str, entry: Mapping[str, Any], ruleset: Ruleset) -> Scenario:
    """The scenario in one table of a file of cases. Raises CasesError and SituationError."""
    check_keys(path, where, entry, _KEYS)
    if not any(constructs(ruleset)):
        raise SituationError("the case has steps, but the rules have no times", "use when and given")
    if "obligations" not in entry:
        raise SituationError("the case does not say what is required", "give obligations = []")
    steps = tuple(_steps(path, where, entry["steps"], ruleset))
    obligations = tuple(_dues(path, where, entry, "obligations", ruleset))
    prohibitions = tuple(_dues(path, where, entry, "prohibitions", ruleset)) if "prohibitions" in entry else None
    completions = tuple(_completions(path, where, entry, obligations))
    ends = [one.start if one.end is None else one.end for one in (*obligations, *(prohibitions or ()))]
    last = steps[-1].at
    end = time_of("end", entry["end"]) if "end" in entry else max([last, *ends])
    for what, at in (("step", last), *(("completion", one.at) for one in completions if one.at is not None)):
        if at > end:
            raise SituationError(f"the end is {end}, before the {what} at {at}", "observe the robot to the last one")
    return Scenario(
        name, steps, end, completions, obligations, prohibitions, domain_of(entry, ruleset), goals_of(entry)
    )


def _tables(path: Path, where: str, entries: object, key: str, keys: set[str]) -> Iterator[tuple[str, dict[str, Any]]]:
    """The tables in a list, each with its place in words."""
    if not isinstance(entries, list) or not all(isinstance(one, dict) for one in entries):
        raise SituationError(f"{key} is not a list of tables", f"write {key} = [{{ {', '.join(sorted(keys))} }}]")
    for number, table in enumerate(entries, 1):
        here = f"{key.removesuffix('s')} {number}"
        check_keys(path, f"{where}: {here}", table, keys)
        yield here, table


@contextmanager
def _located(here: str) -> Iterator[None]:
    """Adds the place to the errors of the block."""
    try:
        yield
    except SituationError as error:
        raise SituationError(f"{here}: {error.message}", error.hint) from None


def _required(table: Mapping[str, Any], key: str) -> Any:
    if key not in table:
        raise SituationError(f"the key `{key}` is missing")
    return table[key]


def _steps(path: Path, where: str, entries: object, ruleset: Ruleset) -> Sequence[Step]:
    found: list[Step] = []
    for here, table in _tables(path, where, entries, "steps", _STEP_KEYS):
        with _located(here):
            at = time_of("at", _required(table, "at"))
            _check_order(found, at)
            found.append(Step(at, *situation_of(table, ruleset)))
    if not found:
        raise SituationError("steps is empty", "give at least one step, such as { at = 0, when = [] }")
    return found


def _check_order(before: Sequence[Step], at: int) -> None:
    """Raises SituationError for a time that is not after the earlier steps."""
    if before and at == before[-1].at:
        raise SituationError(f"the time {at} occurs twice", "join the two steps")
    if before and at < before[-1].at:
        hint = "give the steps in the order of time"
        raise SituationError(f"the time {at} is before that of the previous step, {before[-1].at}", hint)


def _dues(path: Path, where: str, entry: Mapping[str, Any], key: str, ruleset: Ruleset) -> Iterator[Due]:
    for here, table in _tables(path, where, entry[key], key, _DUE_KEYS):
        with _located(here):
            yield _due(table, key == "prohibitions", ruleset)


def _due(table: Mapping[str, Any], negated: bool, ruleset: Ruleset) -> Due:
    name = obligation_of(str(_required(table, "name")), ruleset)
    start = time_of("from", _required(table, "from"))
    end = time_of("to", table["to"]) if "to" in table else None
    if end is not None and end < start:
        raise SituationError(f"the window ends at {end}, before it starts at {start}", "exchange the times")
    rule, clause = _clause(table["rule"], ruleset) if "rule" in table else ("", 0)
    overdue, instead = table.get("overdue", False), table.get("instead_of")
    if not isinstance(overdue, bool) or not (instead is None or isinstance(instead, str)):
        raise SituationError("overdue must be true or false, and instead_of a text")
    return Due(rule, clause, f"NOT {name}" if negated else name, name, negated, start, end, instead, overdue)


def _clause(written: object, ruleset: Ruleset) -> tuple[str, int]:
    """The label of a rule, and the number of its clause: ``R1`` is the default, ``R1.hc2`` the second hedge."""
    layers = {
        rule.layer(number) or rule.label: (rule.label, number)
        for rule in ruleset.rules
        for number, _ in enumerate(rule.clauses())
    }
    name = str(written)
    if name not in layers:
        near = nearest(name, sorted(layers))
        raise SituationError(f"no rule is called `{shortened(name)}`", f"did you mean `{near}`?" if near else None)
    return layers[name]


def _completions(path: Path, where: str, entry: Mapping[str, Any], obligations: Sequence[Due]) -> Iterator[Completion]:
    seen = set()
    for here, table in _tables(path, where, entry.get("completions", []), "completions", _COMPLETION_KEYS):
        with _located(here):
            found = _completion(table, obligations)
            if (found.name, found.since) in seen:
                raise SituationError(f"`{found.name}` since {found.since} is completed twice", "remove one of them")
        seen.add((found.name, found.since))
        yield found


def _completion(table: Mapping[str, Any], obligations: Sequence[Due]) -> Completion:
    name = str(_required(table, "name"))
    since = time_of("since", _required(table, "since"))
    written = _required(table, "at")
    at = None if written == NEVER else time_of("at", written)
    due = [one for one in obligations if one.event == name and one.start == since]
    if not due:
        others = [f"from {one.start}" for one in obligations if one.event == name]
        hint = f"it is due {', '.join(others)}" if others else "add it to obligations, or remove the completion"
        raise SituationError(f"`{shortened(name)}` is not due from {since} on", hint)
    if at is not None and at < since:
        raise SituationError(f"completed at {at}, before it is due at {since}", "give a later time")
    if at is not None and all(one.end is not None and one.end < at for one in due):
        last = max(one.end for one in due if one.end is not None)
        hint = f'give an earlier time, or at = "{NEVER}"'
        raise SituationError(f"completed at {at}, after the window ends at {last}", hint)
    return Completion(name, since, at)


def check_overlap(path: Path, cases: Iterable[Case | Scenario]) -> None:
    """Raises CasesError for two cases with the same name, or with the same steps and completions."""
    names: dict[str, int] = {}
    contents: dict[object, int] = {}
    for number, case in enumerate(cases, 1):
        if case.name in names:
            raise CasesError(f"{path}: cases {names[case.name]} and {number} have the same name", "rename one of them")
        names[case.name] = number
        before = contents.setdefault(_content(case), number)
        if before != number:
            raise CasesError(
                f"{path}: cases {before} and {number} have the same steps and completions", "remove one of them"
            )


def _content(case: Case | Scenario) -> object:
    """What a case does: its domain, its steps, and its completions."""
    steps = (Step(0, case.triggers, case.conditions),) if isinstance(case, Case) else case.steps
    completions = frozenset(() if isinstance(case, Case) else case.completions)
    return case.domain, tuple((s.at, s.when, frozenset(s.given.items())) for s in steps), completions
