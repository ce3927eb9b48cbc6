"""From what was found to what blocks."""

from __future__ import annotations

from collections.abc import Iterator
from fnmatch import fnmatchcase

from sleec_verify.checks import CHECKS
from sleec_verify.compare import by_obligation
from sleec_verify.finding import SEVERITIES, Finding, Unknown
from sleec_verify.gate.config import Policy
from sleec_verify.gate.result import Block, Conformed, Examined, Gated
from sleec_verify.report.words import in_short, listed

DEAD_HEDGE = CHECKS["dead-hedge"].kinds[0].code
CONFLICT = CHECKS["conflict"].kinds[0].code


def judge(found: Gated, policy: Policy) -> None:
    """Fill in what blocks, and what is unknown where that blocks."""
    for one in found.examined:
        found.blocks += _on_ruleset(one, policy)
        found.unknown += _unknown(one)
    for conformed in found.conformed:
        found.blocks += (_finding(conformed.target.code, f) for f in conformed.findings if _grave(f, policy))
        found.unknown += _unknown_code(conformed)
    for assertion, ruleset, answer in found.asked:
        if isinstance(answer, tuple):
            found.blocks.append(Block("assertions", ruleset.source.path, f"{assertion.text} does not hold"))
        elif answer is not None:
            found.unknown.append(Block("unknown", ruleset.source.path, f"{assertion.text}: {answer}"))
    if not policy.unknown:
        found.unknown.clear()


def _on_ruleset(one: Examined, policy: Policy) -> Iterator[Block]:
    for problem in one.problems:
        yield Block("suppressions", one.path, f"line {one.line(problem.span)}: {problem.message} ({problem.hint})")
    if policy.unused_suppressions:
        for unused in one.unused:
            what = f"line {one.line(unused.span)} allows {listed(unused.allowed)}, and there is no such finding"
            yield Block("unused-suppressions", one.path, what)
    for finding in one.findings:
        if _grave(finding, policy):
            yield _finding(one.path, finding)
        elif policy.dead_hedges and finding.code == DEAD_HEDGE:
            yield Block("dead-hedges", one.path, finding.message)
    if policy.new_conflicts:
        yield from _new_conflicts(one)
    yield from _lost(one, policy.lost_obligations)
    if one.uncertified is not None:
        yield Block("certificates", one.path, one.uncertified)
    if policy.clause_coverage is not None and one.coverage is not None and one.coverage.why is None:
        reached = one.coverage
        if reached.percent < policy.clause_coverage:
            most = [*reached.missed[:5], *(["…"] if len(reached.missed) > 5 else [])]
            what = f"the cases reach {reached.reached} of {reached.clauses} clauses, and {policy.clause_coverage:g} %"
            yield Block("clause-coverage", one.path, f"{what} is asked for; not reached: {', '.join(most)}")


def _grave(finding: Finding, policy: Policy) -> bool:
    if policy.findings == "never":
        return False
    return SEVERITIES.index(finding.severity) <= SEVERITIES.index(policy.findings)


def _finding(where: str, finding: Finding) -> Block:
    return Block("findings", where, f"{finding.severity}[{finding.code}] {finding.message}")


def _new_conflicts(one: Examined) -> Iterator[Block]:
    """Those that no suppression allows and no baseline has: both speak of the conflict's finding, by its rules."""
    if one.difference is None:
        return
    kept = {frozenset(f.rules) for f in (*(f for f, _ in one.allowed), *one.known) if f.code == CONFLICT}
    for conflict in one.difference.conflicts:
        if conflict.way == "added" and frozenset(conflict.rules) not in kept:
            rules = listed(conflict.rules) if conflict.rules else "the constraints"
            at_odds = listed(sorted({o.name for o in conflict.literals})) if conflict.literals else "the situation"
            yield Block("new-conflicts", one.path, f"{rules} now conflict over {at_odds}")


def _lost(one: Examined, patterns: tuple[str, ...]) -> Iterator[Block]:
    if one.difference is None:
        return
    told = set()
    for change, obligation, way in by_obligation(one.difference.changes):
        if way == "removed" and any(fnmatchcase(str(obligation), pattern) for pattern in patterns):
            what = f"{in_short(obligation)} is no longer called for by {listed(change.rules)} in some situation"
            if what not in told:
                told.add(what)
                yield Block("lost-obligations", one.path, what)


def _unknown(one: Examined) -> Iterator[Block]:
    for result in one.results:
        if isinstance(result.verdict, Unknown):
            yield Block("unknown", one.path, f"{result.name}: {result.verdict.why}")
    if one.difference is not None:
        for what, why in one.difference.undecided:
            yield Block("unknown", one.path, f"{what}: {why}")
    if one.coverage is not None and one.coverage.why is not None:
        yield Block("unknown", one.path, f"clause coverage: {one.coverage.why}")


def _unknown_code(one: Conformed) -> Iterator[Block]:
    if one.why is not None:
        yield Block("unknown", one.target.code, one.why)
    elif one.result is not None and isinstance(one.result.verdict, Unknown):
        yield Block("unknown", one.target.code, one.result.verdict.why)
