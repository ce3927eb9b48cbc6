"""For GitHub Actions: workflow commands, which GitHub shows as annotations of a pull request."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.support.messages import escaped
from sleec_verify.report.outcome import CheckedRuleset, Outcome, in_short
from sleec_verify.report.plain import described, in_project, troubles
from sleec_verify.results.internal_error import InternalError

if TYPE_CHECKING:
    from sleec_runtime.model import Place
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import Severity

_COMMANDS: Mapping[Severity, str] = {"error": "error", "warning": "warning", "note": "notice"}


def render(outcomes: Sequence[Outcome], palette: Palette) -> Iterator[str]:
    """A command for each finding, for each inconclusive check (as an error) and for each problem of a text that cannot
    be read; then a summary line."""
    del palette  # a program reads this
    for outcome in outcomes:
        if not isinstance(outcome, CheckedRuleset):
            title = "internal error" if isinstance(outcome.error, InternalError) else "unusable ruleset"
            for path, message, place in troubles(outcome):
                yield _annotation("error", path, place, title, message)
            continue
        for finding in outcome.deduplicated:
            source = finding.source or outcome.ruleset.source
            text = "\n".join([finding.message, *described(finding)])
            title = " ".join(dict.fromkeys((finding.code, finding.check)))  # a policy of the gate has one name
            yield _annotation(_COMMANDS[finding.severity], source.path, source.place(finding.span), title, text)
        path = outcome.ruleset.source.path
        for name, why in outcome.unlisted:
            yield _annotation("notice", path, None, name, why)
        for name, why in outcome.undecided:
            yield _annotation("error", path, None, f"unknown: {name}", f"{name} is inconclusive: {why}")
    yield f"{in_short(outcomes)}\n"


def _annotation(command: str, path: str, place: Place | None, title: str, message: str) -> str:
    where = {"file": in_project(path)}
    if place is not None:
        where |= {"line": str(place.line), "endLine": str(place.end_line)}
        if place.line == place.end_line:  # columns mean something within one line only
            where |= {"col": str(place.column), "endColumn": str(place.end_column)}
    where["title"] = title
    properties = ",".join(f"{name}={_property(value)}" for name, value in where.items())
    return f"::{command} {properties}::{_data(message)}\n"


def _data(text: str) -> str:
    """`text` as the message of a command, with escaped line breaks: a line break would start another command."""
    return escaped(text, "\r\n").replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
