"""All repairs of a finding: candidates of each operator, verified and ranked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from fractions import Fraction

from sleec_runtime.errors import SleecError, Unsayable
from sleec_runtime.model import Reading, Ruleset, Source, Statement
from sleec_verify.encoding.scope import WHOLE, Scope
from sleec_verify.repairs.comments import loses_comment
from sleec_verify.repairs.edit import edited, edits_between
from sleec_verify.repairs.effect import effect_of
from sleec_verify.repairs.operators import CONSEQUENCES, OPERATORS, Operation
from sleec_verify.repairs.operators.removal import DECLARATION, declaration_removal
from sleec_verify.repairs.reasons import Refused, why_none
from sleec_verify.repairs.repair import Candidate, Repair
from sleec_verify.repairs.verification import Rejected, Verification
from sleec_verify.results.finding import CheckResult, Finding
from sleec_verify.results.internal_error import internal_errors_of
from sleec_verify.wording.phrases import listed
from sleec_verify.wording.sentence import sentence

_MOST_STEPS = 6
"""The changes in one repair, at most."""

_REMOVE = ("rule-removal", "defeater-removal", "declaration-removal", "claim-removal", "renaming")
"""The operators that may remove a statement or exception, together with its comments."""


class RepairSearch:
    """The verified repairs of the findings of one ruleset.

    `results` are those of `ruleset` in `scope`. Every repair costs at most one check of the ruleset
    and one comparison.
    """

    def __init__(self, ruleset: Ruleset, results: Sequence[CheckResult], scope: Scope = WHOLE) -> None:
        self._ruleset = ruleset
        self._scope = scope
        self._results = results
        self._verification = Verification(ruleset, results, scope)
        self.undecided: str | None = None
        """Why the last search of repairs may not have found all, if it may not."""
        self.reason: str | None = None
        """Why the last search found none, if it found none and was complete."""
        self._refused: list[Refused] = []

    @property
    def source(self) -> Source:
        """The text that the repairs change."""
        return self._ruleset.source

    def repairs(self, finding: Finding) -> list[Repair]:
        """The repairs, those that take away the least first (`_order`)."""
        self.undecided = self.reason = None
        self._refused = []
        found: dict[tuple[Reading, tuple[Statement, ...]], Repair] = {}
        for operator, candidate in self._proposed(self._ruleset, finding):
            with self._noting_failures():
                repair = self._repair(finding, operator, candidate)
                if repair is not None:
                    found.setdefault((repair.repaired.reading, repair.repaired.statements), repair)
        if not found and self.undecided is None:
            self.reason = why_none(self._ruleset, finding, self._refused)
        return sorted(found.values(), key=_order)

    def verified(self, finding: Finding, candidate: Candidate) -> Repair:
        """The candidate with its effect. Raises `Rejected` if it is not a repair of the finding."""
        repaired, results = self._verification.repaired(finding, candidate)
        effect = effect_of(finding, self._ruleset, repaired, self._scope, self._results, results)
        return Repair(finding, candidate, effect, repaired)

    def candidates(self, finding: Finding) -> list[Candidate]:
        """The candidates of the operators for a finding, each changed text once."""
        return [candidate for _, candidate in self._proposed(self._ruleset, finding)]

    def _proposed(self, ruleset: Ruleset, finding: Finding) -> Iterator[tuple[Operation, Candidate]]:
        text = ruleset.source.text
        seen = {text}
        for operator in OPERATORS.get(finding.code, ()):
            with self._noting_failures():
                for candidate in operator(ruleset, finding):
                    changed = edited(text, candidate.edits)
                    if changed not in seen and _keeps_comments(ruleset, candidate):
                        seen.add(changed)
                        yield operator, candidate

    @contextmanager
    def _noting_failures(self) -> Iterator[None]:
        """A change that fails does not hide the others. One for which the language has no words is none."""
        try:
            with internal_errors_of(""):
                yield
        except Unsayable:
            pass
        except SleecError as error:
            self.undecided = error.message

    def _repair(self, finding: Finding, operator: Operation, candidate: Candidate) -> Repair | None:
        """The verified repair, after further steps if one is not enough.

        A conflict with one rule can hide a conflict with another one. If the rule that gives way conflicts with a
        further rule after the change, the same operator lets it give way to that rule, too. In the end, the rules and
        names that the change makes superfluous are removed.
        """
        is_giving_way = True
        seen = {finding.rules}
        titles = [candidate.title]
        for _ in range(_MOST_STEPS):
            try:
                return self.verified(finding, candidate)
            except Rejected as rejected:
                if rejected.undecided:
                    self.undecided = str(rejected)
                if not rejected.undecided:
                    self._refused.append(Refused(_in_steps(titles), str(rejected)))
                if candidate.operator == "assumption":  # it excludes too much if something has no effect any more
                    return None
                step = _consequence(rejected)
                if step is not None:
                    is_giving_way = False
                elif is_giving_way and rejected.appeared is not None and rejected.appeared.rules not in seen:
                    # A rule that gives way to the same rules again would go on without end.
                    seen.add(rejected.appeared.rules)
                    step = _again(rejected, finding, operator, candidate.gives_way)
                if step is None:
                    return None
                titles.append(step[1].title)
                candidate = replace(self._joined(candidate, *step), title=_in_steps(titles))
        return None

    def _joined(self, first: Candidate, changed: Ruleset, second: Candidate) -> Candidate:
        """Both changes, one after the other, as one."""
        text = edited(changed.source.text, second.edits)
        edits = edits_between(self._ruleset.source.text, text)
        merges = first.operator == "defeater-introduction" and second.operator == "rule-removal"
        operator = "rule-merging" if merges else first.operator
        return replace(first, operator=operator, edits=edits)


def _in_steps(titles: Sequence[str]) -> str:
    """The titles of changes, one after the other, as one. The removed declarations are one list at the end."""
    names = [title.removeprefix(DECLARATION) for title in titles if title.startswith(DECLARATION)]
    steps = [title for title in titles if not title.startswith(DECLARATION)]
    if len(names) == 1:
        steps.append(declaration_removal(names[0]))
    elif names:
        steps.append(sentence("remove the declarations of {names}", names=listed(names)))
    first, *others = steps
    for step in others:
        first = sentence("{steps}; then {step}", steps=first, step=step)
    return first


_Step = tuple[Ruleset, Candidate]
"""The changed rules, and a further change of these."""


def _consequence(rejected: Rejected) -> _Step | None:
    """The removal of what a change has made superfluous, or what it makes necessary."""
    changed, appeared = rejected.changed, rejected.appeared
    if changed is None or appeared is None or appeared.code not in CONSEQUENCES:
        return None
    step = next(CONSEQUENCES[appeared.code](changed, appeared), None)
    return None if step is None else (changed, step)


def _again(rejected: Rejected, finding: Finding, operator: Operation, gives_way: str | None) -> _Step | None:
    """The next change by which the same rule gives way."""
    changed, appeared = rejected.changed, rejected.appeared
    if changed is None or appeared is None or appeared.code != finding.code or gives_way not in appeared.rules:
        return None
    with suppress(Unsayable):
        for one in operator(changed, appeared):
            if one.gives_way == gives_way and _keeps_comments(changed, one):
                return changed, one
    return None


def _keeps_comments(ruleset: Ruleset, candidate: Candidate) -> bool:
    """Whether no comment is lost, except those of a statement or exception that is removed."""
    text = ruleset.source.text
    removes = candidate.operator in _REMOVE
    rest = edited(text, (edit for edit in candidate.edits if edit.text or not removes))
    return not loses_comment(text, rest, ruleset.syntax)


def _order(repair: Repair) -> tuple[bool, bool, Fraction, bool, bool, int, int, str]:
    """By harm: first what leaves no contradiction in the situation of the conflict, then what takes away least, and of
    these what keeps constraints, assumptions and statements, changes fewest situations and is shortest."""
    effect = repair.effect
    length = sum(len(edit.text) + edit.end - edit.start for edit in repair.candidate.edits)
    return (
        effect.after_conflict is not None and effect.after_conflict.is_conflict,
        effect.harm is None,
        effect.harm or Fraction(0),
        bool(effect.difference.constraints or effect.difference.situations),
        repair.candidate.operator in _REMOVE,
        effect.situations or 0,
        length,
        repair.candidate.title,
    )
