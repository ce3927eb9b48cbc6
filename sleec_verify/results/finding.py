"""Verdicts and findings: checks create them, and renderers show them."""

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
"""From the most severe to the least."""


class ClauseRef(NamedTuple):
    """A clause of a rule by the rule's label and the clause's number (0 is the default, i is hedge i)."""

    rule: str
    clause: int


@dataclass(frozen=True)
class Witness:
    """A smallest situation that shows a finding: the triggers that occur, the relevant conditions, and the triggers
    that must be `absent`.

    A condition or measure that is not in `conditions` does not matter; the finding also holds if it is false. Values
    are truth values, exact numbers, or values of a scale.
    """

    triggers: tuple[str, ...]
    conditions: Mapping[str, Value]
    absent: tuple[str, ...] = ()

    def context(self) -> Context:
        """The situation in which everything irrelevant is false."""
        from sleec_runtime.model import Context

        return Context(frozenset(self.triggers), dict(self.conditions))


@dataclass(frozen=True)
class Finding:
    """One problem that a check found.

    `span` is the main place. `related` are further places with a short text for each. They are places in `source`, or
    in the text of the rules if that is None. `timeline` is the witness of a finding about time, and `strategy` that of
    an environment that wins; `witness` is then one of its instants. `obligations` are those that contradict each other
    or are affected. `domains` are the domains in which the finding holds, if the ruleset has domains. `allowed` is the
    reason why the team accepts it, if it does.
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
    allowed: str | None = None


@dataclass(frozen=True)
class Proved:
    """The property holds in every context."""


@dataclass(frozen=True)
class Refuted:
    """The property fails. The findings say how, with witnesses if there are any."""

    findings: tuple[Finding, ...]


@dataclass(frozen=True)
class Unknown:
    """The check is inconclusive. `why` is the reason; earlier findings remain valid."""

    why: str
    findings: tuple[Finding, ...] = ()


Verdict = Union[Proved, Refuted, Unknown]


@dataclass(frozen=True)
class CheckResult:
    """The verdict of one check on one ruleset, and the seconds that it took. `reason` says why the list is
    incomplete, if it is."""

    name: str
    verdict: Verdict
    seconds: float
    reason: str | None = None

    @property
    def findings(self) -> tuple[Finding, ...]:
        return () if isinstance(self.verdict, Proved) else self.verdict.findings
