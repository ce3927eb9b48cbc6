"""Whether a changed text removes a finding and introduces none."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Mapping, Sequence

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, parse_source
from sleec_runtime.model import Ruleset
from sleec_verify.checks import Checking
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.repairs.edit import OffsetMap, edited, in_order
from sleec_verify.repairs.repair import Candidate
from sleec_verify.results.finding import CheckResult, Finding, Unknown

Identity = tuple[str, tuple[str, ...], tuple[str, ...]]
"""A finding by its code, its rules and its obligations. Clauses do not count: a repair may add or remove one."""

_ABOUT: Mapping[str, int] = {
    "SLEEC102": 1,
    "SLEEC104": 0,
    "SLEEC105": 0,
    "SLEEC107": 1,
    "SLEEC301": 1,
}
"""How many of its rules a finding is about. The others explain it; another explanation is not another finding."""


class Rejected(Exception):
    """A candidate is not a repair; the message says why. `appeared` is a finding that the changed rules have."""

    def __init__(self, why: str, changed: Ruleset | None = None, appeared: Finding | None = None) -> None:
        super().__init__(why)
        self.changed = changed
        self.appeared = appeared


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
        # An option of the command replaces the reading that the text states.
        self._is_read_otherwise = parse_source(ruleset.source).reading != ruleset.reading
        self._names = [result.name for result in results]
        self._unknown = {result.name for result in results if isinstance(result.verdict, Unknown)}
        self._found = Counter(_identity(f, {}) for result in results for f in result.findings)
        self._at = {rule.span.start: rule.label for rule in ruleset.rules}

    def repaired(self, finding: Finding, candidate: Candidate) -> Ruleset:
        """The rules after the change, if the checks show that `finding` is gone and that no other appeared.

        A check that decided before must decide again. Costs at most one check of the ruleset.

        Raises:
            Rejected: the change is not a repair, or it cannot be shown to be one.
        """
        edits = in_order(candidate.edits)
        try:
            new = parse(edited(self._ruleset.source.text, edits), self._ruleset.source.path)
        except LanguageError as error:
            raise Rejected(f"the text is not a ruleset: {error.problems[0].message}") from None
        if self._is_read_otherwise:
            new = new.read_as(self._ruleset.reading)
        labels = self._labels(new, OffsetMap(edits))
        target = _identity(finding, {})
        allowed = self._found - Counter((target,))

        def examine(one: Finding, others: Container[Identity] = ()) -> None:
            identity = _identity(one, labels)
            if identity in others or not allowed[identity]:
                why = "the finding stays" if identity == target else f"{one.code} appears: {one.message}"
                raise Rejected(why, new, one)

        checking = Checking(new, self._domain, self._untimed, chains=self._chains, seen=examine)
        # The question of the finding first: it rejects most candidates.
        for names in ([finding.check], [name for name in self._names if name != finding.check]):
            for result in checking.results(names):
                if isinstance(result.verdict, Unknown) and result.name not in self._unknown:
                    raise Rejected(f"the check {result.name} of the changed text is unknown: {result.verdict.why}")
                more = Counter(_identity(one, labels) for one in result.findings) - allowed
                for one in result.findings:
                    examine(one, more)
        return new

    def _labels(self, new: Ruleset, offsets: OffsetMap) -> Mapping[str, str]:
        """The earlier label of each rule: a rule without a label is called by its number, which may change."""
        places = {offsets.after(start): label for start, label in self._at.items()}
        return {rule.label: places[rule.span.start] for rule in new.rules if rule.span.start in places}


def _identity(finding: Finding, labels: Mapping[str, str]) -> Identity:
    about = finding.rules[: _ABOUT.get(finding.code)]
    rules = tuple(sorted(labels.get(rule, rule) for rule in about))
    return finding.code, rules, tuple(sorted(finding.obligations))
