"""Assertions and their results, as values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, Union

from sleec_runtime.model import (
    Formula,
    Obligation,
    Ruleset,
    Source,
    Span,
)
from sleec_verify.changes.compare import DecidingClause
from sleec_verify.results.finding import Witness

Kind = Literal["never", "always"]


@dataclass(frozen=True)
class Assertion:
    """In situations with `when`, `literals` are never all obliged, or each of them always is."""

    kind: Kind
    literals: tuple[Obligation, ...]
    when: Formula
    source: Source
    span: Span

    @property
    def text(self) -> str:
        """The original text."""
        return self.source.in_one_line(self.span)


class Violation(NamedTuple):
    """A smallest situation in which an assertion does not hold, with the clauses that decide there. `domain` is its
    domain, if the ruleset has domains."""

    witness: Witness
    deciding: tuple[DecidingClause, ...]
    domain: str | None = None


class AssertionResult(NamedTuple):
    """The answer for one ruleset: None if the assertion holds, otherwise the counterexample, or why the answer is
    unknown."""

    assertion: Assertion
    ruleset: Ruleset
    answer: Union[Violation, str, None]
