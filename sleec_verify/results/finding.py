"""What a check says: verdicts and findings. Checks make them, renderers show them; neither does the other's work."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple, Union

if TYPE_CHECKING:
    from sleec_runtime.model import Context, Source, Span, Value
    from sleec_verify.results.strategy import Strategy
    from sleec_verify.results.timeline import Timeline

Severity = Literal["error", "warning", "note"]
SEVERITIES: tuple[Severity, ...] = ("error", "warning", "note")
"""From the gravest down."""


class ClauseRef(NamedTuple):
    """A clause of a rule by the rule's label and the clause's number (0 is the default, i is hedge i)."""

    rule: str
    clause: int


@dataclass(frozen=True)
class Witness:
    """A smallest situation that shows a finding: the triggers that occur, the conditions that matter, and the triggers
    that must be `absent`.

    A condition or measure that is not in `conditions` does not matter; taking it as false shows the finding too.
    Values are truth values, exact numbers, or values of a scale.
    """

    triggers: tuple[str, ...]
    conditions: Mapping[str, Value]
    absent: tuple[str, ...] = ()

    def context(self) -> Context:
        """The situation in which all that does not matter is false."""
        from sleec_runtime.model import Context

        return Context(frozenset(self.triggers), dict(self.conditions))


@dataclass(frozen=True)
class Finding:
    """One thing that a check found.

    `span` is the place to look at first; `related` are further places with a word on each. They are places of `source`,
    or of the text of the rules where that is None. `timeline` is the witness of what takes time, `strategy` that of an
    environment that wins; `witness` is then one moment of it. `obligations` are those at odds or concerned. `domains`
    are the domains in which it holds, if the ruleset has any.
    """

    check: str
    code: str
    severity: Severity
    message: str
    span: Span
    rules: tuple[str, ...] = ()
    clauses: tuple[ClauseRef, ...] = ()
    obligations: tuple[str, ...] = ()
    witness: Witness | None = None
    note: str | None = None
    help: str | None = None
    related: tuple[tuple[Span, str], ...] = ()
    domains: tuple[str, ...] = ()
    source: Source | None = None
    timeline: Timeline | None = None
    strategy: Strategy | None = None


@dataclass(frozen=True)
class Proved:
    """The property holds in every context."""


@dataclass(frozen=True)
class Refuted:
    """The property fails; the findings, each with its witness where there is one, say how."""

    findings: tuple[Finding, ...]


@dataclass(frozen=True)
class Unknown:
    """Not decided. `why` says what stood in the way; findings made before that stay true."""

    why: str
    findings: tuple[Finding, ...] = ()


Verdict = Union[Proved, Refuted, Unknown]


@dataclass(frozen=True)
class CheckResult:
    """The verdict of one check on one ruleset and the seconds that it took. `reason` says, where there is something
    to say, why not everything is listed."""

    name: str
    verdict: Verdict
    seconds: float
    reason: str | None = None

    @property
    def findings(self) -> tuple[Finding, ...]:
        return () if isinstance(self.verdict, Proved) else self.verdict.findings
