"""A check: the question it asks, the kinds of finding it makes with their documentation, and its function."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from sleec_runtime.model import Clause, Formula, Obligation, Span
from sleec_verify.encoding.equation import guard
from sleec_verify.query.ruleset_index import ClausePosition, RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding, Witness
from sleec_verify.results.finding_kind import FindingKind as FindingKind

if TYPE_CHECKING:
    from sleec_verify.results.strategy import Strategy
    from sleec_verify.results.timeline import Timeline

Scope = Literal["some domain", "every domain", "text"]
"""Where a finding must hold to count: in some domain, in every domain in which its first rule applies, or whatever
the domain, because it is about the text."""


@dataclass(frozen=True)
class Check:
    """A question about a ruleset.

    `run` yields the findings. If it yields none, the property is proved. It raises `Undecided` if it cannot decide.
    """

    name: str
    question: str
    kinds: tuple[FindingKind, ...]
    run: Callable[[RulesetIndex], Iterable[Finding]]
    scope: Scope = "some domain"

    def finding(
        self,
        message: str,
        span: Span,
        *,
        kind: int = 0,
        rules: tuple[str, ...] = (),
        clauses: tuple[ClauseRef, ...] = (),
        obligations: tuple[str, ...] = (),
        witness: Witness | None = None,
        note: str | None = None,
        help: str | None = None,
        related: tuple[tuple[Span, str], ...] = (),
        timeline: Timeline | None = None,
        strategy: Strategy | None = None,
    ) -> Finding:
        """A finding of this check, of its kind number `kind`."""
        code, severity = self.kinds[kind].code, self.kinds[kind].severity
        return Finding(
            self.name,
            code,
            severity,
            message,
            span,
            rules,
            clauses,
            obligations,
            witness,
            note,
            help,
            related,
            timeline=timeline,
            strategy=strategy,
        )


def clause_at(index: RulesetIndex, place: ClausePosition) -> Clause:
    return index.clauses[place.rule][place.number]


def guard_at(index: RulesetIndex, place: ClausePosition) -> Formula:
    """The guard of a clause, written out."""
    return guard(index.rules[place.rule], index.ruleset.reading, place.number)


def literals_of(clauses: Iterable[Clause]) -> set[Obligation]:
    """Every literal that some of the clauses oblige."""
    return {obligation for clause in clauses for obligation in clause.obligations}
