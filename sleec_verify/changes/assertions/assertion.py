"""Assertions, and what is found of them."""

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
    """Where `when` holds, never all of `literals` are called for, or always each of them is."""

    kind: Kind
    literals: tuple[Obligation, ...]
    when: Formula
    source: Source
    span: Span

    @property
    def text(self) -> str:
        """As it was written."""
        return " ".join(self.source.text[self.span.start : self.span.end].split())


class Violation(NamedTuple):
    """A smallest situation in which an assertion does not hold, with the clauses that decide there. `domain` is the one
    in which that is so, if the ruleset has any."""

    witness: Witness
    deciding: tuple[DecidingClause, ...]
    domain: str | None = None


class AssertionResult(NamedTuple):
    """The answer for one ruleset: None where the assertion holds, else the counterexample, or why it is not decided."""

    assertion: Assertion
    ruleset: Ruleset
    answer: Union[Violation, str, None]
