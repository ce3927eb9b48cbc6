"""Repairs of findings, as values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.repairs.edit import TextEdit
    from sleec_verify.repairs.effect import Effect
    from sleec_verify.results.finding import Finding

Operator = Literal[
    "trigger-strengthening",
    "defeater-introduction",
    "defeater-refinement",
    "defeater-reordering",
    "defeater-removal",
    "response-refinement",
    "deadline-refinement",
    "rule-addition",
    "rule-merging",
    "rule-decomposition",
    "rule-removal",
    "declaration-removal",
    "claim-removal",
    "assumption",
    "correction",
    "renaming",
    "canonical-form",
]
"""The kinds of repair. Most are those of SLEEC-PATCH (2026)."""


@dataclass(frozen=True)
class Candidate:
    """A change of the text that may repair a finding.

    `title` is an imperative sentence that names the rule and quotes the text to write. `gives_way` is the rule that
    yields to others in a conflict, if one does.
    """

    operator: Operator
    title: str
    edits: tuple[TextEdit, ...]
    gives_way: str | None = None


@dataclass(frozen=True)
class Repair:
    """A candidate of which a check of the changed text shows that it removes the finding and introduces none."""

    finding: Finding
    candidate: Candidate
    effect: Effect
    repaired: Ruleset
