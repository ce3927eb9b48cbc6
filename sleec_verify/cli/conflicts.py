"""The conflicts of one ruleset, for a person who resolves them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.checks import run_checks
from sleec_verify.checks.conflict import CONFLICT
from sleec_verify.cli import exits
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import CheckResult, Finding, Unknown

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.encoding.scope import Scope


class Conflicts(NamedTuple):
    """A ruleset with the results of all its checks. A rule that always conflicts is among the rules of a conflict."""

    ruleset: Ruleset
    results: tuple[CheckResult, ...]
    scope: Scope

    @classmethod
    def of(cls, ruleset: Ruleset, scope: Scope) -> Conflicts:
        """Check a ruleset."""
        results = run_checks(ruleset, None, scope.domain, untimed=scope.untimed, chains=scope.chains)
        return cls(ruleset, results, scope)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The conflicts in the order of the text."""
        return self._result.findings

    @property
    def undecided(self) -> str | None:
        """Why there may be more conflicts, if the check is inconclusive."""
        verdict = self._result.verdict
        return verdict.why if isinstance(verdict, Unknown) else None

    @property
    def _result(self) -> CheckResult:
        return next(result for result in self.results if result.name == CONFLICT.name)

    @property
    def search(self) -> RepairSearch:
        """The search of their repairs."""
        return RepairSearch(self.ruleset, self.results, self.scope)

    @property
    def exit_code(self) -> int:
        return exits.code((self._result,), "error")
