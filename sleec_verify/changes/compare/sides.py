"""Two rulesets brought to one vocabulary: what each takes for granted of situations, and measures for both."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Exclusive,
    Formula,
    Measure,
    MeasureRef,
    Never,
    Not,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    formulas_of,
    leaves,
    measures_of,
)
from sleec_verify.changes.compare.result import Undecidable
from sleec_verify.changes.diagram.formulas import compares
from sleec_verify.changes.relations import relations_at_one_instant
from sleec_verify.encoding.equation import conjunction, disjunction
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


@dataclass(frozen=True)
class Assumption:
    """Something that a side takes for granted of every situation: the formula over the common measures, the same as it
    stands in the text (for the evaluator), and words for it."""

    formula: Formula
    stated: Formula | None
    words: str


@dataclass
class RulesetSide:
    """One ruleset in one domain, in the common vocabulary."""

    stated: Ruleset
    given: list[Assumption]
    constraints: list[Exclusive | Never]
    scales: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """The measures whose scale the other side has otherwise, with this side's values."""

    merged: Mapping[str, Measure] = field(default_factory=dict)

    def plain(self, rule: Rule) -> Rule:
        """The rule with its comparisons in the common vocabulary; itself, if it has none of another scale."""
        if not self.scales or not compares_any(rule, self.scales):
            return rule
        return replace(
            rule,
            guard=None if rule.guard is None else self.formula(rule.guard),
            default=self._clause(rule.default),
            hedges=tuple(map(self._clause, rule.hedges)),
        )

    def _clause(self, clause: Clause) -> Clause:
        condition = None if clause.condition is None else self.formula(clause.condition)
        return replace(clause, condition=condition, hedges=tuple(map(self._clause, clause.hedges)))

    def formula(self, formula: Formula) -> Formula:
        """A formula with each comparison on a scale of two forms as the values that make it true."""
        if not self.scales:
            return formula
        if isinstance(formula, Not):
            return replace(formula, operand=self.formula(formula.operand))
        if isinstance(formula, (And, Or)):
            return replace(formula, operands=tuple(map(self.formula, formula.operands)))
        if isinstance(formula, Comparison) and not self.scales.keys().isdisjoint(measures_of(formula)):
            return self._as_values(formula)
        return formula

    def _as_values(self, comparison: Comparison) -> Formula:
        own = self.stated.measures[measures_of(comparison)[0]].values

        def sides(term: object) -> list[tuple[int, list[Formula]]]:
            if isinstance(term, ScaleValue):
                return [(term.rank, [])]
            assert isinstance(term, MeasureRef)
            return [(rank, [self._is(term.name, value)]) for rank, value in enumerate(own)]

        return disjunction(
            [
                conjunction([*here, *there])
                for left, here in sides(comparison.left)
                for right, there in sides(comparison.right)
                if compares((left > right) - (left < right), comparison.operator)
            ]
        )

    def _is(self, name: str, value: str) -> Formula:
        return Comparison(MeasureRef(name), "=", ScaleValue(value, self.merged[name].values.index(value)))

    def valid_scales(self) -> Iterator[Assumption]:
        """That each measure of two scales has a value of this side's, where the other has more."""
        for name, values in self.scales.items():
            if len(values) < len(self.merged[name].values):
                formula = disjunction([self._is(name, value) for value in values])
                yield Assumption(formula, None, f"{name} is {' or '.join(values)}")


def compares_any(rule: Rule, measures: Mapping[str, object]) -> bool:
    """Whether a rule compares one of these measures."""
    return any(
        isinstance(leaf, Comparison) and not measures.keys().isdisjoint(measures_of(leaf))
        for formula in formulas_of(rule)
        for leaf in leaves(formula)
    )


@dataclass
class Vocabulary:
    """The common measures, and what stands in the way of having them. `whole` are numbers that one side takes for whole
    ones: only whole values are compared."""

    measures: dict[str, Measure]
    scales: dict[str, Measure]
    whole: list[str]
    clashes: list[Undecidable]


def common(old: Ruleset, new: Ruleset) -> Vocabulary:
    """The measures of both rulesets as one set."""
    found = Vocabulary({**old.measures, **new.measures}, {}, [], [])
    for name in old.measures.keys() & new.measures.keys():
        one, other = old.measures[name], new.measures[name]
        if one.kind == other.kind and one.values == other.values:
            continue
        if (one.kind == "scale") != (other.kind == "scale"):
            found.clashes.append(Undecidable(name, _clash(name, one)))
        elif one.kind == "scale":
            values = (*other.values, *(value for value in one.values if value not in other.values))
            found.measures[name] = found.scales[name] = replace(other, values=values)
        else:
            found.measures[name] = replace(other, kind="integer")
            found.whole.append(name)
    found.whole.sort()
    found.clashes.sort()
    return found


def _clash(name: str, old: Measure) -> str:
    if old.kind == "scale":
        return sentence("{name} is a scale in one version and a number in the other", name=quoted(name))
    return sentence("{name} is a number in one version and a scale in the other", name=quoted(name))


def side(ruleset: Ruleset, vocabulary: Vocabulary) -> RulesetSide:
    """A ruleset as one side of a comparison."""
    found = RulesetSide(
        ruleset, [], [], {name: ruleset.measures[name].values for name in vocabulary.scales}, vocabulary.measures
    )
    for constraint in ruleset.constraints:
        if isinstance(constraint, Assume):
            found.given.append(_assumed(found, constraint.formula, "ASSUME"))
        elif isinstance(constraint, Never):
            found.constraints.append(replace(constraint, formula=found.formula(constraint.formula)))
        else:
            found.constraints.append(constraint)
    if ruleset.is_timed:
        for relation, formula in relations_at_one_instant(ruleset):
            found.given.append(_assumed(found, formula, f"the relation {relation}"))
    found.given += found.valid_scales()
    return found


def _assumed(of: RulesetSide, formula: Formula, by: str) -> Assumption:
    from sleec_runtime.language import print_formula

    return Assumption(of.formula(formula), formula, f"{by} {print_formula(formula)}" if by == "ASSUME" else by)


def condition_names(formulas: Iterable[Formula]) -> set[str]:
    """The names that these formulas use as conditions, true or false."""
    return {
        leaf.name
        for formula in formulas
        for leaf in leaves(formula)
        if isinstance(leaf, Atom) and leaf.kind == "condition"
    }
