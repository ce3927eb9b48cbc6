"""Conflict-freeness in few formulas, instead of a question for each cause.

The check looks for causes, so it asks about one set of clauses after the other. To show that there is no conflict, one
question for each minimal inconsistent set is enough (`query.inconsistent_sets`): in some context, is each of its
obligations due? The questions share the clauses of all rules that oblige any of them. Questions that share neither
rules nor assumptions are separate formulas, which are smaller for a solver.
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
    """Whether no situation conflicts. The formulas are linear in the assumptions and in the rules that oblige a
    part of an inconsistent set."""
    # All are asked, so that all are recorded.
    answers = [_possible(index, group) for group in _groups(index)]
    return not any(answers)


def _possible(index: RulesetIndex, group: Sequence[InconsistentSet | Exclusion]) -> bool:
    """Whether any of these inconsistent sets is due in some situation."""
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
    """The rules that oblige part of these inconsistent sets, in the order of the text."""
    return sorted({p.rule for clash in group for literal in clash.literals for p in index.by_obligation[literal]})


def _groups(index: RulesetIndex) -> list[list[InconsistentSet | Exclusion]]:
    """The inconsistent sets in groups that share neither rules nor names in the same assumptions."""
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
