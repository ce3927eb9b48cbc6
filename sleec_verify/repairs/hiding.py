"""What hides an exception that never applies: other exceptions of its rule, and assumptions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

from sleec_runtime.model import Assume, Clause, Rule, Ruleset, Statement
from sleec_verify.checks import Checking
from sleec_verify.checks.dead import DEAD_HEDGE
from sleec_verify.encoding.scope import Scope
from sleec_verify.results.finding import Finding, Proved, Refuted
from sleec_verify.wording.phrases import exception, quoted

_Holder = TypeVar("_Holder", Rule, Clause)


def hiding(ruleset: Ruleset, finding: Finding, scope: Scope) -> list[str]:
    """The names of what hides the exception of a finding of `dead-hedge`: without any one of these, it applies.

    The list is empty if only several together hide it, or if its condition can never be true. Costs a check of the
    exceptions for each exception of the rule, and for each assumption.
    """
    if finding.check != DEAD_HEDGE.name or not finding.clauses:
        return []
    label, number = finding.clauses[0]
    rule = ruleset.by_label[label]
    dead = list(rule.clauses())[number]
    names = [
        exception(hedge)
        for hedge in list(rule.clauses())[1:]
        if hedge is not dead and _applies(_with(ruleset, rule, _without(rule, hedge)), label, dead, scope)
    ]
    for one in ruleset.constraints:
        if isinstance(one, Assume):
            rest = tuple(statement for statement in ruleset.statements if statement is not one)
            if _applies(replace(ruleset, statements=rest), label, dead, scope):
                names.append(quoted(ruleset.source.in_one_line(one.span)))
    return names


def _without(holder: _Holder, hedge: Clause) -> _Holder:
    """The rule or clause without an exception, wherever it is."""
    kept = tuple(_without(one, hedge) for one in holder.hedges if one is not hedge)
    if isinstance(holder, Rule):
        return replace(holder, default=_without(holder.default, hedge), hedges=kept)
    return replace(holder, hedges=kept)


def _with(ruleset: Ruleset, old: Rule, new: Rule) -> Ruleset:
    def statements() -> Iterator[Statement]:
        for one in ruleset.statements:
            yield new if one is old else one

    return replace(ruleset, statements=tuple(statements()))


def _applies(ruleset: Ruleset, label: str, clause: Clause, scope: Scope) -> bool:
    """Whether the clause at the same place is not dead in these rules."""
    checking = Checking(ruleset, scope.domain, scope.untimed, chains=scope.chains)
    verdict = checking.result(DEAD_HEDGE.name).verdict
    if isinstance(verdict, Proved):
        return True
    found = verdict.findings if isinstance(verdict, Refuted) else None
    return found is not None and not any(one.rules == (label,) and one.span == clause.span for one in found)
