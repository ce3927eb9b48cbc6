"""Conflict-freeness in few formulas, in the place of a question for each cause.

The check looks for causes, so it asks of one set of clauses after the other. That nothing can conflict is told by fewer
questions, one for each smallest set of obligations that cannot all be due (`query.inconsistent_sets`): in some context,
does each of them follow from some clause that decides there? They share the clauses of all the rules that oblige any of
them; what shares neither rules nor assumptions is asked apart, so that a solver need not look at everything each time.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence

from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.query.inconsistent_sets import Exclusion, InconsistentSet
from sleec_verify.query.names import Name, names_in, names_of_rule
from sleec_verify.query.prime_implicates import inconsistent_sets_of
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex


def conflict_free(index: RulesetIndex) -> bool:
    """Whether no situation conflicts. The formulas are linear in the rules that oblige part of a clash and in the
    assumptions."""
    # All are asked, so that all are recorded.
    answers = [_possible(index, group) for group in _groups(index)]
    return not any(answers)


def _possible(index: RulesetIndex, group: Sequence[InconsistentSet | Exclusion]) -> bool:
    """Whether any of these clashes comes true in some situation."""
    at_odds = {literal for clash in group for literal in clash.literals}
    with Question(index) as question:
        due = question.due(_rules(index, group), at_odds)
        questions = []
        for clash in group:
            literals = [due[literal] for literal in sorted(clash.literals, key=str)]
            if isinstance(clash, Exclusion):
                literals = [question.encoder.at_least_two(literals)]
            elif clash.labels:
                literals.append(question.encoder.literal(clash.situation))
            questions.append(literals)
        answers = [question.ask(*literals) for literals in questions]
        return any(answers)


def _rules(index: RulesetIndex, group: Iterable[InconsistentSet | Exclusion]) -> list[int]:
    """The rules that oblige part of these clashes, in the order of the text."""
    return sorted({p.rule for clash in group for literal in clash.literals for p in index.by_obligation[literal]})


def _groups(index: RulesetIndex) -> list[list[InconsistentSet | Exclusion]]:
    """The clashes in groups that share neither rules nor names that the same assumptions speak of."""
    union = UnionFind()
    assumed: set[Name] = set()
    for assumption in index.assumptions:
        names = list(names_in(assumption.formula))
        assumed.update(names)
        for other in names[1:]:
            union.join(other, names[0])
    by_root: dict[Hashable, list[InconsistentSet | Exclusion]] = {}
    clashes: list[InconsistentSet | Exclusion] = [
        *inconsistent_sets_of(index).listed,
        *inconsistent_sets_of(index).exclusions,
    ]
    tied: set[int] = set()
    for clash in clashes:
        for rule in _rules(index, [clash]):
            union.join(rule, clash)
            if rule not in tied:
                tied.add(rule)
                for name in assumed.intersection(names_of_rule(index.rules[rule])):
                    union.join(name, rule)
        for name in assumed.intersection(names_in(clash.situation) if isinstance(clash, InconsistentSet) else ()):
            union.join(name, clash)
    for clash in clashes:
        by_root.setdefault(union.root(clash), []).append(clash)
    return list(by_root.values())
