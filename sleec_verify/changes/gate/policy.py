"""Which findings block a change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from sleec_runtime.model import NOWHERE, Span
from sleec_verify.changes.compare import by_obligation
from sleec_verify.changes.gate.keys import Policy
from sleec_verify.changes.gate.result import (
    NEW_SUPPRESSIONS,
    POLICY_CHANGES,
    Block,
    GateResult,
    RulesetExamination,
    TargetConformance,
)
from sleec_verify.checks import CHECKS
from sleec_verify.results.deduplication import deduplicate
from sleec_verify.results.finding import SEVERITIES, ClauseRef, Finding, Severity, Unknown
from sleec_verify.wording.phrases import in_short, listed, quoted

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.compare import DecidingClause
    from sleec_verify.results.finding import Witness

DEAD_HEDGE = CHECKS["dead-hedge"].kinds[0].code
CONFLICT = CHECKS["conflict"].kinds[0].code

POLICIES: Mapping[str, str] = {
    POLICY_CHANGES: "the policy of the gate changes",
    NEW_SUPPRESSIONS: "a new suppression",
    "suppressions": "a suppression without a reason, or of an unknown finding",
    "unused-suppressions": "a suppression without a finding",
    "deletions": "a ruleset of the base is missing",
    "submodules": "a submodule whose rules cannot be read",
    "new-conflicts": "new conflicts",
    "lost-obligations": "a lost obligation in some situation",
    "ruled-out-situations": "new assumptions exclude situations",
    "certificates": "a certificate is missing or invalid",
    "clause-coverage": "the cases cover too few clauses",
    "assertions": "an assertion does not hold",
    "comparison": "the comparison is inconclusive",
}
"""What blocks or is unknown, other than findings of checks, by its name in reports."""


def judge(found: GateResult, policy: Policy) -> None:
    """Fill in what blocks, what is unknown, and the new suppressions."""
    found.changes = [*_heeded(found.changes, policy.policy_changes)]
    for one in found.examined:
        found.changes += _heeded(_new_suppressions(one), policy.new_suppressions)
    found.blocks += (change for change in found.changes if change.finding and change.finding.severity == "error")
    for one in found.examined:
        found.blocks += _on_ruleset(one, policy)
        found.unknown += _unknown(one)
    for conformed in found.conformed:
        found.blocks += (_finding(conformed.target.code, f) for f in conformed.findings if _grave(f, policy))
        found.unknown += _unknown_code(conformed)
    for assertion, ruleset, answer in found.asked:
        path = found.paths[ruleset.source.path]
        if isinstance(answer, str):
            found.unknown.append(Block("unknown", path, f"{assertion.text}: {answer}"))
        elif answer is not None:
            what = f"{assertion.text} does not hold"
            domains = (answer.domain,) if answer.domain else ()
            places = _places(answer.deciding)
            found.blocks.append(_block("assertions", path, what, *places, witness=answer.witness, domains=domains))
    found.heeded = policy.unknown


_HELP = "this change is still judged by the policy of the base; an owner of the file must approve it"


def _heeded(changes: Iterable[Block], blocking: bool) -> Iterator[Block]:
    """Changes to settings, as errors if they block."""
    for change in changes:
        assert change.finding is not None, "it is shown as a finding"
        severity: Severity = "error" if blocking else "note"
        yield change._replace(finding=replace(change.finding, severity=severity, help=_HELP))


def _new_suppressions(one: RulesetExamination) -> Iterator[Block]:
    for new in one.new:
        what = f"line {one.line(new.span)} has a new suppression of {new.allowed}: {new.reason}"
        yield _block(NEW_SUPPRESSIONS, one.path, what, new.span)


def _on_ruleset(one: RulesetExamination, policy: Policy) -> Iterator[Block]:
    if one.unread is not None:
        yield _block("submodules", one.path, f"{one.unread} ({one.unread.hint})")
    elif one.deleted and policy.deletions:
        yield _block("deletions", one.path, "the base has this ruleset, and the change has none at this path")
    for problem in one.problems:
        what = f"line {one.line(problem.span)}: {problem.message} ({problem.hint})"
        yield _block("suppressions", one.path, what, problem.span)
    if policy.unused_suppressions:
        for unused in one.unused:
            what = f"line {one.line(unused.span)} allows {unused.allowed}, but there is no such finding"
            yield _block("unused-suppressions", one.path, what, unused.span)
    for finding in deduplicate(one.findings):
        if _grave(finding, policy):
            yield _finding(one.path, finding)
        elif policy.dead_hedges and finding.code == DEAD_HEDGE:
            yield Block("dead-hedges", one.path, finding.message, finding)
    if policy.new_conflicts:
        yield from _new_conflicts(one)
    yield from _lost(one, policy.lost_obligations)
    if policy.ruled_out_situations and one.difference is not None:
        for change in one.difference.situations:
            if change.way == "removed":
                what = f"a new assumption excludes situations: {change.what}"
                yield _block("ruled-out-situations", one.path, what, witness=change.witness, domains=change.domains)
    if isinstance(one.certificate, str):
        yield _block("certificates", one.path, one.certificate)
    if policy.clause_coverage is not None and one.coverage is not None:
        reached = one.coverage
        if reached.percent < policy.clause_coverage:
            most = [*reached.missed[:5], *(["…"] if len(reached.missed) > 5 else [])]
            what = f"the cases cover {reached}; "
            what += f"the policy requires {policy.clause_coverage:g} %; not covered: {', '.join(most)}"
            yield _block("clause-coverage", one.path, what)


def _grave(finding: Finding, policy: Policy) -> bool:
    if policy.findings == "never":
        return False
    return SEVERITIES.index(finding.severity) <= SEVERITIES.index(policy.findings)


def _finding(where: str, finding: Finding) -> Block:
    return Block("findings", where, f"{finding.severity}[{finding.code}] {finding.message}", finding)


def _block(
    policy: str,
    where: str,
    what: str,
    span: Span = NOWHERE,
    related: tuple[tuple[Span, str], ...] = (),
    clauses: tuple[ClauseRef, ...] = (),
    obligations: tuple[str, ...] = (),
    witness: Witness | None = None,
    domains: tuple[str, ...] = (),
) -> Block:
    """A reason to block that is not a finding of a check, as a finding, so that reports can show it."""
    rules = tuple(dict.fromkeys(clause.rule for clause in clauses))
    made = Finding(
        policy, policy, "error", what, span, rules, clauses, obligations, witness, related=related, domains=domains
    )
    return Block(policy, where, what, made)


def _places(
    deciding: Sequence[DecidingClause],
) -> tuple[Span, tuple[tuple[Span, str], ...], tuple[ClauseRef, ...]]:
    """The places of clauses that decide in the current version: the first, the others, and all by their rules."""
    if not deciding:
        return NOWHERE, (), ()
    others = tuple((one.span, f"rule `{one.rule}` also applies here") for one in deciding[1:])
    return deciding[0].span, others, tuple(ClauseRef(one.rule, one.clause) for one in deciding)


def _new_conflicts(one: RulesetExamination) -> Iterator[Block]:
    """The new conflicts that no suppression allows and that are not in the baseline."""
    if one.difference is None:
        return
    kept = {frozenset(f.rules) for f, _ in one.allowed if f.code == CONFLICT}
    kept |= {frozenset(f.rules) for f in one.known if f.code == CONFLICT}
    # Rules may have two conflicts, of which only one is allowed.
    kept -= {frozenset(f.rules) for f in one.findings if f.code == CONFLICT}
    for conflict in one.difference.conflicts:
        if conflict.way == "added" and frozenset(conflict.rules) not in kept:
            rules = listed(conflict.rules) if conflict.rules else "the constraints"
            names = tuple(sorted({o.name for o in conflict.literals}))
            what = f"{rules} now contradict each other about {listed(names) if names else 'the situation'}"
            span, related, clauses = _places(conflict.after)
            yield _block(
                "new-conflicts", one.path, what, span, related, clauses, names, conflict.witness, conflict.domains
            )
    for timed in one.difference.timed_conflicts:
        if timed.way == "added" and frozenset(timed.rules) not in kept:
            policy = "new-conflicts"
            found = replace(timed.finding, check=policy, code=policy, domains=timed.domains)
            yield Block(policy, one.path, found.message, found)


def _lost(one: RulesetExamination, patterns: tuple[str, ...]) -> Iterator[Block]:
    if one.difference is None:
        return
    seen = set()
    for change, obligation, way in by_obligation(one.difference.changes):
        if way == "removed" and any(fnmatchcase(str(obligation), pattern) for pattern in patterns):
            one_rule = len(change.rules) == 1
            rules = f"{'rule' if one_rule else 'rules'} {listed(map(quoted, change.rules))}"
            verb = "requires" if one_rule else "require"
            what = f"{rules} no longer {verb} {quoted(in_short(obligation))} in some situation"
            if what not in seen:
                seen.add(what)
                span, related, clauses = _places(change.after)
                if not clauses and one.ruleset is not None:
                    span = _rule(one.ruleset, change.new_rule)
                yield _block(
                    "lost-obligations", one.path, what, span, related, clauses, (obligation.name,), change.witness
                )


def _rule(ruleset: Ruleset, label: str | None) -> Span:
    rule = None if label is None else ruleset.by_label.get(label)
    return NOWHERE if rule is None else rule.span


def _unknown(one: RulesetExamination) -> Iterator[Block]:
    for result in one.results:
        if isinstance(result.verdict, Unknown):
            yield Block("unknown", one.path, f"{result.name}: {result.verdict.why}")
    if one.difference is not None:
        for what, why in one.difference.undecided:
            yield Block("unknown", one.path, f"{what}: {why}")


def _unknown_code(one: TargetConformance) -> Iterator[Block]:
    if one.result is not None and isinstance(one.result.verdict, Unknown):
        yield Block("unknown", one.target.code, one.result.verdict.why)
