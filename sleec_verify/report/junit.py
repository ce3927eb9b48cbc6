"""For build servers: JUnit XML, with a test suite for each ruleset and a test case for each check.

A refuted check is a failure, whatever the severity of its findings. An inconclusive check is an error, and so is a text
that cannot be read. Only proved checks pass.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from sleec_runtime.support.messages import escaped
from sleec_verify.report.outcome import CheckedRuleset, Outcome
from sleec_verify.report.plain import described, in_project, troubles
from sleec_verify.results.ci_commands import without_commands
from sleec_verify.results.finding import SEVERITIES, Refuted, Unknown

if TYPE_CHECKING:
    from sleec_runtime.model import Source
    from sleec_verify.report.outcome import UnusableInput
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import CheckResult, Finding

_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")

_CONTROLS = {ord(c): f"&#{ord(c)};" for c in "\t\r\x7f"}
"""Controls that ElementTree does not escape. A parser would read a carriage return as a line feed."""


def render(outcomes: Sequence[Outcome], palette: Palette) -> Iterator[str]:
    """The document, in ASCII, so that it is the same in every encoding."""
    del palette  # a program reads this
    root = Element("testsuites", name="sleec-verify")
    for outcome in outcomes:
        if isinstance(outcome, CheckedRuleset):
            _suite(root, outcome)
        else:
            _unusable(root, outcome)
    _count(root)
    indent(root)
    text = tostring(root, "us-ascii").decode().translate(_CONTROLS)
    text = without_commands(text, "&#{};")
    yield f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _suite(root: Element, outcome: CheckedRuleset) -> None:
    path = in_project(outcome.ruleset.source.path)
    suite = SubElement(root, "testsuite", name=_sayable(path))
    source = outcome.ruleset.source
    for result in outcome.results:
        case = _case(suite, path, result.name, result.seconds)
        text = _sayable("\n\n".join(_words(finding, finding.source or source) for finding in _sorted(result)))
        if isinstance(result.verdict, Unknown):
            message = _sayable(f"inconclusive: {result.verdict.why}")
            SubElement(case, "error", message=message, type="unknown").text = "\n\n".join(filter(None, (message, text)))
        elif isinstance(result.verdict, Refuted):
            gravest = min((finding.severity for finding in result.findings), key=SEVERITIES.index)
            first, *others = (finding.message for finding in _sorted(result))
            more = f" (and {len(others)} more)" if others else ""
            SubElement(case, "failure", message=_sayable(first + more), type=gravest).text = text
        if result.reason is not None:
            SubElement(case, "system-out").text = _sayable(result.reason)
    _count(suite)


def _unusable(root: Element, outcome: UnusableInput) -> None:
    path = in_project(outcome.path)
    suite = SubElement(root, "testsuite", name=_sayable(path))
    case = _case(suite, path, "read", 0.0)
    lines = [
        f"{path}:{place.line}:{place.column}: {message}" if place is not None else message
        for _, message, place in troubles(outcome)
    ]
    message = _sayable(lines[0].partition("\n")[0])
    SubElement(case, "error", message=message, type="unusable").text = _sayable("\n\n".join(lines))
    _count(suite)


def _case(suite: Element, path: str, name: str, seconds: float) -> Element:
    return SubElement(suite, "testcase", classname=_sayable(path), name=name, time=f"{seconds:.6f}")


def _count(suite: Element) -> None:
    cases = list(suite.iter("testcase"))
    suite.set("tests", str(len(cases)))
    suite.set("failures", str(sum(case.find("failure") is not None for case in cases)))
    suite.set("errors", str(sum(case.find("error") is not None for case in cases)))
    suite.set("skipped", "0")
    suite.set("time", f"{sum(float(case.get('time', '0')) for case in cases):.6f}")


def _sorted(result: CheckResult) -> list[Finding]:
    return sorted(result.findings, key=lambda finding: SEVERITIES.index(finding.severity))


def _words(finding: Finding, source: Source) -> str:
    place = source.place(finding.span)
    where = f"{in_project(source.path)}:{place.line}:{place.column}"
    head = f"{where}: {finding.severity}[{finding.code}] {finding.message}"
    return "\n".join([head, *(f"  {line}" for line in described(finding))])


def _sayable(text: str) -> str:
    """`text` with an escape such as ``\\x1b`` for each character that XML 1.0 does not allow."""
    return _NOT_IN_XML.sub(lambda found: escaped(found[0]), text)
