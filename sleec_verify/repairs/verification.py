"""Whether a changed text removes a finding and introduces none."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Container, Hashable, Iterator, Sequence
from dataclasses import replace

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, parse_source
from sleec_runtime.model import Rule, Ruleset
from sleec_verify.checks import COSTLY, Checking, checks_for
from sleec_verify.checks.conflict import CONFLICT
from sleec_verify.encoding.budget import spend
from sleec_verify.encoding.scope import WHOLE, Scope
from sleec_verify.encoding.solver import released
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.repairs.edit import OffsetMap, edited, in_order, inverse
from sleec_verify.repairs.repair import Candidate
from sleec_verify.replay.traces import replay_found
from sleec_verify.results.finding import CheckResult, Finding, Unknown
from sleec_verify.results.found_trace import FoundTrace
from sleec_verify.traces.known_traces import KnownTraces, using
from sleec_verify.wording.sentence import sentence

Identity = tuple[Hashable, ...]
"""What makes a finding the same before and after a change. A conflict is known by its rules and the places of its
clauses. Any other finding is known by its own place, because the rules that it names may be only those of the situation
that it shows."""


_MOST_REMEMBERED = 2
"""The sets of contradicting rules that are remembered for a finding."""


def is_read_otherwise(ruleset: Ruleset) -> bool:
    """Whether an option of the command replaces the reading of the text. O(size of the text)."""
    return parse_source(ruleset.source).reading != ruleset.reading


class Rejected(Exception):
    """A candidate is not a repair; the message says why. `appeared` is a finding that the changed rules have.

    If it is `undecided`, a check could not tell, and the candidate may be a repair.
    """

    def __init__(
        self, why: str, changed: Ruleset | None = None, appeared: Finding | None = None, undecided: bool = False
    ) -> None:
        super().__init__(why)
        self.changed = changed
        self.appeared = appeared
        self.undecided = undecided


class Verification:
    """Checks changed texts of one ruleset against the findings that it has.

    `results` are those of `ruleset` in `scope`.
    """

    def __init__(self, ruleset: Ruleset, results: Sequence[CheckResult], scope: Scope = WHOLE) -> None:
        self._ruleset = ruleset
        self._scope = scope
        self._is_read_otherwise = is_read_otherwise(ruleset)
        self._names = [result.name for result in results]
        self._unknown = {result.name for result in results if isinstance(result.verdict, Unknown)}
        self._known_traces = KnownTraces(_is_shown)
        self._checked_texts: dict[str, tuple[Ruleset, tuple[CheckResult, ...]]] = {}
        """The texts that passed all checks for some finding."""
        self._contradicting: dict[Identity, list[frozenset[str]]] = {}
        """For each finding, the last rules that contradicted each other after a change."""
        self._found = Counter(_identity(ruleset, f) for result in results for f in result.findings)

    def repaired(self, finding: Finding, candidate: Candidate) -> tuple[Ruleset, tuple[CheckResult, ...]]:
        """The rules after the change, and the results of their checks, if these show that `finding` is gone and that no
        other appeared.

        A check that decided before must decide again. Costs at most one check of the ruleset.

        Raises:
            OutOfBudget: the budget is spent.
            Rejected: the change is not a repair, or it cannot be shown to be one.
        """
        with released(), using(self._known_traces):
            return self._checked(finding, candidate)

    def _checked(self, finding: Finding, candidate: Candidate) -> tuple[Ruleset, tuple[CheckResult, ...]]:
        source = self._ruleset.source
        spend(len(source.text))
        edits = in_order(candidate.edits)
        text = edited(source.text, edits)
        known = self._checked_texts.get(text)
        new = self._parsed(text) if known is None else known[0]
        places = _Places(self._ruleset, new, OffsetMap(inverse(source.text, edits)))
        if not places.same_text_is_same_meaning():
            raise Rejected("a part of the text that does not change would be read differently")
        target = _identity(self._ruleset, finding)
        allowed = self._found - Counter((target,))

        def examine(one: Finding, others: Container[Identity] = ()) -> None:
            identity = places.identity(one)
            if identity in others or not allowed[identity]:
                why = (
                    sentence("the finding stays")
                    if identity == target
                    else sentence("{code} appears: {message}", code=one.code, message=one.message)
                )
                raise Rejected(why, new, one)

        if known is not None:
            for result in known[1]:
                more = Counter(places.identity(one) for one in result.findings) - allowed
                for one in result.findings:
                    examine(one, more)
            return known
        # Rules that contradict each other on their own do so among other rules, with rare exceptions. These small
        # questions reject most candidates: about the rules of the finding, and those that contradicted each other after
        # another change.
        contradicting = self._contradicting.setdefault(target, [])
        if finding.check == CONFLICT.name:
            for one in self._among(places, finding.rules):
                if places.identity(one) == target:
                    examine(one)
        for labels in contradicting:
            for one in self._among(places, labels):
                examine(one)
        try:
            results = self._results(new, finding, places, examine, allowed)
        except Rejected as rejected:
            appeared = rejected.appeared
            if appeared is not None and appeared.check == CONFLICT.name and len(appeared.rules) > 1:
                contradicting.insert(0, frozenset(map(places.earlier, appeared.rules)))
                del contradicting[_MOST_REMEMBERED:]
            raise
        self._checked_texts[text] = new, results
        return new, results

    def _parsed(self, text: str) -> Ruleset:
        try:
            new = parse(text, self._ruleset.source.path)
        except LanguageError as error:
            raise Rejected(f"the text is not a ruleset: {error.problems[0].message}") from None
        if new.dialect != self._ruleset.dialect:
            raise Rejected("the text is no longer in its dialect of the DSL")
        return new.read_as(self._ruleset.reading) if self._is_read_otherwise else new

    def _among(self, places: _Places, labels: Collection[str]) -> tuple[Finding, ...]:
        """The conflicts of some rules on their own."""
        return self._checking(places.only(labels)).result(CONFLICT.name).findings

    def _results(
        self,
        new: Ruleset,
        finding: Finding,
        places: _Places,
        examine: Callable[[Finding, Container[Identity]], None],
        allowed: Counter[Identity],
    ) -> tuple[CheckResult, ...]:
        """The results of all checks. Raises `Rejected` as `repaired` does."""
        checking = self._checking(new, lambda one: examine(one, ()))
        # Some texts leave no question open: one that states its reading can be read in one way only.
        settled = set(checks_for(self._ruleset)) - set(checks_for(new))
        # The cheap questions first, and of the others that of the finding: they reject most candidates.
        others = [name for name in self._names if name not in (finding.check, *settled)]
        cheap = [name for name in others if name not in COSTLY]
        own = [name for name in (finding.check,) if name not in settled]
        found: list[CheckResult] = []
        for names in (cheap, own, [name for name in others if name in COSTLY]):
            for result in checking.results(names):
                found.append(result)
                if isinstance(result.verdict, Unknown) and result.name not in self._unknown:
                    why = sentence(
                        "the check {check} of the changed text is unknown: {why}",
                        check=result.name,
                        why=result.verdict.why,
                    )
                    raise Rejected(why, undecided=True)
                more = Counter(places.identity(one) for one in result.findings) - allowed
                for one in result.findings:
                    examine(one, more)
        return tuple(found)

    def _checking(self, ruleset: Ruleset, examine: Callable[[Finding], None] | None = None) -> Checking:
        scope = self._scope
        return Checking(ruleset, scope.domain, scope.untimed, chains=scope.chains, seen=examine)


class _Places:
    """The changed rules with the labels and places that they had before the change."""

    def __init__(self, old: Ruleset, new: Ruleset, back: OffsetMap) -> None:
        self._back = back
        self._old = old
        self._new = new
        # A rule without a label is called by its number, which may change.
        before = {rule.span.start: rule.label for rule in old.rules if not rule.always}
        self._labels = {
            rule.label: before[start] for rule in new.rules if (start := back.after(rule.span.start)) in before
        }

    def same_text_is_same_meaning(self) -> bool:
        """Whether each statement with the same text is the same. A name may be of another kind without a rule that the
        change removes."""
        before = {one.span.start: one for one in self._old.statements}
        for new in self._new.statements:
            start = self._back.after(new.span.start)
            old = None if start is None else before.get(start)
            if old is None or self._old.source.text[slice(*old.span)] != self._new.source.text[slice(*new.span)]:
                continue
            if isinstance(new, Rule) and isinstance(old, Rule):
                # An ALWAYS is a rule for each trigger, with one place for all.
                new = replace(new, label=old.label, trigger=old.trigger if old.always else new.trigger)
            if new != old:
                return False
        return True

    def identity(self, finding: Finding) -> Identity:
        """The identity of a finding of the new rules as one of the old rules; a new place is None."""
        if finding.check != CONFLICT.name:
            return finding.code, self._back.after(finding.span.start)
        rules = frozenset(map(self.earlier, finding.rules))
        return finding.code, rules, frozenset(map(self._back.after, _clause_places(self._new, finding)))

    def earlier(self, label: str) -> str:
        """The label of a rule before the change."""
        return self._labels.get(label, label)

    def only(self, kept: Container[str]) -> Ruleset:
        """The new ruleset with only those rules whose earlier labels are `kept`."""
        rules = (one for one in self._new.statements if not isinstance(one, Rule) or self.earlier(one.label) in kept)
        return replace(self._new, statements=tuple(rules))


def _is_shown(ruleset: Ruleset, untimed: Untimed, found: FoundTrace) -> bool:
    return replay_found(RulesetIndex(ruleset, untimed=untimed), found)


def _identity(ruleset: Ruleset, finding: Finding) -> Identity:
    if finding.check != CONFLICT.name:
        return finding.code, finding.span.start
    return finding.code, frozenset(finding.rules), frozenset(_clause_places(ruleset, finding))


def _clause_places(ruleset: Ruleset, finding: Finding) -> Iterator[int]:
    for label, number in finding.clauses:
        yield list(ruleset.by_label[label].clauses())[number].span.start
