"""Shared parts of the renderers for other programs: paths, fingerprints, findings and errors in words."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.report.details import details

if TYPE_CHECKING:
    from sleec_runtime.model import Place, Source
    from sleec_verify.report.outcome import CheckedRuleset, UnusableInput
    from sleec_verify.results.finding import Finding


class Located(NamedTuple):
    """A finding with its source and its fingerprint."""

    finding: Finding
    source: Source
    fingerprint: str


def located(outcome: CheckedRuleset, seen: dict[str, int]) -> Iterator[Located]:
    """The findings of an outcome in the order of the text.

    The fingerprint is a hash of the code, the path and the marked text, so it does not change if lines move. Equal
    findings are numbered; `seen` counts them over all outcomes of a report.
    """
    from hashlib import sha256

    for finding in outcome.findings:
        source = finding.source or outcome.ruleset.source
        # Labels and messages may hold numbers that change with the place: rule_3, "the NEVER of line 12".
        spans = (finding.span, *(span for span, _ in finding.related))
        marked = [source.in_one_line(span) for span in spans]
        said = (
            finding.code,
            in_project(source.path),
            [clause.clause for clause in finding.clauses],
            finding.obligations,
            marked,
        )
        name = ascii(said)
        seen[name] = number = seen.get(name, 0) + 1
        yield Located(finding, source, sha256(f"{name}{number}".encode()).hexdigest())


def in_project(path: str) -> str:
    """A path as CI services expect it: relative to the working folder, with slashes, without a leading ``./``. A path
    outside that folder stays absolute."""
    path = os.path.normpath(path)
    if os.path.isabs(path):
        inside = os.path.relpath(path)
        path = path if inside.startswith(os.pardir) else inside
    return path.replace(os.sep, "/")


def described(finding: Finding) -> Iterator[str]:
    """The details of a finding, one per line: the situation or timeline, the domains, the note, the help."""
    for title, text, lines in details(finding):
        yield f"{title}: {text}" if text else f"{title}:"
        yield from (f"  {line}" for line in lines)


class Trouble(NamedTuple):
    """One problem of a file, with its place if it has one."""

    path: str
    message: str
    place: Place | None


def troubles(unusable: UnusableInput) -> Iterator[Trouble]:
    """The problems of an invalid file, each with its hint."""
    from sleec_runtime.errors import LanguageError

    error = unusable.error
    if isinstance(error, LanguageError):
        for problem in error.problems:
            yield Trouble(unusable.path, _hinted(problem.message, problem.hint), error.source.place(problem.span))
    else:
        yield Trouble(unusable.path, _hinted(error.message, error.hint), None)


def _hinted(message: str, hint: str | None) -> str:
    return message if hint is None else f"{message}\nhelp: {hint}"
