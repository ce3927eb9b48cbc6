"""The results of a gate, as values."""

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
    from sleec_verify.changes.revisions.versions import UnreadSubmodule
    from sleec_verify.results.finding import CheckResult, Finding
    from sleec_verify.results.suppressions import Suppression

POLICY_CHANGES = "policy-changes"
NEW_SUPPRESSIONS = "new-suppressions"
"""The names of policies about settings."""

Status = Literal["passed", "blocked", "unknown", "unusable"]


class Block(NamedTuple):
    """A reason to block a change: the policy, the ruleset or code, and the problem. `finding` has the place and the
    explanation; an unknown answer has none."""

    policy: str
    where: str
    what: str
    finding: Finding | None = None


class Coverage(NamedTuple):
    """How many of a ruleset's clauses its cases reach, and how many of its windows they meet or miss. `missed` are the
    others."""

    reached: int
    clauses: int
    missed: tuple[str, ...] = ()
    windows_reached: int = 0
    windows: int = 0

    @property
    def percent(self) -> float:
        goals = self.clauses + self.windows
        return 100 * (self.reached + self.windows_reached) / goals if goals else 100.0

    def __str__(self) -> str:
        clauses = f"{self.reached} of {self.clauses} clauses"
        return f"{clauses} and {self.windows_reached} of {self.windows} windows" if self.windows else clauses


@dataclass
class RulesetExamination:
    """One examined ruleset.

    `was` is its path in the base, if that differs. `ruleset` is the current one; None if it was deleted or cannot be
    read. `findings` count. `allowed` are suppressed, each with its suppression, and `known` are in the baseline. `new`
    suppressions are not in the base, `unused` ones match no finding, and `problems` are invalid suppressions.
    `deleted`: the base has it and the change does not. `unread` is why the rules of a submodule cannot be read.
    `certificate` is the content of the valid one, or why there is none, if one is required.
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
    coverage: Coverage | None = None
    certificate: Manifest | str | None = None
    deleted: bool = False
    unread: UnreadSubmodule | None = None
    errors: list[SleecError] = field(default_factory=list)

    def line(self, span: Span) -> int:
        """The line of a place in the current text."""
        assert self.ruleset is not None, "what cannot be read has no places"
        return self.ruleset.source.place(span).line


@dataclass
class TargetConformance:
    """A target: its verdict and the findings that count. Without a verdict, there is an `error`."""

    target: Target
    ruleset: Ruleset | None = None
    result: CheckResult | None = None
    findings: list[Finding] = field(default_factory=list)
    known: list[Finding] = field(default_factory=list)
    error: SleecError | None = None


@dataclass
class GateResult:
    """All results of a gate.

    `base` is the name of the base in messages, and `unchanged` the number of rulesets that were left out. `paths` has
    the names of the rulesets whose assertions were checked, by the paths of their texts. `changes` are those of the
    settings, and new suppressions; those that the policy does not allow are among `blocks`. `heeded` says whether
    unknown answers block.
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
        """Whether something could not be read, so that there is no answer about it."""
        return any(one.errors for one in self.examined) or any(one.error is not None for one in self.conformed)

    @property
    def status(self) -> Status:
        """The status of the change. Invalid input comes before blocks, and blocks come before unknown answers."""
        if self.unusable:
            return "unusable"
        if self.blocks:
            return "blocked"
        return "unknown" if self.unknown and self.heeded else "passed"
