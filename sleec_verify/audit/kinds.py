"""The kinds of finding about a mission. Each has an example with the problem and one without it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from sleec_verify.results.finding_kind import FindingKind

if TYPE_CHECKING:
    from sleec_verify.results.finding import Severity

NAME = "audit"
QUESTION = "Did the robot do what the rules required in this mission?"

_FILES = ("rules.sleec", "mission.jsonl", "mapping.toml")
"""The files of an example. Each begins with a line that names it."""

_CURTAINS = """\
RULE curtains WHEN CurtainRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains
"""
_FALL = "RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes\n"
_DRESSED = '{"time": 0, "conditions": {"UserUndressed": false}}\n'
_UNDRESSED = '{"time": 0, "conditions": {"UserUndressed": true}}\n'
_REQUEST = '{"time": 10, "event": "CurtainRequest"}\n'
_OPEN = '{"time": 10.2, "executed": "OpenCurtains"}\n'
_LATER = '{"time": 60, "event": "CurtainRequest"}\n{"time": 60.2, "executed": "OpenCurtains"}\n'
_GOOD = f"{_DRESSED}{_REQUEST}{_OPEN}"
_END = '{"time": 900, "domain": null}\n'


def _example(*files: str) -> str:
    return "\n".join(f"# {name}\n{text}" for name, text in zip(_FILES, files) if text)


def files_of(text: str) -> dict[str, str]:
    """The files of an example by their names."""
    found: dict[str, str] = {}
    rest = text
    for name in reversed(_FILES):
        rest, marker, content = rest.rpartition(f"# {name}\n")
        if marker:
            found[name] = content
        else:
            rest = content
    return found


def arguments_of(text: str) -> tuple[str, ...]:
    """The command for an example."""
    mapped = ("--mapping", "mapping.toml") if "mapping.toml" in files_of(text) else ()
    return ("audit", "mission.jsonl", "--ruleset", "rules.sleec", *mapped)


def _kind(
    number: int,
    title: str,
    explanation: str,
    mend: str,
    bad: str,
    good: str = _GOOD,
    rules: str = _CURTAINS,
    severity: Severity = "error",
    mappings: tuple[str, str] = ("", ""),
) -> FindingKind:
    examples = (_example(rules, log, mapping) for log, mapping in zip((bad, good), mappings))
    return FindingKind(f"SLEEC{number}", severity, title, explanation, mend, *examples)


_USER = '{"time": 5, "topic": "/user", "message": {"undressed": false}}\n'
_MAPPING = '[conditions]\nUserUndressed = {topic = "/user", field = "undressed"}\n'
_DARK = "CONDITION Dark\nNEVER Drive AND Dark\nRULE go WHEN Go THEN Drive\n"
_LIGHT = '{"time": 0, "conditions": {"Dark": false}}\n'
_DRIVE = '{"time": 5, "event": "Go"}\n{"time": 5.1, "executed": "Drive"}\n'
_ASSUMED = "CONDITION Night, Sunny\nASSUME NOT (Night AND Sunny)\nRULE go WHEN Go THEN Drive UNLESS Night\n"

KINDS: Mapping[str, FindingKind] = {
    "missed": _kind(
        701,
        "an obligation was not executed in time",
        "A rule required an obligation, and the log has no execution of it in its window. An obligation without a "
        "window is due at once. The tolerance allows for delays of the log.",
        "Find out why the robot did not execute it. If the robot did, check the mapping, and allow for the delay of "
        "the log with --tolerance.",
        f"{_DRESSED}{_REQUEST}{_LATER}",
        f"{_GOOD}{_LATER}",
    ),
    "prohibited": _kind(
        702,
        "the robot executed what a rule prohibits",
        "A rule prohibited this event, and the log has an execution of it while the prohibition was in force.",
        "Let the robot decide by the rules, with the conditions at the time of the trigger.",
        f"{_UNDRESSED}{_REQUEST}{_OPEN}",
        f"{_UNDRESSED}{_REQUEST}",
    ),
    "constraint": _kind(
        703,
        "a constraint or relation does not hold",
        "What happened in the mission breaks an EXCLUSIVE, a NEVER or a relation of the rules.",
        "Change the behaviour of the robot in this situation. If it is correct, change the constraint.",
        f'{_LIGHT}{{"time": 1, "conditions": {{"Dark": true}}}}\n{_DRIVE}',
        f"{_LIGHT}{_DRIVE}",
        _DARK,
    ),
    "assumption": _kind(
        704,
        "an assumption does not hold",
        "The rules assume with ASSUME that such a situation never occurs, and the log has it. All results of check "
        "rely on this assumption.",
        "Correct the sensor or its mapping, or the assumption, and check the rules again.",
        '{"time": 1, "conditions": {"Night": true, "Sunny": true}}\n{"time": 2, "event": "Go"}\n',
        '{"time": 1, "conditions": {"Night": true, "Sunny": false}}\n{"time": 2, "event": "Go"}\n',
        _ASSUMED,
        "warning",
    ),
    "unrequired": _kind(
        705,
        "the robot executed what no rule required",
        "The rules do not forbid executions that they do not require, so this is a note. "
        "It may be a late execution of an obligation, or a missing trigger in the log.",
        "If the robot should execute it only when a rule requires it, find out what else starts it.",
        f'{_GOOD}{{"time": 30, "executed": "OpenCurtains"}}\n',
        severity="note",
    ),
    "undetermined": _kind(
        706,
        "a decision depends on values that were not reported",
        "The log has no value of a condition or measure that decides what the rule requires. So it is not known "
        "whether the robot followed the rule.",
        "Report the value in the log before the trigger, or map the topic that has it.",
        f"{_REQUEST}{_OPEN}",
        severity="warning",
    ),
    "open": _kind(
        707,
        "the log ends before a window closes",
        "An obligation was not executed before the end of the log, and its window was still open then. So it is not "
        "known whether it was executed in time. The same holds for a constraint or relation that requires an event.",
        "Record the mission until its windows have closed.",
        '{"time": 10, "event": "UserFell"}\n',
        '{"time": 10, "event": "UserFell"}\n{"time": 70, "executed": "CallNurse"}\n',
        _FALL,
        "note",
    ),
    "unreadable": _kind(
        708,
        "a part of the log cannot be used",
        "A line or message is malformed, or does not have the field or value that the mapping expects. It is skipped, "
        "so its content is not known.",
        "Correct the mapping, or repair the log.",
        f'{_DRESSED}{{"time": 5, "conditions"\n{_REQUEST}{_OPEN}',
        severity="warning",
    ),
    "unknown-name": _kind(
        709,
        "the rules do not have a name of the log",
        "The log has an event, obligation, condition or domain that the rules do not name. It is ignored. After a "
        "domain that the rules do not have, the rules of domains cannot be decided.",
        "Correct the name in the log or the mapping, or declare it in the rules.",
        f'{_GOOD}{{"time": 20, "event": "CurtianRequest"}}\n',
        severity="warning",
    ),
    "out-of-order": _kind(
        710,
        "the log is not in chronological order",
        "An observation is earlier than one before it. It counts as simultaneous with that one, so decisions may be "
        "wrong.",
        "Sort the log, or give the largest delay with --max-lag.",
        f'{_DRESSED}{_REQUEST}{{"time": 9, "conditions": {{"UserUndressed": false}}}}\n' + _OPEN,
        f"{_DRESSED}{_REQUEST}{_OPEN}",
        severity="warning",
    ),
    "nothing-audited": _kind(
        711,
        "no rule is triggered in the log",
        "The log has no event that triggers a rule. So the audit has no result about the robot.",
        "Check the mapping of the events, the domain, and whether this is the right log.",
        _DRESSED,
        severity="warning",
    ),
    "missing-topic": _kind(
        712,
        "the log has no message that means a name of the rules",
        "The mapping names a topic, and the log has no message on it. Or the mapping has no entry for an event or "
        "obligation of the rules. What such messages would report is not known.",
        "Correct the name of the topic, or record it. Add the missing entry to the mapping.",
        f"{_DRESSED}{_USER}{_REQUEST}{_OPEN}",
        f"{_DRESSED}{_USER}{_REQUEST}{_OPEN}",
        severity="warning",
        mappings=(_MAPPING.replace("/user", "/usr"), _MAPPING),
    ),
}
"""The kinds, by the kind of deviation or the name of the problem."""
