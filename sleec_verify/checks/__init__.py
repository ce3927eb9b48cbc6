"""The checks by name, and running them on a ruleset."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing, suppress
from dataclasses import replace
from functools import partial
from time import perf_counter

from sleec_runtime.model import Ruleset
from sleec_verify.checks.always import of_statements
from sleec_verify.checks.assumptions import ASSUMPTIONS, contradict_each_other
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.claims import CONCERN, PURPOSE
from sleec_verify.checks.conflict import CONFLICT
from sleec_verify.checks.conflict_wording import rejection
from sleec_verify.checks.confusable import CONFUSABLE
from sleec_verify.checks.constant_conditions import CONSTANT_CONDITION
from sleec_verify.checks.dead import DEAD_HEDGE, DEAD_RULE
from sleec_verify.checks.duplicate import DUPLICATE_RULE
from sleec_verify.checks.forbidden_input import FORBIDDEN_INPUT
from sleec_verify.checks.misread_names import MISREAD_NAME
from sleec_verify.checks.reading import READING
from sleec_verify.checks.realizability import REALIZABILITY, realizability
from sleec_verify.checks.redundant import REDUNDANT_HEDGE, REDUNDANT_RULE
from sleec_verify.checks.required_input import REQUIRED_INPUT
from sleec_verify.checks.text import EMPTY_HEDGE, PHRASE_KEYWORD, TRIGGER_OBLIGATION, UNUSED_NAME
from sleec_verify.checks.text_defects import DEFECTS
from sleec_verify.checks.unknown_events import STRAY_EVENT
from sleec_verify.checks.untimed_conflicts import Enough
from sleec_verify.checks.vacuous import VACUOUS_CONFLICT
from sleec_verify.checks.windows import BARE_PROHIBITION, ZERO_WINDOW
from sleec_verify.encoding.budget import Undecided, for_file, share
from sleec_verify.encoding.solver import Recorder
from sleec_verify.encoding.trace_scope import Untimed, speaks_of_traces
from sleec_verify.query.question import is_possible
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.situations import replay_finding
from sleec_verify.results.finding import CheckResult, Finding, Proved, Refuted, Unknown, Verdict
from sleec_verify.wording.sentence import joined

__all__ = ["CHECKS", "Check", "Checking", "FindingKind", "checks_for", "run_checks"]

CHECKS: Mapping[str, Check] = {
    check.name: check
    for check in (
        CONFLICT,
        VACUOUS_CONFLICT,
        ASSUMPTIONS,
        DEAD_RULE,
        DEAD_HEDGE,
        REDUNDANT_RULE,
        REDUNDANT_HEDGE,
        READING,
        UNUSED_NAME,
        EMPTY_HEDGE,
        TRIGGER_OBLIGATION,
        FORBIDDEN_INPUT,
        REQUIRED_INPUT,
        PHRASE_KEYWORD,
        CONFUSABLE,
        MISREAD_NAME,
        DEFECTS,
        DUPLICATE_RULE,
        STRAY_EVENT,
        CONSTANT_CONDITION,
        ZERO_WINDOW,
        BARE_PROHIBITION,
        CONCERN,
        PURPOSE,
        REALIZABILITY,
    )
}

COSTLY = (
    CONSTANT_CONDITION.name,
    ASSUMPTIONS.name,
    DEAD_RULE.name,
    DEAD_HEDGE.name,
    READING.name,
    REDUNDANT_HEDGE.name,
    REDUNDANT_RULE.name,
    PURPOSE.name,
    CONCERN.name,
    VACUOUS_CONFLICT.name,
    CONFLICT.name,
    REALIZABILITY.name,
)
"""The checks that ask a solver, in the order in which they run, after those that only read the text."""

_ROUNDS = 3
"""How often a check runs at most, if it has spent its share of the budget."""

_AT_FIRST = 1 / 3
"""The part of the budget that each check may spend at first."""

Progress = Callable[[str, int, int], None]
"""Called before each check with its name, the number of finished checks, and the number of all checks."""


def checks_for(ruleset: Ruleset) -> list[str]:
    """The names of the checks that run on a ruleset by default."""
    left_out = {REALIZABILITY.name}
    if ruleset.source.text.isascii():
        left_out.add(CONFUSABLE.name)
    if ruleset.syntax == "dsl":
        # In the DSL, a response is always the event of that name.
        left_out.add(TRIGGER_OBLIGATION.name)
    else:
        # Structured English has no defects: the parser rejects them.
        left_out.add(DEFECTS.name)
    if ruleset.syntax == "english" and ruleset.reading_stated:
        # The author has decided which reading applies.
        left_out.add(READING.name)
    if ruleset.dialect != "sleec-tk":
        left_out.add(BARE_PROHIBITION.name)
    if not speaks_of_traces(ruleset):
        left_out |= {CONCERN.name, PURPOSE.name}
    if not ruleset.is_timed:
        left_out |= {STRAY_EVENT.name, ZERO_WINDOW.name}
    return [name for name in CHECKS if name not in left_out]


def run_checks(
    ruleset: Ruleset,
    names: Sequence[str] | None = None,
    domain: str | None = None,
    progress: Progress | None = None,
    untimed: Untimed = "at",
    realizable: int | None = None,
    chains: bool = True,
) -> tuple[CheckResult, ...]:
    """The verdicts of the checks (all, or those of `names`), in their own order.

    A ruleset is checked in each of its domains, with the rules that apply everywhere; `domain` selects one. A finding
    names its domains. `untimed` is the meaning of a response without a window in rules with time. Without `chains`,
    responses trigger no rules (the paper's one-step reading). `realizable` adds that check, with this number of acts of
    the environment. Unless there is a budget already (`encoding.budget`), the checks get that of one file. Anything
    undecided within it is unknown. Raises `KeyError` for an unknown check.
    """
    checking = Checking(ruleset, domain, untimed, realizable=1 if realizable is None else realizable, chains=chains)
    chosen = list(dict.fromkeys(checks_for(ruleset) if names is None else names))
    if realizable is not None:
        chosen.append(REALIZABILITY.name)
    return checking.results(chosen, progress)


class Checking:
    """The checks of one ruleset, one after the other. `recorder` receives their questions.

    `by_domain` is what they check: the ruleset in each of its domains or in the selected one; without domains, the
    whole ruleset under an empty name.
    """

    def __init__(
        self,
        ruleset: Ruleset,
        domain: str | None = None,
        untimed: Untimed = "at",
        recorder: Recorder | None = None,
        realizable: int = 1,
        chains: bool = True,
        seen: Callable[[Finding], None] | None = None,
        domains: Sequence[str] | None = None,
    ) -> None:
        """`realizable` is the number of acts of the environment in that check. Without `chains`, responses trigger
        no rules. `seen` gets each confirmed finding as soon as it is found. An exception from it ends the checks.
        `domains` replaces the domains of the ruleset, if it is a part of one with more of them."""
        self._seen = seen
        self._checks: Mapping[str, Check] = {**CHECKS, REALIZABILITY.name: realizability(realizable)}
        known: Callable[[Ruleset], RulesetIndex] = partial(
            RulesetIndex, recorder=recorder, untimed=untimed, chains=chains
        )
        if domains is None:
            domains = ruleset.domains if domain is None else (domain,)
        self.whole = known(ruleset)
        self.by_domain = {d: known(ruleset.in_domain(d)) for d in domains} or {"": self.whole}

    def results(
        self,
        names: Sequence[str],
        progress: Progress | None = None,
        made: Callable[[CheckResult], None] | None = None,
    ) -> tuple[CheckResult, ...]:
        """The verdicts of these checks. Each runs with a small part of the budget at first. If that is not enough, it
        runs again after all others, with an equal share of the rest.

        `made` is called after each finished check. Raises `KeyError` for an unknown check.
        """
        found: dict[str, CheckResult] = {}
        had: dict[str, float] = {}
        with for_file(len(self.whole.ruleset.source.text)):
            self._ask_what_is_possible()
            waiting = sorted(names, key=lambda name: COSTLY.index(name) if name in COSTLY else -1)
            for again in range(_ROUNDS):
                short = []
                for done, name in enumerate(waiting):
                    if progress is not None:
                        progress(name, done, len(waiting))
                    with share(1 / (len(waiting) - done) if again else _AT_FIRST) as budget:
                        if budget.left() <= had.get(name, -1):
                            continue
                        had[name] = budget.left()
                        found[name] = self.result(name)
                    if made is not None:
                        made(found[name])
                    if isinstance(found[name].verdict, Unknown) and budget.ran_out:
                        short.append(name)
                waiting = short
        return tuple(found[name] for name in names)

    def _ask_what_is_possible(self) -> None:
        """Ask this first, and once, because every question about situations depends on it."""
        for index in (self.whole, *self.by_domain.values()):
            if index.assumptions:
                with share(1 / 2), suppress(Undecided):
                    _ = is_possible(index)

    def result(self, name: str) -> CheckResult:
        """The verdict of one check. Raises KeyError for an unknown one."""
        check = self._checks[name]
        started = perf_counter()
        verdict, reason = _verdict(
            check, {"": self.whole} if check.scope == "text" else self.by_domain, self.whole.ruleset, self._seen
        )
        return CheckResult(check.name, verdict, perf_counter() - started, reason)


def _findings(check: Check, index: RulesetIndex) -> Generator[Finding, None, None]:
    yield from check.run(index)


def _verdict(
    check: Check,
    by_domain: Mapping[str, RulesetIndex],
    ruleset: Ruleset,
    tell: Callable[[Finding], None] | None,
) -> tuple[Verdict, str | None]:
    found: dict[tuple[object, ...], Finding] = {}
    unknown: list[str] = []
    cut: str | None = None
    for domain, index in by_domain.items():
        if check is not ASSUMPTIONS and check.scope != "text" and contradict_each_other(index):
            # Without situations, no other finding means anything.
            continue
        try:
            # A check that is left early gives its share of the budget back when it is closed.
            with closing(_findings(check, index)) as proposed:
                for finding in proposed:
                    if not replay_finding(index, finding):
                        unknown.append(rejection(finding))
                        continue
                    if tell is not None and check.scope != "every domain":
                        tell(finding)
                    # A redundant rule may have another reason in each domain, and is still one finding.
                    rules = finding.rules[:1] if check.scope == "every domain" else finding.rules
                    key: tuple[object, ...] = (finding.code, rules, finding.clauses, finding.obligations, finding.span)
                    if key in found and not replay_finding(index, found[key]):
                        # The assumptions of this domain exclude the situation of the other one.
                        key = (*key, domain)
                    seen = found.setdefault(key, finding)
                    if domain:
                        found[key] = replace(seen, domains=(*seen.domains, domain))
        except Undecided as error:
            unknown.append(error.message)
        except Enough as error:
            cut = str(error)
    findings = tuple(
        finding
        for finding in sorted(found.values(), key=lambda f: f.span)
        if check.scope != "every domain" or _everywhere(finding, by_domain)
    )
    findings = of_statements(findings, ruleset)
    if unknown:
        return Unknown(joined("; ", dict.fromkeys(unknown)), findings), None
    return (Refuted(findings) if findings else Proved()), cut


def _everywhere(finding: Finding, by_domain: Mapping[str, RulesetIndex]) -> bool:
    """Whether a finding holds in every domain in which its first rule applies."""
    rule = finding.rules[0]
    counts_in = (domain for domain, index in by_domain.items() if domain and rule in index.ruleset.by_label)
    return all(domain in finding.domains for domain in counts_in)
