"""Suppressions, ``# sleec: allow SLEEC202@0f61c2a98b3d4e57 because …`` in the text of rules: a finding that the team
accepts, with the reason.

After a statement, it is about that line. On its own line, it is about the rule or line below it. The fingerprint after
`@` names one finding, so that a suppression allows no later one. Codes about names need no fingerprint: the place is
that of the name.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from typing import NamedTuple

from sleec_runtime.errors import Problem
from sleec_runtime.model import Ruleset, Span
from sleec_verify.results.finding import Finding
from sleec_verify.results.fingerprint import fingerprint

_MARK = re.compile(r"(?://|#)\s*sleec\s*:\s*(.*?)\s*$")
_ALLOW = re.compile(r"allow\s+([\w@-]+(?:\s*,\s*[\w@-]+)*)(?:\s+because\b\s*(.*))?$", re.IGNORECASE)
_EXAMPLE = "write: # sleec: allow SLEEC202 because the sensor comes next year"


class Suppression(NamedTuple):
    """An allowed code or check in the lines from `first` to `last`, with the fingerprint of the finding (empty without
    one), and the reason. `span` is the comment; a comment with several codes has a suppression for each. `about` are
    the words of its line, and of the first line of the rule of that line."""

    allowed: str
    fingerprint: str
    reason: str
    first: int
    last: int
    span: Span
    about: tuple[str, str]

    def allows(self, ruleset: Ruleset, finding: Finding) -> bool:
        """Whether it allows a finding: it covers this one, and names it."""
        return self.covers(ruleset, finding) and self.fingerprint == fingerprint(ruleset, finding)

    def covers(self, ruleset: Ruleset, finding: Finding) -> bool:
        """Whether it is about a finding like this one: one of the finding's places in the rules is in these lines."""
        if self.allowed not in (finding.code, finding.check) or finding.source is not None:
            return False
        places = map(ruleset.source.place, (finding.span, *(span for span, _ in finding.related)))
        return any(place.line <= self.last and place.end_line >= self.first for place in places)


def suppressions(ruleset: Ruleset, known: Collection[str] | None = None) -> tuple[list[Suppression], list[Problem]]:
    """The suppressions of a text, and the errors of invalid ones. `known` are all codes and checks; without it, unknown
    ones are accepted."""
    found: list[Suppression] = []
    problems: list[Problem] = []
    if "sleec" not in ruleset.source.text:
        return found, problems
    extents = list(_rules(ruleset))
    position = 0
    lines = ruleset.source.text.split("\n")
    for number, line in enumerate(lines, 1):
        mark = _MARK.search(line)
        if mark is not None:
            span = Span(position + mark.start(), position + mark.end())
            said = _ALLOW.match(mark.group(1))
            wrong = _wrong(said, known)
            if wrong is not None:
                problems.append(Problem(wrong[0], span, wrong[1]))
            else:
                assert said is not None
                alone = not line[: mark.start()].strip()
                first, last = _lines_below(lines, number, extents) if alone else (number, number)
                allowed = (name.strip().partition("@") for name in said.group(1).split(","))
                about = _about(lines, first, extents)
                found += (Suppression(name, one, said.group(2), first, last, span, about) for name, _, one in allowed)
        position += len(line) + 1
    return found, problems


def new_suppressions(old: Iterable[Suppression], new: Iterable[Suppression]) -> list[Suppression]:
    """Those of `new` that `old` does not have: for the same code, with the same reason, at the same line of the
    same rule, wherever that has moved."""
    before = Counter(map(_identity, old))
    found = []
    for one in new:
        if before[_identity(one)]:
            before[_identity(one)] -= 1
        else:
            found.append(one)
    return found


def _identity(one: Suppression) -> tuple[object, ...]:
    return one.allowed, one.fingerprint, one.reason, one.about


def text_to_write(ruleset: Ruleset, finding: Finding, reason: str = "REASON") -> str:
    """The suppression of a finding."""
    return f"# sleec: allow {finding.code}@{fingerprint(ruleset, finding)} because {reason}"


def _wrong(said: re.Match[str] | None, known: Collection[str] | None) -> tuple[str, str] | None:
    if said is None:
        return "this comment starts with sleec: but allows nothing", _EXAMPLE
    if not said.group(2):
        return "a suppression needs a reason", "add the reason: because …"
    for name in (part.strip().partition("@")[0] for part in said.group(1).split(",")):
        if known is not None and name not in known:
            from sleec_runtime.support.suggestions import nearest

            near = nearest(name, sorted(known))
            hint = f"did you mean `{near}`?" if near else "`sleec-verify rules` lists all codes"
            return f"there is no finding code `{name}`", hint
    return None


def _rules(ruleset: Ruleset) -> Iterator[tuple[int, int]]:
    """The lines of each rule, including that of its label."""
    place = ruleset.source.place
    for rule in ruleset.rules:
        first = min(place(span).line for span in (rule.span, rule.label_span) if span.end)
        yield first, place(rule.span).end_line


def _about(lines: list[str], number: int, extents: Iterable[tuple[int, int]]) -> tuple[str, str]:
    head = next((first for first, last in extents if first <= number <= last), number)
    return _words(lines, head), _words(lines, number)


def _words(lines: list[str], number: int) -> str:
    """The words of a line without its suppression. A comment at the end of the text is about no line."""
    return " ".join(_MARK.sub("", lines[number - 1]).split()) if number <= len(lines) else ""


def _lines_below(lines: list[str], number: int, extents: Iterable[tuple[int, int]]) -> tuple[int, int]:
    """The lines of the rule, or otherwise the line, below the comment in line `number`."""
    below = number + 1
    while below <= len(lines) and (not lines[below - 1].strip() or lines[below - 1].lstrip().startswith(("#", "//"))):
        below += 1
    return next(((first, last) for first, last in extents if first == below), (below, below))
