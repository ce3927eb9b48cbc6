"""What a gate finds, as values."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from sleec_runtime.certificate.manifest import Manifest
    from sleec_runtime.errors import Problem, SleecError
    from sleec_runtime.model import Ruleset, Span
    from sleec_verify.changes.assertions.assertion import AssertionResult
    from sleec_verify.changes.compare import Difference
    from sleec_verify.changes.gate.keys import Target
    from sleec_verify.changes.gate.suppressions import Suppression
    from sleec_verify.results.finding import CheckResult, Finding

POLICY_CHANGES = "policy-changes"
NEW_SUPPRESSIONS = "new-suppressions"
"""Policies about what decides."""

Status = Literal["passed", "blocked", "unknown", "unusable"]


class Block(NamedTuple):
    """A reason not to let a change in: by which policy, in which ruleset or code, and what it is. `finding` says where
    in the text, and why; what is unknown has none."""

    policy: str
    where: str
    what: str
    finding: Finding | None = None


class Coverage(NamedTuple):
    """How many of a ruleset's clauses its cases reach; `why` says why that is not known."""

    reached: int
    clauses: int
    missed: tuple[str, ...] = ()
    why: str | None = None

    @property
    def percent(self) -> float:
        return 100 * self.reached / self.clauses if self.clauses else 100.0


@dataclass
class RulesetExamination:
    """One ruleset that changed (or that all were asked for).

    `was` is its path in the base, where that was another. `ruleset` is what it is now; None where it is gone or cannot
    be read. `findings` count; `allowed` are suppressed, with the suppression, and `known` stand in the baseline. `new`
    suppressions are not in the base, `unused` ones meet nothing, `problems` are suppressions that are none.
    `conflicting` are the rules of each conflict of the base, where the baseline has some of now. `certificate` is what
    the one that holds says, or why there is none, where one is asked for.
    """

    path: str
    was: str | None = None
    ruleset: Ruleset | None = None
    difference: Difference | None = None
    results: tuple[CheckResult, ...] = ()
    findings: list[Finding] = field(default_factory=list)
    allowed: list[tuple[Finding, Suppression]] = field(default_factory=list)
    known: list[Finding] = field(default_factory=list)
    new: list[Suppression] = field(default_factory=list)
    unused: list[Suppression] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list)
    conflicting: frozenset[frozenset[str]] = frozenset()
    coverage: Coverage | None = None
    certificate: Manifest | str | None = None
    errors: list[SleecError] = field(default_factory=list)

    def line(self, span: Span) -> int:
        """The line of a place in the text as it is now."""
        assert self.ruleset is not None, "what cannot be read has no places"
        return self.ruleset.source.place(span).line


@dataclass
class TargetConformance:
    """A target: its verdict and the findings that count, or why there is none."""

    target: Target
    ruleset: Ruleset | None = None
    result: CheckResult | None = None
    findings: list[Finding] = field(default_factory=list)
    known: list[Finding] = field(default_factory=list)
    why: str | None = None
    error: SleecError | None = None


@dataclass
class GateResult:
    """All that came of a gate.

    `base` is what the base is called, `unchanged` how many rulesets were left out. `paths` says what the rulesets are
    called of which assertions were asked, by the paths of their texts. `changes` are those of the settings, and new
    suppressions; those that the policy does not allow are among `blocks`. `heeded` is whether what is unknown keeps a
    change out.
    """

    base: str
    examined: list[RulesetExamination] = field(default_factory=list)
    unchanged: int = 0
    conformed: list[TargetConformance] = field(default_factory=list)
    asked: tuple[AssertionResult, ...] = ()
    paths: dict[str, str] = field(default_factory=dict)
    changes: list[Block] = field(default_factory=list)
    blocks: list[Block] = field(default_factory=list)
    unknown: list[Block] = field(default_factory=list)
    heeded: bool = True
    stale: int = 0

    @property
    def tolerated(self) -> list[Block]:
        """The changes that the policy allows."""
        return [change for change in self.changes if change not in self.blocks]

    @property
    def unusable(self) -> bool:
        """Whether something could not be read, so that nothing is said of it."""
        return any(one.errors for one in self.examined) or any(one.error is not None for one in self.conformed)

    @property
    def status(self) -> Status:
        """What to do with the change: what blocks weighs more than what is unknown, what is unusable most."""
        if self.unusable:
            return "unusable"
        if self.blocks:
            return "blocked"
        return "unknown" if self.unknown and self.heeded else "passed"
