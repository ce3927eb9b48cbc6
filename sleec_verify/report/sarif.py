"""For code scanning: SARIF 2.1.0 (OASIS), with the steps to each finding as a code flow.

An inconclusive check is a result of kind ``open`` and a notification. A text that cannot be read is a notification.
In both cases the run is not successful.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING
from urllib.parse import quote

from sleec_runtime.model import Span
from sleec_verify import __version__
from sleec_verify.report.flow import steps
from sleec_verify.report.outcome import CheckedRuleset, Outcome, UnusableInput, checked
from sleec_verify.report.plain import Located, described, in_project, located, troubles
from sleec_verify.results.json_values import Json, dump
from sleec_verify.wording.phrases import value_text

if TYPE_CHECKING:
    from sleec_runtime.model import Place, Source
    from sleec_verify.repairs.numbering import NumberedRepair
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import Severity

_Object = dict[str, Json]
SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_LEVELS: Mapping[Severity, str] = {"error": "error", "warning": "warning", "note": "note"}
_FINGERPRINT = "sleecFinding/v1"


def render(outcomes: Sequence[Outcome], palette: Palette) -> Iterator[str]:
    """A log of one run over all rulesets."""
    del palette  # a program reads this
    seen: dict[str, int] = {}
    found = [(outcome, one) for outcome in checked(outcomes) for one in located(outcome, seen)]
    open_checks = [(outcome, name, why) for outcome in checked(outcomes) for name, why in outcome.undecided]
    descriptors = _descriptors({one.finding.code for _, one in found}, {name for _, name, _ in open_checks})
    index = {str(descriptor["id"]): number for number, descriptor in enumerate(descriptors)}
    results: list[Json] = [_result(outcome, one, index) for outcome, one in found]
    results += [_open(outcome.ruleset.source, name, why, index) for outcome, name, why in open_checks]
    rules: list[Json] = [*descriptors]
    run: _Object = {
        "tool": {
            "driver": {
                "name": "sleec-verify",
                "version": __version__,
                "semanticVersion": __version__,
                "rules": rules,
            }
        },
        "invocations": [_invocation(outcomes)],
        "artifacts": _artifacts(outcomes),
        "columnKind": "unicodeCodePoints",
        "results": results,
    }
    yield dump({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]})


def _descriptors(codes: set[str], undecided: set[str]) -> list[_Object]:
    """The descriptors of the results: kinds of finding, and inconclusive checks."""
    if not codes and not undecided:
        return []
    from sleec_verify.report.catalogue import by_code, questions

    descriptors: list[_Object] = [
        {
            "id": code,
            "name": "".join(word.capitalize() for word in entry.check.split("-")),
            "shortDescription": _message(entry.kind.title),
            "fullDescription": _message(entry.kind.explanation),
            "help": _message(f"{entry.kind.explanation}\n\nHow to fix it: {entry.kind.mend}"),
            "defaultConfiguration": {"level": _LEVELS[entry.kind.severity]},
            "properties": {"tags": [entry.check]},
        }
        for code, entry in by_code().items()
        if code in codes
    ]
    asked = dict(questions())
    others = codes - by_code().keys()
    if others or undecided - asked.keys():  # policies of the gate
        from sleec_verify.changes.gate import POLICIES

        asked |= POLICIES
        descriptors += ({"id": name, "shortDescription": _message(asked[name])} for name in sorted(others))
        undecided = undecided - others
    descriptors += ({"id": name, "shortDescription": _message(asked[name])} for name in sorted(undecided))
    return descriptors


def _result(outcome: CheckedRuleset, one: Located, index: Mapping[str, int]) -> _Object:
    finding, source, fingerprint = one
    result: _Object = {
        "ruleId": finding.code,
        "ruleIndex": index[finding.code],
        "kind": "fail",
        "level": _LEVELS[finding.severity],
        "message": _message("\n".join([finding.message, *described(finding)])),
        "locations": [_location(source, finding.span)],
        "partialFingerprints": {_FINGERPRINT: fingerprint},
        "properties": {
            "check": finding.check,
            "rules": list(finding.rules),
            "obligations": list(finding.obligations),
            "domains": list(finding.domains),
        },
    }
    if finding.allowed is not None:
        result["suppressions"] = [{"kind": "external", "status": "accepted", "justification": finding.allowed}]
    if finding.related:
        result["relatedLocations"] = [
            {"id": number, **_location(source, span, word)} for number, (span, word) in enumerate(finding.related, 1)
        ]
    repairs = outcome.repairs_of(finding)
    if repairs is not None and repairs.repairs:
        result["fixes"] = [_fix(one, source) for one in repairs.repairs]
    flow: list[Json] = [
        {
            "location": _location(step.source, step.span, step.words),
            "executionOrder": step.moment,
            "importance": "essential",
            **({"state": {n: _message(value_text(v)) for n, v in step.state.items()}} if step.state else {}),
        }
        for step in steps(outcome.ruleset, finding)
    ]
    if flow:
        result["codeFlows"] = [{"threadFlows": [{"locations": flow}]}]
    return result


def _fix(one: NumberedRepair, source: Source) -> _Object:
    from sleec_verify.report.repair_phrases import effect_in_words

    candidate = one.repair.candidate
    replacements: list[Json] = [
        {
            "deletedRegion": _region(source.place(Span(edit.start, edit.end))),
            "insertedContent": {"text": edit.text},
        }
        for edit in candidate.edits
    ]
    return {
        "description": _message(f"{one.identifier}: {candidate.title}\n{effect_in_words(one.repair)}"),
        "artifactChanges": [{"artifactLocation": {"uri": _uri(source.path)}, "replacements": replacements}],
    }


def _open(source: Source, name: str, why: str, index: Mapping[str, int]) -> _Object:
    """The result of an inconclusive check. The standard requires the level ``none``; the notification has a level."""
    return {
        "ruleId": name,
        "ruleIndex": index[name],
        "kind": "open",
        "level": "none",
        "message": _message(f"{name} is inconclusive: {why}"),
        "locations": [{"physicalLocation": {"artifactLocation": {"uri": _uri(source.path)}}}],
    }


def _invocation(outcomes: Sequence[Outcome]) -> _Object:
    deduplicated: list[Json] = []
    failed = False
    for outcome in outcomes:
        if isinstance(outcome, UnusableInput):
            failed = True
            deduplicated += [_notification("error", path, message, place) for path, message, place in troubles(outcome)]
            continue
        path = outcome.ruleset.source.path
        deduplicated += [_notification("note", path, f"{name}: {why}", None) for name, why in outcome.unlisted]
        for name, why in outcome.undecided:
            failed = True
            deduplicated.append(_notification("error", path, f"{name} is inconclusive: {why}", None))
    return {"executionSuccessful": not failed, "toolExecutionNotifications": deduplicated}


def _notification(level: str, path: str, message: str, place: Place | None) -> _Object:
    physical: _Object = {"artifactLocation": {"uri": _uri(path)}}
    if place is not None:
        physical["region"] = _region(place)
    return {"level": level, "message": _message(message), "locations": [{"physicalLocation": physical}]}


def _artifacts(outcomes: Sequence[Outcome]) -> list[Json]:
    hashes = {outcome.ruleset.source.path: outcome.ruleset.source.sha256 for outcome in checked(outcomes)}
    return [
        {"location": {"uri": _uri(path)}, **({} if known is None else {"hashes": {"sha-256": known}})}
        for path, known in hashes.items()
    ]


def _location(source: Source, span: Span, word: str | None = None) -> _Object:
    physical: _Object = {"artifactLocation": {"uri": _uri(source.path)}, "region": _region(source.place(span))}
    return {"physicalLocation": physical, **({} if word is None else {"message": _message(word)})}


def _region(place: Place) -> _Object:
    return {
        "startLine": place.line,
        "startColumn": place.column,
        "endLine": place.end_line,
        "endColumn": place.end_column,
    }


def _uri(path: str) -> str:
    """The URI of a path: absolute, or relative to the folder in which the command ran."""
    path = in_project(path)
    # A file name is bytes, not necessarily UTF-8.
    quoted = quote(os.fsencode(path))
    return f"file://{quoted}" if os.path.isabs(path) else quoted


def _message(text: str) -> _Object:
    """A message object. Braces mark arguments there, so they are doubled (SARIF 2.1.0, 3.11.5)."""
    return {"text": text.replace("{", "{{").replace("}", "}}")}
