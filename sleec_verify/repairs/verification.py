"""Whether a changed text removes a finding and introduces none."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks import Checking
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.repairs.edit import OffsetMap, edited, in_order
from sleec_verify.repairs.repair import Candidate
from sleec_verify.results.finding import CheckResult, Finding, Unknown

Identity = tuple[str, tuple[str, ...], tuple[str, ...]]
"""A finding by its code, its rules and its obligations. Clauses do not count: a repair may add or remove one."""


class Rejection(NamedTuple):
    """Why a candidate is not a repair."""

    why: str


class Verification:
    """Checks changed texts of one ruleset against the findings that it has.

    `results` are those of `ruleset`; the options are those with which they were made.
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
        self._chains = chains
        self._names = [result.name for result in results]
        self._unknown = {result.name for result in results if isinstance(result.verdict, Unknown)}
        self._found = Counter(_identity(f, {}) for result in results for f in result.findings)
        self._at = {rule.span.start: rule.label for rule in ruleset.rules}

    def repaired(self, finding: Finding, candidate: Candidate) -> Ruleset | Rejection:
        """The rules after the change, if the checks show that `finding` is gone and that no other appeared.

        A check that decided before must decide again. Costs at most one check of the ruleset.
        """
        edits = in_order(candidate.edits)
        text = edited(self._ruleset.source.text, edits)
        try:
            new = parse(text, self._ruleset.source.path)
        except LanguageError as error:
            return Rejection(f"the text is not a ruleset: {error.problems[0].message}")
        if not self._ruleset.reading_stated and new.reading != self._ruleset.reading and not new.reading_stated:
            new = new.read_as(self._ruleset.reading)
        labels = self._labels(new, OffsetMap(edits))
        checking = Checking(new, self._domain, self._untimed, chains=self._chains)
        wanted = self._found[_identity(finding, {})]
        # The question of the finding first: it rejects most candidates.
        first = [finding.check] if finding.check in self._names else []
        for names in (first, [name for name in self._names if name not in first]):
            for result in checking.results(names):
                if isinstance(result.verdict, Unknown) and result.name not in self._unknown:
                    return Rejection(f"the check {result.name} of the changed text is unknown: {result.verdict.why}")
                found: Counter[Identity] = Counter()
                for one in result.findings:
                    identity = _identity(one, labels)
                    found[identity] += 1
                    if found[identity] > self._found[identity]:
                        return Rejection(f"{one.code} appears: {one.message}")
                if result.name == finding.check and found[_identity(finding, {})] >= wanted:
                    return Rejection("the finding stays")
        return new

    def _labels(self, new: Ruleset, offsets: OffsetMap) -> Mapping[str, str]:
        """The earlier label of each rule: a rule without a label is called by its number, which may change."""
        places = {offsets.after(start): label for start, label in self._at.items()}
        return {rule.label: places[rule.span.start] for rule in new.rules if rule.span.start in places}


def _identity(finding: Finding, labels: Mapping[str, str]) -> Identity:
    rules = tuple(sorted(labels.get(rule, rule) for rule in finding.rules))
    return finding.code, rules, tuple(sorted(finding.obligations))
