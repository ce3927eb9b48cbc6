"""All repairs of a finding: candidates of each operator, verified and ranked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.errors import Unsayable
from sleec_runtime.model import Ruleset
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.repairs.edit import edited
from sleec_verify.repairs.effect import effect_of
from sleec_verify.repairs.operators import OPERATORS
from sleec_verify.repairs.repair import Candidate, Repair
from sleec_verify.repairs.verification import Rejected, Verification
from sleec_verify.results.finding import CheckResult, Finding


class RepairSearch:
    """The verified repairs of the findings of one ruleset.

    `results` are those of `ruleset`, made with the same options. Every repair costs at most one check of the ruleset
    and one comparison.
    """

    def __init__(
        self,
        ruleset: Ruleset,
        results: Sequence[CheckResult],
        domain: str | None = None,
        untimed: Untimed = "at",
        chains: bool = True,
    ) -> None:
        self._ruleset = ruleset
        self._domain = domain
        self._untimed: Untimed = untimed
        self._verification = Verification(ruleset, results, domain, untimed, chains)

    def repairs(self, finding: Finding) -> list[Repair]:
        """The repairs, those that change the fewest situations first, and of these the shortest edits."""
        found = [repair for candidate in self.candidates(finding) for repair in self._repair(finding, candidate)]
        return sorted(found, key=_size)

    def candidates(self, finding: Finding) -> Iterator[Candidate]:
        """The candidates of the operators for a finding, each changed text once."""
        text = self._ruleset.source.text
        seen = {text}
        for operator in OPERATORS.get(finding.code, ()):
            try:
                for candidate in operator(self._ruleset, finding):
                    changed = edited(text, candidate.edits)
                    if changed not in seen:
                        seen.add(changed)
                        yield candidate
            except Unsayable:  # the language has no words for this change
                continue

    def _repair(self, finding: Finding, candidate: Candidate) -> Iterator[Repair]:
        try:
            repaired = self._verification.repaired(finding, candidate)
        except Rejected:
            return
        yield Repair(finding, candidate, effect_of(self._ruleset, repaired, self._domain, self._untimed), repaired)


def _size(repair: Repair) -> tuple[bool, int, int, str]:
    situations = repair.effect.situations
    length = sum(len(edit.text) + edit.end - edit.start for edit in repair.candidate.edits)
    return situations is None, situations or 0, length, repair.candidate.title
