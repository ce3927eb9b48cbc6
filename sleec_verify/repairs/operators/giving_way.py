"""Repairs of a conflict in which one of its rules gives way to the others.

The rule that gives way keeps its response wherever the clauses of the others do not decide. Their guard, as in
Equation 1 (paper, Section 3.2), is the condition of the repair; what both rules need anyway is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from sleec_runtime.model import Atom, Clause, Formula, Never, Not, Obligation, Rule, Ruleset, leaves
from sleec_verify.encoding.equation import conjunction
from sleec_verify.repairs.clause_names import clause_name, rule_name
from sleec_verify.repairs.operators.conditions import deciding, negation, simplified, unless
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import (
    exception_text,
    formula_text,
    narrowed,
    strengthened,
    with_exception,
    without_obligations,
)
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import sentence


class Yielding(NamedTuple):
    """A clause that gives way, and the conditions under which it does, the most exact one first.

    `others` are the clauses to which it gives way. There are none if only a NEVER excludes what it requires.
    """

    rule: Rule
    number: int
    conditions: tuple[Formula, ...]
    others: tuple[tuple[Rule, int], ...]

    @property
    def clause(self) -> Clause:
        return list(self.rule.clauses())[self.number]


def yieldings(ruleset: Ruleset, finding: Finding) -> Iterator[Yielding]:
    """Each clause of a conflict as the one that gives way."""
    clauses = [(ruleset.by_label[label], number) for label, number in finding.clauses]
    excluded = [part for never in nevers_of(ruleset, finding) for part in _situation(never)]
    for rule, number in clauses:
        others = tuple(other for other in clauses if other[0] is not rule)
        if others or excluded:
            theirs = [part for other, at in others for part in deciding(ruleset, other, at)]
            yield Yielding(rule, number, tuple(_conditions(ruleset, rule, number, [*theirs, *excluded])), others)


def nevers_of(ruleset: Ruleset, finding: Finding) -> list[Never]:
    """The NEVER statements of a conflict."""
    spans = {span for span, _ in finding.related}
    return [one for one in ruleset.constraints if isinstance(one, Never) and one.span in spans]


def _situation(never: Never) -> list[Formula]:
    """The conditions under which a NEVER excludes obligations: its conjuncts without these."""
    return [part for part in simplified(never.formula) if not any(map(_is_obligation, leaves(part)))]


def _is_obligation(formula: Formula) -> bool:
    return isinstance(formula, Atom) and formula.kind == "obligation"


def _conditions(ruleset: Ruleset, rule: Rule, number: int, theirs: Iterable[Formula]) -> Iterator[Formula]:
    own = deciding(ruleset, rule, number)
    exact = list(dict.fromkeys(part for part in theirs if part not in own))
    positive = [part for part in exact if not isinstance(part, Not)]
    for parts in (exact, positive):
        if parts:
            yield conjunction(parts)


def guards(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Trigger strengthening: the rule does not apply where the others decide."""
    for one in yieldings(ruleset, finding):
        for condition in one.conditions:
            negated = unless(ruleset, one.rule, one.number, condition)
            title = sentence(
                "add to the trigger of {rule}: {text}",
                rule=rule_name(ruleset, one.rule),
                text=quoted(_and(ruleset, negated)),
            )
            edits = strengthened(ruleset, one.rule, negated)
            yield Candidate("trigger-strengthening", title, edits, one.rule.label)


def _and(ruleset: Ruleset, formula: Formula) -> str:
    return f"{'and' if ruleset.syntax == 'dsl' else 'AND'} {formula_text(ruleset, formula)}"


def exceptions(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Defeater introduction: an exception for the situations in which the others decide. It requires what is left of
    the response, or what the others require."""
    for one in yieldings(ruleset, finding):
        kept = tuple(o for o in one.clause.obligations if o.name not in finding.obligations)
        theirs = tuple(
            dict.fromkeys(
                o
                for other, number in one.others
                for o in list(other.clauses())[number].obligations
                if o.name in finding.obligations
            )
        )
        for response in dict.fromkeys((kept, (*kept, *theirs))):
            for condition in one.conditions:
                if response:
                    yield _exception(ruleset, one, condition, response)


def refinements(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Defeater refinement: an exception does not apply where the others decide."""
    for one in yieldings(ruleset, finding):
        if one.clause.condition is not None:
            for condition in one.conditions:
                refined = conjunction([one.clause.condition, negation(condition)])
                text = quoted(formula_text(ruleset, refined))
                title = sentence(
                    "narrow the condition of {clause} to {text}",
                    clause=clause_name(ruleset, one.rule, one.number),
                    text=text,
                )
                edits = narrowed(ruleset, one.clause, negation(condition))
                yield Candidate("defeater-refinement", title, edits, one.rule.label)


def _exception(ruleset: Ruleset, one: Yielding, condition: Formula, response: tuple[Obligation, ...]) -> Candidate:
    text = exception_text(ruleset, condition, response)
    title = sentence("add to {clause}: {text}", clause=clause_name(ruleset, one.rule, one.number), text=quoted(text))
    edits = with_exception(ruleset, one.rule, one.clause, condition, response)
    return Candidate("defeater-introduction", title, edits, one.rule.label)


def responses(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Response refinement: a clause no longer requires what contradicts the others."""
    for label, number in finding.clauses:
        rule = ruleset.by_label[label]
        clause = list(rule.clauses())[number]
        removed = [o for o in clause.obligations if o.name in finding.obligations]
        edits = without_obligations(ruleset, clause, removed)
        if removed and edits is not None:
            names = listed(quoted(str(one)) for one in removed)
            title = sentence("remove {names} from {clause}", names=names, clause=clause_name(ruleset, rule, number))
            yield Candidate("response-refinement", title, edits, label)
