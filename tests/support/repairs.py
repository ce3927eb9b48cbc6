"""What holds for every repair, shown without the code that verifies repairs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

from sleec_runtime.language import parse
from sleec_runtime.model import Assume, Context, Exclusive, Never, Rule, Ruleset, Statement
from sleec_verify.checks import run_checks
from sleec_verify.repairs.edit import edited
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import CheckResult, Finding
from tests.support import brute_force


def findings(results: Sequence[CheckResult]) -> list[Finding]:
    return [finding for result in results for finding in result.findings]


def repairs_of(text: str, code: str) -> list[Repair]:
    """The repairs of all findings with a code, each of which is a repair indeed."""
    return [repair for _, repair in found_repairs(parse(text), code)]


def found_repairs(ruleset: Ruleset, code: str) -> Iterator[tuple[Finding, Repair]]:
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    for finding in findings(results):
        if finding.code == code:
            for repair in search.repairs(finding):
                assert_is_repair(ruleset, results, repair)
                yield finding, repair
            assert "internal error" not in (search.undecided or "")


def assert_is_repair(ruleset: Ruleset, results: Sequence[CheckResult], repair: Repair) -> None:
    """A check of the changed text has fewer findings of this code, and not more of any other. Every statement that no
    edit touches is as before, in the same order."""
    edits = repair.candidate.edits
    text = ruleset.source.text + "\n"
    new = parse(edited(ruleset.source.text, edits))
    assert new.statements == repair.repaired.statements
    before = Counter(finding.code for finding in findings(results))
    after = Counter(finding.code for finding in findings(run_checks(new)))
    assert after[repair.finding.code] < before[repair.finding.code], repair.candidate.title
    assert not after - before, repair.candidate.title
    kept = [
        _unnumbered(statement)
        for statement in ruleset.statements
        if not any(
            edit.start <= text.index("\n", statement.span.end) + 1 and statement.span.start <= edit.end
            for edit in edits
        )
    ]
    rest = map(_unnumbered, new.statements)
    assert all(any(statement == other for other in rest) for statement in kept), repair.candidate.title


def _unnumbered(statement: Statement) -> Statement:
    """A rule without the label that is only its number, which changes if a rule before it is removed."""
    return replace(statement, label="") if isinstance(statement, Rule) and not statement.labelled else statement


def texts_after(text: str, repairs: Sequence[Repair]) -> list[str]:
    return [edited(text, repair.candidate.edits) for repair in repairs]


def differing(old: Ruleset, new: Ruleset) -> int:
    """The situations in which the rules oblige something else, or constraints exclude something else, as the first
    rules name them, and those that an assumption excludes."""
    assumed = [one for one in new.constraints if isinstance(one, Assume) and one not in old.constraints]
    return sum(
        not all(brute_force.value(one.formula, context, measures=new.measures) for one in assumed)
        or brute_force.due(old, context) != brute_force.due(new, context)
        or any(broken(old, context, done) != broken(new, context, done) for done in choices(old))
        for context in brute_force.contexts(old)
    )


def choices(ruleset: Ruleset) -> Iterator[frozenset[str]]:
    """Every choice of the obligations."""
    names = sorted(ruleset.obligations)
    for chosen in product((False, True), repeat=len(names)):
        yield frozenset(name for name, yes in zip(names, chosen) if yes)


def broken(ruleset: Ruleset, context: Context, done: frozenset[str]) -> bool:
    """Whether the obligations that are done break a constraint."""
    forbidding = (one for one in ruleset.constraints if isinstance(one, (Exclusive, Never)))
    return not all(brute_force.is_satisfied(one, ruleset, context, done) for one in forbidding)
